"""Places of data that expressions name."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl import ir
from swarmdsl.execution.simulate.machines.expressions import ATTEMPT, ONE_OF
from swarmdsl.execution.verify.abstraction.representatives import Path

Node = tuple[str, str, Path]
"""Place of data: `var`, `event`, `sender` or `result`, its name, and fields in it."""

_VARYING = ("neighbors", "present", ONE_OF, ATTEMPT)
"""Functions that have another value at another time."""

SELF: Node = ("robot", "self", ())
SENT: Node = ("time", "sent", ())


def places(expression: ir.Expression, machine: str, events: tuple[str, ...]) -> list[Node] | None:
    """Return the places that an expression names; None if it is more than a place."""
    path: Path = ()
    while isinstance(expression, ir.FieldAccess):
        path = (expression.field, *path)
        expression = expression.base
    match expression:
        case ir.VariableRef(name=name):
            return [("var", f"{machine}.{name}", path)]
        case ir.EventData():
            return [("event", each, path) for each in events]
        case ir.EnvelopeField(field=field):
            return [("sender", each, ()) for each in events] if field == "sender" else [SENT]
        case ir.SelfField(field="id" | "index"):
            return [SELF]
        case ir.Elapsed(state=state):
            return [("time", state, ())]
    return None


def places_in(expression: ir.Expression, machine: str, events: tuple[str, ...]) -> Iterator[Node]:
    """Yield the places that an expression reads."""
    nodes = places(expression, machine, events)
    if nodes is not None:
        yield from nodes
        return
    for part in parts(expression):
        yield from places_in(part, machine, events)


def is_constant(expression: ir.Expression) -> bool:
    """Return True for what is the same in all runs."""
    varies = (
        *(ir.VariableRef, ir.EventData, ir.EnvelopeField, ir.ItemRef),
        *(ir.InState, ir.Elapsed),
    )
    return not any(
        isinstance(part, varies)
        or (isinstance(part, ir.SelfField) and part.field in ("id", "index"))
        or (isinstance(part, ir.Call) and part.function in _VARYING)
        for part in ir.subexpressions(expression)
    )


def parts(expression: ir.Expression) -> Iterator[ir.Expression]:
    """Yield the direct parts of an expression."""
    found: list[ir.Expression] = []

    def keep(part: ir.Expression) -> ir.Expression:
        found.append(part)
        return part

    ir.mapped(expression, keep)
    yield from found


def behind(node: Node, target: Node, source: Node) -> Node | None:
    """Return the place in the source of a copy that becomes a place in its target."""
    if node[:2] != target[:2]:
        return None
    inner, outer = node[2], target[2]
    if inner[: len(outer)] == outer:
        return (*source[:2], (*source[2], *inner[len(outer) :]))
    return source if outer[: len(inner)] == inner else None
