"""Data that decide what a swarm does, and values of those that come from outside.

Data that nothing demands are left out.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

from swarmdsl import ir
from swarmdsl.base.source import Span
from swarmdsl.codegen.shared.default_values import (
    default_result,
    default_value,
    field_type,
    result_fields,
)
from swarmdsl.execution.simulate.network.members import DEPARTED, JOINED
from swarmdsl.execution.verify.abstraction.doubt import Doubt
from swarmdsl.execution.verify.abstraction.places import Node
from swarmdsl.execution.verify.abstraction.representatives import (
    Part,
    Path,
    Values,
    combinations,
    is_covered,
)
from swarmdsl.execution.verify.abstraction.slice import Slice

_HEADERS = {
    "node": (ir.Named("swarmros", "EventHeader"),),
    "stamp": (ir.Named("std_msgs", "Header"), ir.Named("swarmros", "EventHeader")),
}
"""Fields that a sender fills in, with the types of the headers that have them."""


class Demands:
    """Data that decide on the behaviour of some machines.

    `data` are the first data of the instances of each machine, by its name. `extra` are the
    conditions of properties, each with the machine and the events that it is about. With `lengths`,
    those of delays count.
    """

    def __init__(
        self,
        system: ir.System,
        data: Mapping[str, Sequence[Mapping[str, Any]]],
        extra: Iterable[tuple[str, ir.Expression, tuple[str, ...]]] = (),
        *,
        lengths: bool = False,
    ) -> None:
        self._system = system
        self._slice = Slice(system, data, extra, lengths=lengths)
        self._demanded = frozenset(self._slice.demanded)
        self._variables = {name for kind, name, _ in self._demanded if kind == "var"}
        self._fields: dict[str, set[Path]] = {}
        for kind, name, path in self._demanded:
            if kind == "event":
                self._fields.setdefault(name, set()).add(path)
        self.identity = self._counts_identity()
        """True if it counts who a robot or a sender is."""

    def keeps(self, machine: str, variable: str) -> bool:
        """Return True if a variable decides on anything."""
        return f"{machine}.{variable}" in self._variables

    @property
    def growing(self) -> set[str]:
        """Variables that are computed from themselves, as in `n = n + 1`."""
        return self._slice.growing

    def _counts_identity(self) -> bool:
        named = any(
            kind in ("robot", "sender") or self._reads_header("node", (kind, name, path))
            for kind, name, path in self._demanded
        )
        follows = any(
            (kind, name) in (("event", DEPARTED), ("event", JOINED)) and path[:1] in ((), ("id",))
            for kind, name, path in self._demanded
        )
        return named or follows or self._slice.is_addressed

    def reads_sender(self, event: str) -> bool:
        """Return True if it counts who has sent an event."""
        return any(
            (kind, name) == ("sender", event)
            or (name == event and self._reads_header("node", (kind, name, path)))
            for kind, name, path in self._demanded
        )

    def sender_of(self, event: str) -> Iterator[Doubt]:
        """Yield a doubt if it counts who has sent an event from outside."""
        if ("sender", event, ()) in self._demanded:
            reason = f"the sender of `{event}` from outside is not covered"
            yield Doubt(reason, self._place(("sender", event, ())))

    def is_for_swarm(self, event: str) -> bool:
        """Return True for an event that reaches other robots."""
        return self._system.event(event).swarm

    def fields(self, event: str) -> list[Path]:
        """Return the fields of an event that decide on anything."""
        return sorted(self._fields.get(event, ()))

    def timed(self) -> Iterator[Doubt]:
        """Yield a doubt if the time decides on anything."""
        for kind, name, path in sorted(self._demanded):
            if kind == "time" or self._reads_header("stamp", (kind, name, path)):
                yield Doubt("the model reads the time", self._place((kind, name, path)))
                return

    def results(self, function: str) -> Values:
        """Return representatives of the results of a function."""
        call = self._system.function(function).communication
        parts = self._parts("result", function)
        return combinations(function, parts, lambda: default_result(call, self._system))

    def messages(self, event: str) -> Values:
        """Return representatives of the messages of an event from outside."""
        type_ = self._system.event(event).type
        parts = self._parts("event", event)
        return combinations(event, parts, lambda: default_value(type_, self._system))

    def uncovered(self, events: Iterable[str]) -> set[Node]:
        """Return places of results and events from outside of which only some values are tried."""
        sources = [("event", name) for name in events]
        sources += [(kind, name) for kind, name, _ in self._demanded if kind == "result"]
        return {
            (kind, name, part.path)
            for kind, name in dict.fromkeys(sources)
            for part in self._parts(kind, name)
            if not is_covered(part)
        }

    def reached_from(self, places: Iterable[Node]) -> set[Node]:
        """Return some places, and all that hold what is copied or computed from them."""
        return self._slice.reached_from(places)

    # ---- internal

    def _place(self, node: Node) -> Span | None:
        """Return the place of the first expression that reads some data."""
        return getattr(self._slice.read.get(node), "origin", None)

    def _parts(self, kind: str, name: str) -> Iterator[Part]:
        """Yield the parts of an event or result that decide on anything."""
        type_of = self._result_type(name) if kind == "result" else self._event_type(name)
        for node in sorted(self._demanded):
            if node[:2] == (kind, name):
                type_, cuts = type_of(node[2]), frozenset(self._slice.cuts.get(node, ()))
                default = default_value(type_, self._system) if type_ is not None else 0
                yield Part(node[2], type_, default, cuts, self._slice.exact.get(node))

    def _result_type(self, function: str) -> Callable[[Path], ir.Type | None]:
        call = self._system.function(function).communication
        types = {each.name: each.type for each in result_fields(call, self._system) or ()}
        return lambda path: field_type(types.get(path[0]), path[1:], self._system) if path else None

    def _event_type(self, event: str) -> Callable[[Path], ir.Type | None]:
        type_ = self._system.event(event).type
        return lambda path: field_type(type_, path, self._system)

    def _reads_header(self, field: str, node: Node) -> bool:
        """Return True if a place is a field of a header of an event, or has such a header in it."""
        kind, name, path = node
        declared = self._system.events_by_name.get(name)
        if kind != "event" or declared is None:
            return False
        headers = _HEADERS[field]
        if path and path[-1] == field:
            return field_type(declared.type, path[:-1], self._system) in headers
        held = field_type(declared.type, path, self._system)
        inner = self._system.known_interface(held) if isinstance(held, ir.Named) else None
        parts = inner.fields if isinstance(inner, ir.Message) else ()
        return held in headers or any(part.type in headers for part in parts)
