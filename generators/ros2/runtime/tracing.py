"""Trace of the machine: a line for each macrostep, as in `swarmc simulate --trace json`."""

from itertools import count
import json
from pathlib import Path
import time
from typing import Any, NamedTuple

from rclpy.duration import Duration
from rclpy.logging import LoggingSeverity
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

from . import engine
from .engine import Observer, Run
from .parameters import StartError
from .values import MILLISECOND, to_json

_PATIENCE = 1.0
"""Time for those who follow the node to hear its end, in seconds; they may be out of reach."""
_PAUSE = 0.02
_NOW = Duration()
HISTORY = 1000
"""Number of lines that a node keeps for those who subscribe later."""
_LAST = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_HISTORY = QoSProfile(depth=HISTORY, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class OfMessage(NamedTuple):
    """Condition on the message of an event that is heard, or sent; the name is that of the act."""

    act: str
    event: str
    holds: Any


class Trace(Observer):
    """
    Passes each line to a listener, with the transitions that were taken.

    Each line has the time since the start, and when that was: `began`, in milliseconds since 1970.
    `conditions` are watched functions of the machine, or conditions on messages, by their text in
    the model.
    """

    def __init__(self, member, clock, conditions, listener):
        self._member = member
        self._clock = clock
        self._began = clock()
        self._numbers = count()
        self._conditions = conditions
        self._listener = listener
        self._line = None
        self._taken = []
        self._addresses = []
        self._heard = None
        self._sent = []
        self._instance = None
        self.on_end = lambda event: None
        """Called with the event of each activity that has ended."""

    def begin(self, instance, event):
        """Begin the line of an external event, None for the start."""
        self.flush()
        self._instance = instance
        self._taken = []
        self._heard = event
        self._sent = []
        self._line = {
            't': (self._clock() - self._began) // MILLISECOND,
            'began': self._began // MILLISECOND,
            'number': next(self._numbers),
            'member': self._member,
            'event': event.name if event is not None else None,
            'configuration': [],
            'entered': [],
            'exited': [],
            'taken': [],
            'started': [],
            'cancelled': [],
            'sent': [],
        }
        data = to_json(event.data) if event is not None else None
        if data:
            self._line['data'] = data
        if event is not None and event.envelope.sender:
            about = {'sender': event.envelope.sender, 'sent': event.envelope.sent}
            self._line['envelope'] = about
        self._addresses = []

    def flush(self):
        """Pass the complete line to the listener, if there is one."""
        line, self._line = self._line, None
        if line is None:
            return
        final = self._instance.final
        line['configuration'] = [final] if final else self._instance.configuration.innermost
        if final:
            line['ended'] = True
        if self._conditions:
            line['values'] = dict(self._values())
        self._listener(line, self._taken, final)

    def _values(self):
        """Yield the conditions with their truth, those on messages if there is such a message."""
        for text, condition in self._conditions.items():
            if not isinstance(condition, OfMessage):
                yield text, self._holds(condition, None)
                continue
            events = self._sent if condition.act == 'sends' else [self._heard]
            named = [event for event in events if event and event.name == condition.event]
            if named:
                yield text, any(self._holds(condition.holds, event) for event in named)

    def _holds(self, condition, event):
        """Return the truth of a condition; one without a value does not hold."""
        try:
            return bool(condition(self._instance, event))
        except engine.FAILURES:
            return False

    def received(self, instance, event):
        """Begin a line for a delay or an activity; `begin` does so for other events."""
        if event.origin is not None:
            self.begin(instance, event)
        if isinstance(event.origin, Run):
            self.on_end(event)

    def ignored(self, instance, event):
        """Note that the event enables no transition."""
        if self._line is not None:
            self._line['ignored'] = True

    def deferred(self, instance, event):
        """Note that the event is kept."""
        if self._line is not None:
            self._line['deferred'] = True

    def dropped(self, instance, event):
        """Note a kept event that was forgotten because there are too many."""
        if self._line is not None:
            self._line.setdefault('dropped', []).append(event.name)

    def recalled(self, instance, event):
        """Begin a line for a kept event that is processed now."""
        self.begin(instance, event)
        self._line['recalled'] = True

    def scheduled(self, instance, event, delay):
        """Note an event that will be sent."""
        if self._line is not None:
            sent = {'event': event.name, 'to': event.envelope.to, 'after': delay // MILLISECOND}
            self._line.setdefault('scheduled', []).append(sent)

    def withdrawn(self, instance, event):
        """Note an event that will not be sent any more."""
        if self._line is not None:
            self._line.setdefault('withdrawn', []).append(event.name)

    def entered(self, instance, state):
        """Note an entered state."""
        self._note('entered', state.id)

    def exited(self, instance, state):
        """Note an exited state, except the final state in which the machine ended."""
        if instance.final is None:
            self._note('exited', state.id)

    def taken(self, instance, transition):
        """Note a taken transition."""
        self._taken.append(transition)
        name = instance.machine.called(transition)
        # Several regions may take the same transition of the state around them.
        if self._line is not None and name not in self._line['taken']:
            self._line['taken'].append(name)

    def started(self, instance, run):
        """Note a started activity."""
        self._note('started', run.activity.name)

    def cancelled(self, instance, run):
        """Note a cancelled activity."""
        self._note('cancelled', run.activity.name)

    def sent(self, instance, event):
        """Note a sent event, and the addresses of all if one has an address."""
        self._note('sent', event.name)
        self._sent.append(event)
        self._addresses.append(event.envelope.to)
        if self._line is not None and any(each is not None for each in self._addresses):
            self._line['to'] = self._addresses

    def _note(self, key, name):
        if self._line is not None:
            self._line[key].append(name)


class Output:
    """
    Writes the lines of a trace to the topics of the node, to its log, and to a file.

    An earlier file is overwritten, or with `keep` gets a number.
    """

    def __init__(self, node, machine, member, path, keep=False):
        self._node = node
        self._machine = machine
        self._member = member
        try:
            if keep and Path(path).exists():
                Path(path).rename(_numbered(Path(path)))
            self._file = open(path, 'w', encoding='utf-8') if path else None
        except OSError as error:
            raise StartError(f'the trace cannot be written: {error}') from None
        self._state = node.create_publisher(String, '~/state', _LAST)
        self._transitions = node.create_publisher(String, '~/transitions', _HISTORY)

    def tell(self, line, taken, final):
        """Write a line, with the transitions taken and the final state of the machine, if any."""
        text = _as_json(line)
        self._transitions.publish(String(data=text))
        if self._file is not None:
            self._file.write(text + '\n')
            self._file.flush()
        if line['entered'] or line['exited'] or line['event'] is None:
            state = {
                'machine': self._machine,
                'member': self._member,
                'configuration': line['configuration'],
                'final': final,
            }
            self._state.publish(String(data=_as_json(state)))
        places = ', '.join(each.origin for each in taken if each.origin)
        where = ', '.join(line['configuration'])
        what = line['event'] or 'start'
        # Not `info`: rclpy inspects the frames of its callers, which takes longer than the rest.
        said = f'{what} -> {where} ({places})' if places else f'{what} -> {where}'
        if line.get('ignored'):
            said = f'{what} (ignored in {where})'
        self._node.get_logger().log(said, LoggingSeverity.INFO)

    def release(self):
        """Let followers hear the last line; destroy the publishers, and close the file."""
        end = time.monotonic() + _PATIENCE
        while not self._is_heard() and time.monotonic() < end:
            time.sleep(_PAUSE)
        self._node.destroy_publisher(self._state)
        self._node.destroy_publisher(self._transitions)
        if self._file is not None:
            self._file.close()

    def _is_heard(self):
        """Return True if all followers have all lines, as far as the middleware can tell."""
        try:
            # Not with a time: rclpy keeps the lock of Python meanwhile, and all robots would wait.
            return not self._node.context.ok() or self._transitions.wait_for_all_acked(_NOW)
        except RuntimeError:
            return True  # it cannot tell


def _numbered(path):
    """Return a path that does not exist, with a number: `uav[0].1.jsonl`."""
    made = (path.with_suffix(f'.{number}{path.suffix}') for number in count(1))
    return next(each for each in made if not each.exists())


_as_json = json.JSONEncoder(ensure_ascii=False).encode
