"""Messages between robots, by what decides on anything."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from swarmdsl import ir
from swarmdsl.base.records import dataclass
from swarmdsl.execution.engine import Event
from swarmdsl.execution.simulate.network.members import DEPARTED
from swarmdsl.execution.verify.abstraction.demands import Demands


@dataclass(frozen=True)
class Message:
    """A kind of message between robots: equal for all that decides on anything.

    If it `repeats`, it is sent again after a loss, perhaps until a later one takes its place.
    """

    number: int
    event: Event
    reliable: bool
    repeats: bool = False
    is_heartbeat: bool = False
    """True if it tells that a robot is lost: as often as that happens."""


class Alphabet:
    """Messages that robots send to each other.

    If the network may be `cut` for ever, reliable ones may be lost, too.
    """

    def __init__(self, system: ir.System | None, demands: Demands, *, is_cut: bool = False) -> None:
        self._is_cut = is_cut
        self.messages: list[Message] = []
        self.demands = demands
        self.system = system
        self._known: dict[Any, int] = {}

    def number(self, event: Event) -> int:
        """Return the number of the kind of a message."""
        sender = event.envelope.sender if self.demands.identity else ""
        key = (event.name, self.shown(event), event.envelope.to, sender)
        if key not in self._known:
            self._known[key] = len(self.messages)
            assert self.system is not None
            declared = self.system.events_by_name.get(event.name)
            delivery = declared.delivery if declared is not None else None
            # Of events that wait for a robot out of reach, `keep` drops the oldest.
            told = event.name == DEPARTED
            is_sure = delivery is not None and bool(delivery.reliable) and delivery.keep is None
            is_sure = is_sure and not self._is_cut
            repeats = delivery is not None and bool(delivery.reliable or delivery.latest)
            self.messages.append(Message(len(self.messages), event, told or is_sure, repeats, told))
        return self._known[key]

    def shown(self, event: Event) -> Any:
        """Return the data of an event that decide on anything."""
        paths = self.demands.fields(event.name)
        if event.name == DEPARTED:
            # Each robot counts the present ones by their roles.
            paths = [*paths, ("role",)]
        return tuple((path, _at(event.data, path)) for path in paths)


def _at(data: Any, path: Sequence[str]) -> Any:
    for name in path:
        data = data.get(name) if isinstance(data, dict) else None
    return frozen(data)


def frozen(value: Any) -> Any:
    """Return a value that can be compared and hashed; True is no number."""
    match value:
        case dict():
            return tuple(sorted((name, frozen(each)) for name, each in value.items()))
        case list() | tuple():
            return tuple(map(frozen, value))
        case bool():
            return ("true",) if value else ("false",)
    return value
