"""Trace lines of robots in the order of time, and what is missing of them."""

from collections import Counter
import heapq
from itertools import count
import json
import re
from typing import Any, NamedTuple

from .property_monitors import LOST

MILLISECOND = 1_000_000
_SHUTDOWN = 'node.shutdown'
_LISTS = ('configuration', 'entered', 'exited', 'taken', 'started', 'cancelled', 'sent')


_ROBOT = re.compile(r'(?P<role>\w+)\[(?P<number>\d+)\](\.(?P<part>\w+))?')


class Machine(NamedTuple):
    """
    Machine of a role or of a part: the name of its node, its states, and its properties.

    The role has at most so many robots, None for any number. `functions` are those that states
    call, as far as properties ask how they end.
    """

    node: str
    states: Any
    most: Any = None
    properties: Any = ()
    functions: Any = ()


class Robot(NamedTuple):
    """A robot of the swarm."""

    name: str
    role: str


class Actor(NamedTuple):
    """The machine of a robot or of its part, which has a name of its own."""

    name: str
    robot: Robot
    states: Any
    functions: Any


class Envelope(NamedTuple):
    """Around an event: the name of its sender, empty if it is not from a robot."""

    sender: str


class Line(NamedTuple):
    """
    A line of a trace, as monitors need it.

    Times are in nanoseconds since the beginning of the run. `values` has the truth of conditions,
    `record` is the line of JSON.
    """

    time: int
    actor: Actor
    event: Any
    envelope: Envelope
    deferred: bool
    recalled: bool
    configuration: Any
    started: Any
    cancelled: Any
    sent: Any
    values: Any
    record: Any


class _Source:
    """Progress of the lines of a machine: the start of its node, and its last line."""

    def __init__(self, actor):
        self.actor = actor
        self.began = -1
        self.next = 0
        self.last = None
        self.is_over = False
        self.is_lost = False


