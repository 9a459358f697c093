"""States and machines in SMACH that follow the engine."""

import smach

STOPPED = 'preempted'
"""Outcome of states that end because the machine is stopped."""


class State(smach.State):
    """
    A state of a chart: it is over when the engine has left it.

    `path` is its id in the chart; it can end with these `outcomes`.
    """

    def __init__(self, chart, path, outcomes):
        super().__init__(outcomes)
        self._chart = chart
        self._path = path

    def execute(self, userdata):
        """Be active as long as the engine says."""
        return self._chart.visit(self._path, self._chart.memory)

    def request_preempt(self):
        """Let the whole machine end."""
        _stop(self._chart)


class ActionState(State):
    """A state that has an action server work while it is active."""


class ServiceState(State):
    """A state that calls a service."""


class Junction(State):
    """A state that leads to the one that the engine has entered; it is over at once."""


class Machine(smach.StateMachine):
    """
    The whole machine of a chart, with these `outcomes`.

    Its userdata, which all containers inside share, have the params and variables. Preempted, it
    ends as soon as no server works for it any more; before it has begun, it ends when it does.
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
        """Let the engine leave all states."""
        _stop(self._chart)

    def recall_preempt(self):
        """Let the machine run when it is executed."""
        self._chart.is_closed = False


def check(container):
    """Have SMACH check that a container and those inside are complete; raise what it finds."""
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
