"""Containers that follow the chart of their machine.

All containers of a machine share one userdata: a value that one state stores is visible to all
others at once, and no container overwrites it with an old one when it ends.
"""

import threading
import traceback

import smach

from . import engine
from .chart import Chart
from .states import Charted, joined


class StateMachine(Charted, smach.StateMachine):
    """A state with states inside, one of which is active at a time.

    `on` has its transitions; `outcomes` are further outcomes: of states inside that leave it, and
    of internal transitions of the states around. `initial` is the path of its initial state, by
    default the state that is added first.
    """

    def __init__(
        self,
        on=(),
        outcomes=(),
        initial=None,
        after=None,
        on_entry=None,
        on_exit=None,
        defer=(),
    ):
        own = self.describe(on, after, on_entry, on_exit, defer)
        smach.StateMachine.__init__(self, [*own, *outcomes, 'preempted'])
        self._initial = initial

    def tables(self):
        """Return the tables of the states inside for the engine."""
        return [child.table() for child in self.get_children().values()]

    def initial_path(self):
        """Return the path of the initial state."""
        return (joined(self.path, self._initial or self.get_initial_states()[0]),)

    def next_label(self):
        """Return the label of the next state in SMACH."""
        with self.chart.changed:
            return self.following.entered[0]

    def execute(self, parent_ud=None):
        """Follow the chart from state to state until this one is left."""
        activation = self.follow()
        self.set_initial_state([self.next_label()])
        outcome = smach.StateMachine.execute(self, parent_ud)
        self.wait(activation)
        return activation.outcome or outcome or 'preempted'


class Machine(StateMachine):
    """The whole state machine; it ends in one of `outcomes`, its final states."""

    def __init__(self, outcomes, userdata, initial=None):
        super().__init__(outcomes=outcomes, initial=initial)
        self.userdata = userdata
        self._finals = outcomes

    def __exit__(self, *failure):
        """Create the chart after all states have been added."""
        result = super().__exit__(*failure)
        if failure == (None, None, None):
            self.chart = Chart(self)
        return result

    def tables(self):
        """Return the tables of the states inside, and of the final states."""
        finals = [engine.State(name, engine.Kind.FINAL) for name in self._finals]
        return [*super().tables(), *finals]

    def request_preempt(self):
        """Leave all states; states that call a server end when it has stopped."""
        self.chart.leave()

    def execute(self, parent_ud=None):
        """Run the machine to its end."""
        self.chart.enter()
        outcome = super().execute(parent_ud)
        if self.chart.failure is not None:
            raise self.chart.failure
        return outcome


class Concurrence(Charted, smach.Concurrence):
    """A state with regions, all of which are active while it is.

    `on` has its transitions; `outcome_map` has the outcomes of regions that cause each outcome;
    `outcomes` are outcomes of internal transitions of the states around.
    """

    kind = engine.Kind.PARALLEL

    def __init__(
        self,
        on=(),
        outcome_map=None,
        outcomes=(),
        after=None,
        on_entry=None,
        on_exit=None,
        defer=(),
    ):
        own = self.describe(on, after, on_entry, on_exit, defer)
        ways = outcome_map or {}
        smach.Concurrence.__init__(
            self,
            [*own, *ways, *outcomes, 'preempted'],
            default_outcome='preempted',
            outcome_map=ways,
        )

    def tables(self):
        """Return the tables of the regions for the engine."""
        return [region.table() for region in self.get_children().values()]

    def execute(self, parent_ud=None):
        """Run all regions until the state is left."""
        activation = self.follow()
        self.check_consistency()
        self._child_outcomes = dict.fromkeys(self._states)
        self.call_start_cbs()
        threads = [
            threading.Thread(name='concurrent_split:' + label, target=self._run, args=(label,))
            for label in self._states
        ]
        for thread in threads:
            thread.daemon = True
            thread.start()
        for thread in threads:
            while thread.is_alive() and not smach.is_shutdown():
                thread.join(0.05)
        self.wait(activation)
        ended = set(self._child_outcomes.items())
        ways = [way for way, ends in self._outcome_map.items() if ended >= set(ends.items())]
        outcome = activation.outcome or next(iter(ways), 'preempted')
        self.call_termination_cbs(list(self._states), outcome)
        return outcome

    def _run(self, label):
        try:
            outcome = self._states[label].execute(self.userdata)
        except Exception:
            outcome = 'preempted'
            self.chart.fail(smach.InvalidUserCodeError(traceback.format_exc()))
        self._child_outcomes[label] = outcome
        self.call_transition_cbs()
