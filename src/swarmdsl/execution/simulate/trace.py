"""What happened, a line a macrostep."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from typing import Any

from swarmdsl.base.records import dataclass, field
from swarmdsl.execution.engine import (
    Event,
    Instance,
    InstanceLike,
    LoopError,
    Observer,
    Run,
    State,
    Transition,
)
from swarmdsl.execution.simulate.actors import Actor
from swarmdsl.execution.simulate.clock import Clock
from swarmdsl.execution.simulate.durations import MILLISECOND, SECOND

_LIMIT = 10_000
"""How many events a machine may look at while no time passes."""


@dataclass(slots=True)
class Line:
    """What one event led to. `event` is None for the start; names of states are their ids.

    `data` is that of the event, `messages` are those of the events in `sent`.
    """

    time: int
    actor: Actor
    event: str | None
    configuration: list[str] = field(default_factory=list)
    entered: list[str] = field(default_factory=list)
    exited: list[str] = field(default_factory=list)
    started: list[str] = field(default_factory=list)
    cancelled: list[str] = field(default_factory=list)
    sent: list[str] = field(default_factory=list)
    messages: list[Any] = field(default_factory=list)
    taken: list[Transition] = field(default_factory=list)
    data: Any = None


class Trace(Observer):
    """Makes the lines, and hands each to the listeners when the machine has come to rest."""

    def __init__(self, clock: Clock, listeners: Sequence[Callable[[Line], None]]) -> None:
        self._clock = clock
        self._listeners = listeners
        self._actors: dict[InstanceLike, Actor] = {}
        self._line: Line | None = None
        self._instance: InstanceLike | None = None
        self._busy: dict[InstanceLike, tuple[int, int]] = {}

    def watch(self, instance: Instance, actor: Actor) -> None:
        """Listen to an instance."""
        self._actors[instance] = actor
        instance.observer = self

    def begin(self, instance: InstanceLike, event: str | None, data: Any = None) -> None:
        """An event from outside is looked at: the line of the one before is complete.

        Raises LoopError where this happens again and again while no time passes.
        """
        self.flush()
        now = self._clock.now
        since, count = self._busy.get(instance, (now, 0))
        count = count + 1 if since == now else 1
        self._busy[instance] = (now, count)
        self._instance = instance
        if count > _LIMIT:
            raise LoopError(instance.machine.name, instance.configuration.innermost)
        self._line = Line(now, self._actors[instance], event, data=data)

    @property
    def actor(self) -> Actor:
        """Whose event was looked at last."""
        assert self._instance is not None
        return self._actors[self._instance]

    def flush(self) -> None:
        """Hand out the line that is complete, if there is one."""
        line, self._line = self._line, None
        if line is None:
            return
        assert self._instance is not None
        final = self._instance.final
        # A machine that has ended has left all states: where it ended is worth more.
        line.configuration = [final] if final else self._instance.configuration.innermost
        for listener in self._listeners:
            listener(line)

    # ---- what an instance tells

    def received(self, instance: InstanceLike, event: Event) -> None:
        """Begin a line for a delay or an activity; others have begun theirs already."""
        if event.origin is not None:
            self.begin(instance, event.name, event.data)

    def entered(self, instance: InstanceLike, state: State) -> None:
        """Note it."""
        assert self._line is not None
        self._line.entered.append(state.id)

    def exited(self, instance: InstanceLike, state: State) -> None:
        """Note it, but for the final state in which the machine ended."""
        assert self._line is not None
        if instance.final is None:
            self._line.exited.append(state.id)

    def taken(self, instance: InstanceLike, transition: Transition) -> None:
        """Note it."""
        assert self._line is not None
        self._line.taken.append(transition)

    def started(self, instance: InstanceLike, run: Run) -> None:
        """Note it."""
        assert self._line is not None
        self._line.started.append(run.activity.name)

    def cancelled(self, instance: InstanceLike, run: Run) -> None:
        """Note it."""
        assert self._line is not None
        self._line.cancelled.append(run.activity.name)

    def sent(self, instance: InstanceLike, event: Event) -> None:
        """Note it."""
        assert self._line is not None
        self._line.sent.append(event.name)
        self._line.messages.append(event.data)


def as_json(line: Line) -> str:
    """A line for programs; times are in whole milliseconds."""
    called = line.actor.machine.called
    values = {
        "t": line.time // MILLISECOND,
        "member": line.actor.name,
        "event": line.event,
        "configuration": line.configuration,
        "entered": line.entered,
        "exited": line.exited,
        "taken": list(dict.fromkeys(map(called, line.taken))),
        "started": line.started,
        "cancelled": line.cancelled,
        "sent": line.sent,
    }
    if line.data:
        values["data"] = line.data
    return json.dumps(values, ensure_ascii=False, default=str)


def as_text(line: Line, width: int = 0) -> str:
    """A line for people: when, who, on what, where that led, and what was done.

    Names of members are filled up to `width`.
    """
    who = f"{line.actor.name:<{width}}  " if line.actor.name is not None else ""
    head = f"{line.time / SECOND:>10.3f}  {who}{line.event or '(start)'}"
    if line.entered or line.exited:
        head += f" -> {', '.join(line.configuration)}"
    done = (("start", line.started), ("cancel", line.cancelled), ("send", line.sent))
    words = [f"{word} {', '.join(names)}" for word, names in done if names]
    return "; ".join([head, *words])
