"""States in YASMIN that follow the engine."""

import yasmin

STOPPED = 'canceled'
"""Outcome of states that end because the machine is stopped."""


class State(yasmin.State):
    """
    A state of a chart, which ends when the engine has left it.

    Subclasses define its `path`, which is its id in the `chart`, and its `outcomes`.
    """

    chart = None
    path = ''
    outcomes = ()

    def __init__(self):
        super().__init__(set(self.outcomes))
        if hasattr(self, 'set_description'):  # since YASMIN 5.0
            self.set_description(self.__doc__)

    def execute(self, blackboard):
        """Wait until the engine has left the state; return the outcome."""
        return self.chart.visit(self.path, blackboard)

    def cancel_state(self):
        """End the whole machine."""
        super().cancel_state()
        self.chart.cancel()


class ActionState(State):
    """A state that calls an action server while it is active."""


class ServiceState(State):
    """A state that calls a service."""


class Junction(State):
    """A state that leads to the state that the engine has entered, and ends at once."""
