"""Automaton of one robot, found by running its machines on each input in each state."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import reduce
from operator import or_
from typing import Any

from swarmdsl.execution import monitor
from swarmdsl.execution.engine import NO_ENVELOPE, Envelope, Event
from swarmdsl.execution.monitor import LOST
from swarmdsl.execution.simulate.actors import Actor
from swarmdsl.execution.simulate.clock import Clock
from swarmdsl.execution.simulate.expressions import SELF
from swarmdsl.execution.simulate.members import DEPARTED
from swarmdsl.execution.simulate.properties import claim_of, conditions
from swarmdsl.execution.simulate.trace import Line
from swarmdsl.execution.verify.alphabet import Alphabet, frozen
from swarmdsl.execution.verify.body import Body, Input, Task
from swarmdsl.execution.verify.kind import Kind
from swarmdsl.execution.verify.limits import Budget
from swarmdsl.execution.verify.moves import Look, Moment, Move, Slot
from swarmdsl.execution.verify.slots import Occupied, carried, occupied
from swarmdsl.ir import Count, Fact


class Automaton:
    """States and moves of a kind of robot.

    `steps` are the moves of each state, None of those that were not looked at; `heard` are those
    that messages cause. A robot keeps one deferred event of a name: more stay on their way, as
    `late`. Messages arrive in any order, so that this leaves out nothing.
    """

    def __init__(self, kind: Kind, alphabet: Alphabet) -> None:
        self.kind = kind
        self.alphabet = alphabet
        self.replays = 0
        self.is_too_large = False
        """True if it has more states, or moves, than are looked at."""
        self.steps: list[list[Move] | None] = []
        self.heard: list[dict[int, Move]] = []
        self.late: list[set[int]] = []
        self.losses: list[Move | None] = []
        """For each state, the loss of the robot; None where it is lost, or cannot be."""
        self.is_lost: list[bool] = []
        self.first: Move
        self._keys: dict[Any, int] = {}
        self._origins: list[tuple[int, Input] | None] = []
        self.looks: list[Look] = []
        self.tasks: list[frozenset[Task]] = []
        """Tasks of each state: what is over some time, however long it takes."""
        self.slots: list[list[Slot]] = []
        """Running activities and delays of each state, in the order of its representative."""
        self._labels: list[list[Any]] = []
        self.deferred: list[set[str]] = []
        """Names of the deferred events of each state."""
        self.values: list[tuple[tuple[str, Any], ...]] = []
        """For each state, the values of the variables that decide on anything."""
        self._has = conditions(self._data)
        self._facts = monitor.Facts()
        self._bits = [self._facts.bit(_plain(fact), None) for fact in kind.facts]
        self._momentary = sum(
            1 << number for number, bit in enumerate(self._bits) if bit & self._facts.momentary
        )
        self.gone = 1 << len(self._bits)
        """Fact of lost robots, behind the others."""
        self._kinds = {actor: self._facts.kind_of(actor) for actor in kind.cast}
        self._body: Body | None = None
        self._listening: dict[str, bool] = {}
        self._begin()

    # ---- finding the states

    def expand(self, number: int) -> None:
        """Find the moves of a state, without those that other robots cause."""
        body = self._at(number)
        given = list(body.inputs()) if body.running else []
        made = []
        for each in given:
            for choice in self._choices(each):
                made.append(self._try(number, choice))
        if body.running:
            for event, messages in self.kind.outside.messages.items():
                once = self.kind.outside.once.get(event, frozenset())
                for index in range(len(messages)):
                    if index in once and (event, index) in body.used:
                        continue
                    made.append(self._try(number, Input("outside", -1, event, index)))
        self.steps[number] = made
        if self.kind.can_be_lost and not self.is_lost[number] and self._shows_loss(body):
            self.losses[number] = self._try(number, Input("lose", -1, LOST))

    def hear(self, number: int, message: int) -> None:
        """Find the move of a state when a message arrives."""
        event = self.alphabet.messages[message].event
        given = Input("hear", -1, event.name, message)
        if event.name == DEPARTED and not self._misses(self._at(number), event):
            # All of them are missed: it cannot be on its way.
            self.late[number].add(message)
        elif self._is_late(number, given):
            self.late[number].add(message)
        else:
            self.heard[number][message] = self._try(number, given)

    def listens(self, message: int) -> bool:
        """Return True if a machine handles a message that can be for such a robot."""
        event = self.alphabet.messages[message].event
        name = event.name
        if name not in self._listening:
            self._listening[name] = self.kind.listens(name)
        if not self._listening[name]:
            return False
        robot = self.kind.cast[0].robot
        if self.alphabet.demands.identity:
            return robot.name != event.envelope.sender and robot.is_meant_by(event.envelope.to)
        to = event.envelope.to
        return to is None or to == robot.role or to.partition("[")[0] == robot.role

    def numbers_of_values(self) -> dict[str, int]:
        """Return how many values the variables have that decide on anything."""
        values: dict[str, set[Any]] = {}
        for each in self.values:
            for name, value in each:
                values.setdefault(name, set()).add(value)
        return {name: len(found) for name, found in values.items()}

    def lengths(self) -> set[int]:
        """Return the lengths of all delays."""
        heard = (move for moves in self.heard for move in moves.values())
        own = (move for moves in self.steps for move in moves or ())
        return {
            each.length
            for move in (self.first, *heard, *own)
            for each in move.carried
            if each.length is not None
        }

    def configurations(self) -> Iterator[Any]:
        """Yield for each state which states of its machines are active."""
        yield from (tuple(each[:3] for each in machines) for (machines, *_), _ in self._keys)

    def waiting(self) -> Iterator[Any]:
        """Yield for each state the deferred events."""
        yield from (tuple(each[4] for each in machines) for (machines, *_), _ in self._keys)

    @property
    def is_complete(self) -> bool:
        """True if all moves are known."""
        listened = [n for n in range(len(self.alphabet.messages)) if self.listens(n)]
        return all(
            steps is not None and all(number in heard or number in late for number in listened)
            for steps, heard, late in zip(self.steps, self.heard, self.late, strict=True)
        )

    # ---- running

    def apply(self, body: Body, given: Input, event: Event | None = None) -> None:
        """Let an input happen to a body; `event` is the very one that arrives."""
        match given.kind:
            case "end":
                state, outcome, result = given.choice
                values = self.kind.ends[given.name].results
                body.end(
                    given._replace(choice=state),
                    outcome,
                    values[result] if result is not None else None,
                )
            case "time":
                body.fire(given)
            case "inside":
                body.deliver_inside()
            case "outside":
                messages = self.kind.outside.messages[given.name]
                if given.choice in self.kind.outside.once.get(given.name, ()):
                    body.used.add((given.name, given.choice))
                body.receive(Event(given.name, messages[given.choice]))
            case "lose":
                body.lose()
            case "hear":
                body.receive(event or self._heard_event(body, given.choice))

    def _shows_loss(self, body: Body) -> bool:
        """Return True if anybody can tell that a robot is lost; not of all machines that ended."""
        return body.running or self.kind.has_heartbeat

    def _misses(self, body: Body, event: Event) -> bool:
        """Return True if one more robot can be given up."""
        return self.kind.departure(body, event, by_name=self._by_name) is not None

    @property
    def _by_name(self) -> bool:
        """True if it counts which robot is lost."""
        return any(path[:1] in ((), ("id",)) for path in self.alphabet.demands.fields(DEPARTED))

    def _heard_event(self, body: Body, message: int) -> Event:
        event = self.alphabet.messages[message].event
        if event.name == DEPARTED:
            found = self.kind.departure(body, event, by_name=self._by_name)
            assert found is not None, "nobody is given up twice"
            return found
        envelope = Envelope(event.envelope.sender, 0, event.envelope.to)
        return Event(event.name, event.data, envelope=envelope)

    def _choices(self, given: Input) -> Iterable[Input]:
        if given.kind != "end":
            yield given
            return
        state = given.choice
        ends = self.kind.ends[given.name]
        for index in range(len(ends.results)):
            yield given._replace(choice=(state, "succeeded", index))
        for outcome in ends.others:
            yield given._replace(choice=(state, outcome, None))

    def _path(self, number: int) -> list[Input]:
        path: list[Input] = []
        origin = self._origins[number]
        while origin is not None:
            number, given = origin
            path.append(given)
            origin = self._origins[number]
        return path[::-1]

    def _at(self, number: int) -> Body:
        """Return a body in a state, by playing the way there."""
        self.replays += 1
        body = self._body_at_rest()
        body.start()
        for given in self._path(number):
            body.clock.now += 1
            self.apply(body, given)
        body.clock.now += 1
        return body

    def _body_at_rest(self) -> Body:
        return Body(self.kind.cast, self.alphabet.system, Clock(), self.kind.crew, self.kind.silent)

    def _begin(self) -> None:
        body = self._body_at_rest()
        given = Input("start", -1, "")
        self.first = self._move(body, given, body.start, [0] * len(self.kind.cast), None)

    def _is_late(self, number: int, given: Input) -> bool:
        """Return True if an event would be deferred after another one, so that it may as well wait.

        It must not if a machine of the robot does anything else with it.
        """
        if given.name not in self.deferred[number]:
            return False
        body = self._at(number)
        self.apply(body, given)
        return all(line.deferred for line in body.lines)

    def _try(self, number: int, given: Input) -> Move:
        body = self._at(number)
        held = list(self.looks[number].held)
        return self._move(body, given, lambda: self.apply(body, given), held, number)

    def _move(
        self,
        body: Body,
        given: Input,
        act: Callable[[], None],
        held: list[int],
        source: int | None,
    ) -> Move:
        """Let a body act, and return what that shows; `held` are the facts of its machines."""
        shown: list[tuple[int, int]] = []
        numbers = {actor.name: n for n, actor in enumerate(body.cast)}

        def see(line: Line) -> None:
            actor = numbers[line.actor.name]
            held[actor], momentary = self._holding(line)
            if line.event == LOST:
                # No fact holds for a lost robot.
                held[:] = [self.gone] + [0] * (len(held) - 1)
            shown.append((actor, reduce(or_, held, momentary)))

        self._body, body.seen = body, see
        before, running = list(body.tasks()), occupied(body, self._shown)
        act()
        left = {id(each) for _, each in body.tasks()}
        ended = frozenset(task for task, each in before if id(each) not in left)
        last = len(shown) - 1
        moments = tuple(
            Moment(
                actor,
                line.event,
                tuple(dict.fromkeys(map(line.actor.machine.called, line.taken))),
                holding,
                line.ignored and not line.taken,
                tuple(line.started),
                tuple(line.sent),
                tuple(body.failures) if number == last else (),
                body.loop is not None and number == last,
            )
            for number, (line, (actor, holding)) in enumerate(zip(body.lines, shown, strict=True))
        )
        sends = tuple(map(self.alphabet.number, body.sent))
        origin = None if source is None else (source, given)
        after = occupied(body, self._shown)
        target = self._add(body, tuple(held), origin, after)
        taken = carried(running, after, self._labels[target])
        return Move(given, moments, sends, target, ended, taken)

    def _add(
        self,
        body: Body,
        held: tuple[int, ...],
        origin: tuple[int, Input] | None,
        running: Sequence[Occupied],
    ) -> int:
        key = (self._key(body), held)
        if key not in self._keys:
            self._keys[key] = len(self.steps)
            self.steps.append(None)
            self.losses.append(None)
            self.is_lost.append(body.is_lost)
            self.heard.append({})
            self.late.append(set())
            self.deferred.append(
                {each.name for one in body.instances for each in one._deferred or ()}
            )
            self._origins.append(origin)
            shown = [
                (number, state)
                for number, instance in enumerate(() if body.is_lost else body.instances)
                for state in (
                    [instance.final]
                    if instance.final is not None
                    else instance.configuration.innermost
                )
            ]
            quiet = not (body.runs or body.delays or body.inside)
            holding = reduce(or_, held, 0)
            self.looks.append(Look(not body.running, holding, tuple(shown), quiet, held))
            self.tasks.append(frozenset(task for task, _ in body.tasks()))
            self.slots.append([each.slot for each in running])
            self._labels.append([each.label for each in running])
            self.values.append(self._kept(body))
        return self._keys[key]

    def _data(self, actor: Actor) -> Mapping[str, Any]:
        assert self._body is not None
        found: Mapping[str, Any] = self._body.instances[list(self._body.cast).index(actor)].data
        return found

    def _kept(self, body: Body) -> tuple[tuple[str, Any], ...]:
        """Return the variables that decide on anything."""
        demands = self.alphabet.demands
        return tuple(
            (f"{instance.machine.name}.{name}", frozen(value))
            for instance in body.instances
            for name, value in instance.data.items()
            if name != SELF and demands.keeps(instance.machine.name, name)
        )

    def _key(self, body: Body) -> Any:
        """Return what decides on everything that a body does from now on."""
        if body.is_lost:
            return LOST
        machines = tuple(
            (
                instance.running,
                instance.final,
                instance.configuration.active,
                instance.configuration.histories,
                tuple(map(self._shown, instance._deferred or ())),
            )
            for instance in body.instances
        )
        runs = tuple(sorted((number, run.state) for number, run in body.runs))
        delays = tuple(
            sorted(
                (d.actor, d.timer.id, repr(d.timer.message and self._shown(d.timer.message)))
                for d in body.delays
            )
        )
        inside = tuple(map(self._shown, body.inside))
        missing = sorted(body.roster.missing) if body.roster is not None and body.running else ()
        kept = self._kept(body) if body.running else ()
        used = tuple(sorted(body.used)) if body.running else ()
        return machines, runs, delays, inside, kept, tuple(missing), used

    def _shown(self, event: Event) -> Any:
        """Return what decides of an event that waits."""
        envelope = event.envelope or NO_ENVELOPE
        sender = envelope.sender if self.alphabet.demands.identity else ""
        return (event.name, self.alphabet.shown(event), envelope.to or "", sender)

    def _holding(self, line: Line) -> tuple[int, int]:
        """Return the facts that hold for the machine of a line: lasting and momentary ones."""
        holding = self._kinds[line.actor].holding(line, self._has)
        found = sum(1 << number for number, bit in enumerate(self._bits) if holding & bit)
        return found & ~self._momentary, found & self._momentary


def close(
    automata: Sequence[Automaton], alphabet: Alphabet, states: int, moves: int, budget: Budget
) -> bool:
    """Find all states of some automata; return False if there are more.

    Each robot hears each message at any time: this includes whatever happens in a swarm. The
    search in an automaton ends at a number of states or moves, or with the time or memory.
    """
    changed = True
    complete = True
    while changed:
        changed = False
        for automaton in automata:
            number = 0
            while number < len(automaton.steps):
                is_known = automaton.steps[number] is not None
                automaton.is_too_large |= number >= states or automaton.replays >= moves
                if automaton.is_too_large or not (is_known or budget.allows(0)):
                    complete = False
                    break
                if not is_known:
                    automaton.expand(number)
                    changed = True
                for message in range(len(alphabet.messages)):
                    known = message in automaton.heard[number] or message in automaton.late[number]
                    if not known and automaton.listens(message):
                        automaton.hear(number, message)
                        changed = True
                number += 1
    return complete


def _plain(fact: Fact | Count) -> monitor.Fact | monitor.Count:
    claim = claim_of(fact)
    assert not isinstance(claim, monitor.Junction)
    return claim
