"""Delays and activities of active states, and the servers of activities."""

from __future__ import annotations

from typing import Any, Protocol

from .table import Activity, Event, InstanceLike


class Timer:
    """Delayed event of an instance.

    It is `over` when it was cancelled or processed. `handle` identifies it in the world. If it
    has a `message`, that is sent to the world when the event is processed.
    """

    __slots__ = ("event", "handle", "id", "instance", "message", "over")

    def __init__(
        self, instance: InstanceLike, event: Event, id_: str, message: Event | None = None
    ) -> None:
        self.instance = instance
        self.event = Event(event.name, event.data, self)
        self.id = id_
        self.message = message
        self.handle: Any = None
        self.over = False

    def fire(self) -> None:
        """Send the event to the instance."""
        if not self.over:
            self.instance.receive(self.event)


class ActivityHost(Protocol):
    """Executor of activities: the part of a `World` that runs use."""

    def start(self, run: Run) -> None:
        """Start an activity; call `run.end` when it has ended."""

    def cancel(self, run: Run) -> None:
        """Ask an activity to stop; call `run.end` when its server is free again."""


class ActivityOwner(InstanceLike, Protocol):
    """An instance whose states have activities."""

    @property
    def world(self) -> ActivityHost:
        """The host of the activities."""

    @property
    def servers(self) -> Servers | None:
        """The servers of the robot; None before the first activity starts."""


class Run:
    """One run of the activity of a state.

    It is `over` for the machine when its state was exited or its end was processed, and has
    `ended` when its server is free again.
    """

    __slots__ = ("activity", "ended", "goal", "instance", "over", "state")

    def __init__(self, instance: ActivityOwner, state: int, activity: Activity) -> None:
        self.instance = instance
        self.state = state
        self.activity = activity
        self.goal: Any = None
        self.over = False
        self.ended = False

    def end(self, outcome: str, result: Any = None) -> None:
        """End the run; the outcome is `succeeded`, `aborted` or `preempted`."""
        if self.ended:
            return
        self.ended = True
        if self.over:
            assert self.instance.servers is not None
            self.instance.servers.stopped(self)
        else:
            self.instance.receive(Event(self.activity.events[outcome], result, self))


class Servers:
    """Queue of runs for the servers of a robot that are still stopping.

    Shared by all instances of one robot.
    """

    __slots__ = ("_stopping", "_waiting")

    def __init__(self) -> None:
        self._stopping: list[Run] = []
        self._waiting: list[Run] = []

    def start(self, run: Run) -> None:
        """Start a run as soon as no other run is stopping on its server."""
        if any(other.activity.server == run.activity.server for other in self._stopping):
            self._waiting.append(run)
        else:
            run.instance.world.start(run)

    def cancel(self, run: Run) -> None:
        """Cancel a run whose state was exited; drop a run that only waits."""
        if run in self._waiting:
            self._waiting.remove(run)
        else:
            self._stopping.append(run)
            run.instance.world.cancel(run)

    def stopped(self, run: Run) -> None:
        """Start the runs that waited for the server of an ended run."""
        self._stopping.remove(run)
        waiting, self._waiting = self._waiting, []
        for other in waiting:
            self.start(other)