class RobotLines:
    """
    Orders the lines of robots by time.

    A line waits for the time `wait` in case an earlier one comes: its robot may be far, or its
    clock may be behind. The first lines wait for all robots that are `expected`, at most for the
    time `start`. `machines` are those of the roles and parts. Times are in milliseconds since
    1970.
    """

    def __init__(self, machines, expected, wait, start):
        self._machines = machines
        self._expected = dict.fromkeys(expected)
        self._wait = wait
        self._start = start
        self._first = None
        self._sources = {}
        self._waiting = []
        self._heard = count()
        self._passed = -1
        self._unknown = 0
        self._beyond = Counter()
        self._missing = Counter()
        self._late = Counter()
        self._returned = set()
        self.zero = None
        """Beginning of the run, None before the first line."""

    def hear(self, text, now):
        """
        Keep a line of JSON, and return the name of its machine, None for another line.

        A line that is heard again is left out.
        """
        try:
            record = _checked(json.loads(text))
            source = self._source(record['member'])
        except _BeyondError as error:
            self._beyond[str(error)] += 1
            return None
        except (AttributeError, KeyError, TypeError, ValueError):
            self._unknown += 1
            return None
        began, number = record['began'], record['number']
        self._first = now if self._first is None else self._first
        self._expected.pop(source.actor.robot.name, None)
        if (began, number) < (source.began, source.next):
            return source.actor.name
        if began > source.began:
            if source.last is not None and not source.is_lost:
                # It has started again unnoticed.
                self._add_lost(source, began - 1, now)
            source.began, source.next = began, 0
        elif source.is_lost:
            self._returned.add(source.actor.name)
        self._missing[source.actor.name] += number - source.next
        source.next, source.last, source.is_lost = number + 1, record, False
        source.is_over = record['event'] == _SHUTDOWN or 'ended' in record
        self._add(source, record, began + record['t'], now)
        return source.actor.name

    def lose(self, name, now):
        """Note that the node of a machine is gone; one that has ended is not lost."""
        source = self._sources.get(name)
        if source is not None and not source.is_over and not source.is_lost:
            source.is_lost = True
            self._add_lost(source, now, now)

    def ready(self, now):
        """Yield the lines that have waited long enough, in order."""
        while self._waiting and self._due <= now:
            yield self._take()

    def rest(self):
        """Yield all lines that wait, in order."""
        while self._waiting:
            yield self._take()

    def next_look(self, due):
        """
        Return when a line has waited long enough, or nothing can prevent that something is late.

        `due` is when it is, in nanoseconds since the beginning of the run. None is for never.
        """
        found = [self._due] if self._waiting else []
        if due is not None and self.zero is not None:
            late = self.zero + due // MILLISECOND + 1
            if not self._waiting or self._waiting[0][0] > late:
                found.append(late + self._wait)
        return min(found, default=None)

    def settled(self, now):
        """Return the time before which no line is expected; an earlier line is too late."""
        first = self._waiting[0][0] if self._waiting else now
        self._passed = max(self._passed, min(now - self._wait, first))
        return self._passed

    def since_zero(self, time):
        """Return the time in nanoseconds since the beginning of the run."""
        return (time - self.zero) * MILLISECOND

    def conditions(self):
        """Yield what the verdicts depend on: what was not heard, or too late."""
        for name in self._expected:
            yield f'{name} not heard'
        for counts, what in ((+self._missing, 'not heard'), (self._late, 'too late')):
            for name, number in sorted(counts.items()):
                yield f'{_lines(number)} of {name} {what}'
        for name in sorted(self._returned):
            yield f'{name} lost and heard again'
        for fault, number in sorted(self._beyond.items()):
            yield f'{_lines(number)} left out, because {fault}'
        if self._unknown:
            yield f'{_lines(self._unknown)} of no robot of the swarm left out'

    @property
    def _due(self):
        """Return when the first line has waited long enough."""
        time, (heard, _, _) = self._waiting[0][0], self._waiting[0][-1]
        due = max(time, heard) + self._wait
        return max(due, self._first + self._start) if self._expected else due

    def _source(self, name):
        """Return the source of a machine, which may be new; raise KeyError for no robot."""
        if name not in self._sources:
            check_robot(name, self._machines)
            robot = name.partition('.')[0]
            machine = self._machines[machine_of(name)]
            who = Robot(robot, robot.partition('[')[0])
            functions = tuple(machine.functions)
            self._sources[name] = _Source(Actor(name, who, tuple(machine.states), functions))
        return self._sources[name]

    def _add_lost(self, source, time, now):
        lists = {key: [] for key in _LISTS}
        lists['configuration'] = source.last['configuration']
        record = {
            't': time - source.began,
            'began': source.began,
            'member': source.actor.name,
            'event': LOST,
            **lists,
        }
        self._add(source, record, time, now)

    def _add(self, source, record, time, now):
        # Of lines at one time, starts come first, then those of one machine after the other.
        key = (time, record['event'] is not None, source.actor.name, source.next)
        heapq.heappush(self._waiting, (*key, next(self._heard), (now, source.actor, record)))

    def _take(self):
        if self.zero is None:
            self.zero = min(each[-1][-1]['began'] for each in self._waiting)
        time, _, name, *_, (_, actor, record) = heapq.heappop(self._waiting)
        if time < self._passed:
            self._late[name] += 1
        self._passed = max(self._passed, time)
        return Line(
            time=self.since_zero(self._passed),
            actor=actor,
            event=record['event'],
            envelope=Envelope(record.get('envelope', {}).get('sender', '')),
            deferred=record.get('deferred', False),
            recalled=record.get('recalled', False),
            configuration=record['configuration'],
            started=record['started'],
            cancelled=record['cancelled'],
            sent=record['sent'],
            values=record.get('values', {}),
            record=record,
        )


class _BeyondError(KeyError):
    """A role has fewer robots."""

    def __str__(self):
        return self.args[0]


def machine_of(name):
    """Return the key of the machine of a robot or its part: `uav.camera` for `uav[0].camera`."""
    robot, _, part = name.partition('.')
    role = robot.partition('[')[0]
    return f'{role}.{part}' if part else role


def check_robot(name, machines):
    """Raise KeyError, which says why, if a name is not that of a robot or part of the swarm."""
    found = _ROBOT.fullmatch(name)
    if found is None or machine_of(name) not in machines:
        raise KeyError(f'{name} is no robot of the swarm')
    most = machines[machine_of(name)].most
    if most is not None and int(found['number']) >= most:
        robots = 'robot' if most == 1 else 'robots'
        raise _BeyondError(f'{name} is none of the {most} {robots} of role {found["role"]}')


def _checked(record):
    """Return a line; raise an error of Python for one that is no line of a node."""
    numbers = (record[key] for key in ('t', 'began', 'number'))
    names = (record['event'] or '', record.get('envelope', {}).get('sender', ''))
    if (
        any(not isinstance(each, int) or each < 0 for each in numbers)
        or any(not isinstance(each, str) for each in names)
        or any(not isinstance(record[key], list) for key in _LISTS)
        or not isinstance(record.get('values', {}), dict)
    ):
        raise ValueError('not a line of a trace')
    return record


def _lines(number):
    return f'{number} line' if number == 1 else f'{number} lines'
