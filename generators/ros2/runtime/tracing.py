"""Trace of the machine: a line for each macrostep, as in `swarmc simulate --trace json`."""

import json

from .engine import Observer
from .values import to_json


class Trace(Observer):
    """Passes each line to a listener, with the transitions that were taken."""

    def __init__(self, member, clock, listener):
        self._member = member
        self._clock = clock
        self._listener = listener
        self._line = None
        self._taken = []
        self._instance = None

    def begin(self, instance, event):
        """Begin the line of an external event, None for the start."""
        self.flush()
        self._instance = instance
        self._taken = []
        self._line = {
            't': self._clock() // 1_000_000,
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

    def flush(self):
        """Pass the complete line to the listener, if there is one."""
        line, self._line = self._line, None
        if line is None:
            return
        final = self._instance.final
        line['configuration'] = [final] if final else self._instance.configuration.innermost
        self._listener(line, self._taken)

    def received(self, instance, event):
        """Begin a line for a delay or an activity; `begin` does so for other events."""
        if event.origin is not None:
            self.begin(instance, event)

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
        """Note a sent event."""
        self._note('sent', event.name)

    def _note(self, key, name):
        if self._line is not None:
            self._line[key].append(name)


as_json = json.JSONEncoder(ensure_ascii=False).encode
"""Return a line as JSON."""
