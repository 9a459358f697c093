"""States and machines in SMACH that follow the engine."""

import smach

STOPPED = 'preempted'
"""Outcome of states that end because the machine is stopped."""


class State(smach.State):
    """
    A state of a chart, which ends when the engine has left it.

    `path` is its id in the chart.
    """

    def __init__(self, chart, path, outcomes):
        super().__init__(outcomes)
        self._chart = chart
        self._path = path

    def execute(self, userdata):
        """Wait until the engine has left the state; return the outcome."""
        return self._chart.visit(self._path, self._chart.memory)

    def request_preempt(self):
        """End the whole machine."""
        _stop(self._chart)


class ActionState(State):
    """A state that calls an action server while it is active."""


class ServiceState(State):
    """A state that calls a service."""


class Junction(State):
    """A state that leads to the state that the engine has entered, and ends at once."""


class Machine(smach.StateMachine):
    """
    The whole machine of a chart.

    Its userdata, which all containers inside share, has the params and variables. When preempted,
    it ends as soon as no server works for it any more; if it has not begun, it ends at the start.
    """

    def __init__(self, chart, outcomes):
        super().__init__(outcomes)
        self._chart = chart

    def execute(self, parent_ud=None):
        """Run the machine from its beginning to its end."""
        _share(self, self.userdata)
        self._chart.memory = self.userdata
        try:
            return super().execute(parent_ud)
        finally:
            self.recall_preempt()

    def request_preempt(self):
        """Make the engine leave all states."""
        _stop(self._chart)

    def recall_preempt(self):
        """Allow the machine to run when it is executed."""
        self._chart.is_closed = False


def check(container):
    """Check a container and all containers inside for consistency; raise errors of SMACH."""
    container.check_consistency()
    for child in container.get_children().values():
        if hasattr(child, 'get_children'):
            check(child)


def _share(container, userdata):
    container.userdata = userdata
    for child in container.get_children().values():
        if hasattr(child, 'get_children'):
            _share(child, userdata)


def _stop(chart):
    chart.is_closed = True
    chart.cancel()
