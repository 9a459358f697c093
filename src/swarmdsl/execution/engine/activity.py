"""What goes on outside while a state is active: delays, activities, and the servers of these."""

from __future__ import annotations

from typing import Any, Protocol

from .table import Activity, Event, InstanceLike


class Timer:
    """An event of an instance that comes after a delay.

    It is `over` when it was cancelled or looked at. `handle` is what the world knows it by.
    """

    __slots__ = ("event", "handle", "id", "instance", "over")

    def __init__(self, instance: InstanceLike, event: Event, id_: str) -> None:
        self.instance = instance
        self.event = Event(event.name, event.data, self)
        self.id = id_
        self.handle: Any = None
        self.over = False

    def fire(self) -> None:
        """Let the instance receive the event."""
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

    It is `over` for the machine when its state was left or its end was looked at, and has
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
        """Say how it ended: `succeeded`, `aborted` or `preempted`."""
        if self.ended:
            return
        self.ended = True
        if self.over:
            assert self.instance.servers is not None
            self.instance.servers.stopped(self)
        else:
            self.instance.receive(Event(self.activity.events[outcome], result, self))


class Servers:
    """What is still stopping on the servers of a robot, and what waits for that.

    Instances that share servers, those of one robot, share this.
    """

    __slots__ = ("_stopping", "_waiting")

    def __init__(self) -> None:
        self._stopping: list[Run] = []
        self._waiting: list[Run] = []

    def start(self, run: Run) -> None:
        """Start a run, as soon as nothing is stopping on its server."""
        if any(other.activity.server == run.activity.server for other in self._stopping):
            self._waiting.append(run)
        else:
            run.instance.world.start(run)

    def cancel(self, run: Run) -> None:
        """Stop a run whose state was left; one that only waits is forgotten."""
        if run in self._waiting:
            self._waiting.remove(run)
        else:
            self._stopping.append(run)
            run.instance.world.cancel(run)

    def stopped(self, run: Run) -> None:
        """Start what waited for the server of a run that has ended."""
        self._stopping.remove(run)
        waiting, self._waiting = self._waiting, []
        for other in waiting:
            self.start(other)
