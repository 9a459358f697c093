"""Variables that are read before anything was written to them."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator, Mapping

from swarmdsl.analysis.checks.accesses import Read, stores_of
from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.control_flow import Point, Ways
from swarmdsl.analysis.resolve.states import all_resolved
from swarmdsl.analysis.types.enum_values import numbers
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import (
    EnumType,
    NameUse,
    StateMachine,
    Variable,
    nodes_of,
    walk,
)
from swarmdsl.syntax.types import DURATION, Named, Primitive, Type


def check_initialization(machine: StateMachine, context: Context, *, reused: bool) -> None:
    """Report variables without a first value that some way leads to a read of, unwritten.

    Guards are taken to be possible, as is any order of events. What can have no first value, a
    message, may be tested for what it holds; so may whatever a reused machine keeps between visits.
    """
    variables = _unset(machine, context)
    if not variables or _has_unknown(machine) or not all_resolved(machine):
        return
    ways = Ways(context.outline(machine))
    settable = {
        variable: not reused and _has_literals(variable.type.type, context)
        for variable in variables
    }
    for read, way in _early_reads(ways.start, settable):
        _report(read, way, settable[read.variable], context)
    ways.forget()


def _has_unknown(machine: StateMachine) -> bool:
    """Whether a name in the machine, which may be that of a variable, was not resolved."""
    return any(use.target is None and use.name != "event" for use in nodes_of(machine, NameUse))


def _unset(machine: StateMachine, context: Context) -> list[Variable]:
    """The variables without a first value that are written somewhere."""
    written = {
        use.target
        for node in stores_of(machine)
        for use in walk(node.target)
        if isinstance(use, NameUse)
    }
    return [
        item
        for item in machine.items
        if isinstance(item, Variable)
        and item.initial is None
        and item in written
        and _begins_well(item.type.type, context)
    ]


def _begins_well(type_: Type | None, context: Context) -> bool:
    """Whether the zero of a type is a value of it: of an enum without one that is told anyway."""
    enum = context.interfaces.get(type_) if isinstance(type_, Named) else None
    return not isinstance(enum, EnumType) or 0 in numbers(enum).values()


def _early_reads(
    start: Point, settable: Mapping[Variable, bool]
) -> Iterator[tuple[Read, Iterator[Point]]]:
    """The first read of each variable, in the number of points, that no write comes before.

    Each with the points that lead there, the last first. A variable that is not `settable` may be
    tested. The variables go the ways together, a bit for each, however many there are.
    """
    bits = {variable: 1 << number for number, variable in enumerate(settable)}
    everything = (1 << len(bits)) - 1
    found: dict[Variable, tuple[Read, Point]] = {}
    # At each point what is not written, and from where that came; what has yet to go on.
    unset, ahead = {start: everything}, {start: everything}
    came: dict[Point, list[tuple[int, Point]]] = {start: []}
    work = deque([start])
    while work:
        point = work.popleft()
        left = ahead.pop(point)
        for step in point.steps:
            bit = bits.get(step.variable, 0) & left
            if bit:
                left &= ~bit
                if isinstance(step, Read) and (settable[step.variable] or not step.test):
                    found.setdefault(step.variable, (step, point))
        for reached in point.leads_to if left else ():
            known, new = unset.get(reached, 0), left
            for part in reached.parts:
                new &= unset.get(part, 0)
            new &= ~known
            if new:
                unset[reached] = known | new
                came.setdefault(reached, []).append((new, point))
                if reached not in ahead:
                    work.append(reached)
                ahead[reached] = ahead.get(reached, 0) | new

    def way(point: Point | None, bit: int) -> Iterator[Point]:
        while point is not None:
            yield point
            point = next((before for some, before in came[point] if some & bit), None)

    for variable, bit in bits.items():
        if variable in found:
            read, point = found[variable]
            yield read, way(point, bit)


def _report(read: Read, way: Iterable[Point], settable: bool, context: Context) -> None:
    variable = read.variable
    here = next(
        (p.after for p in way if p.after is not None and not _contains(p.after, read)), None
    )
    help_ = "write it on every way that leads here"
    if settable:
        written = f"var {variable.name} : {variable.type.span.text} = ..."
        help_ = f"give it a first value, `{written}`, or {help_}"
    context.report.report(
        "early-read",
        read.span,
        name=variable.name,
        label=f"nothing is stored in it yet: {_zero(variable.type.type, context)}",
        related=(Label(here, "this way leads here before it is written"),) if here else (),
        help=help_,
    )


def _contains(span: Span, read: Read) -> bool:
    return span.start <= read.span.start < span.end


def _has_literals(type_: Type | None, context: Context) -> bool:
    """Whether values of a type can be written down."""
    if isinstance(type_, Named):
        return isinstance(context.interfaces.get(type_), EnumType)
    return isinstance(type_, Primitive)


def _zero(type_: Type | None, context: Context) -> str:
    """What a variable of a type holds at first."""
    if type_ == DURATION:
        return "it holds `0 s`"
    if isinstance(type_, Primitive):
        zero = {"bool": "false", "string": '""', "wstring": '""'}.get(type_.name, "0")
        return f"it holds `{zero}`"
    enum = context.interfaces.get(type_) if isinstance(type_, Named) else None
    if isinstance(enum, EnumType):
        first = next(name for name, number in numbers(enum).items() if number == 0)
        return f"it holds `{enum.name}.{first}`"
    return "its fields have their defaults" if isinstance(type_, Named) else "it holds defaults"
