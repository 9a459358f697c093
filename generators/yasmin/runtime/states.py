"""States in YASMIN that follow the engine."""

import yasmin

STOPPED = 'canceled'
"""Outcome of states that end because the machine is stopped."""


class State(yasmin.State):
    """
    A state of a chart: it is over when the engine has left it.

    Subclasses say its id in the `chart` as `path`, and with which `outcomes` it can end.
    """

    chart = None
    path = ''
    outcomes = ()

    def __init__(self):
        super().__init__(set(self.outcomes))
        if hasattr(self, 'set_description'):  # since YASMIN 5.0
            self.set_description(self.__doc__)

    def execute(self, blackboard):
        """Be active as long as the engine says."""
        return self.chart.visit(self.path, blackboard)

    def cancel_state(self):
        """Let the whole machine end."""
        super().cancel_state()
        self.chart.cancel()


class ActionState(State):
    """A state that has an action server work while it is active."""


class ServiceState(State):
    """A state that calls a service."""


class Junction(State):
    """A state that leads to the one that the engine has entered; it is over at once."""
