"""Variables that are read before anything was written to them."""

from __future__ import annotations

from collections import deque

from swarmdsl.diagnostics import Label
from swarmdsl.enums import numbers
from swarmdsl.ir.types import DURATION, Named, Primitive, Type
from swarmdsl.link_machines import all_resolved
from swarmdsl.syntax import (
    EnumType,
    NameUse,
    StateMachine,
    Variable,
    nodes_of,
    walk,
)
from swarmdsl.validate.context import Context
from swarmdsl.validate.steps import Read, stores_of
from swarmdsl.validate.ways import Point, Ways


def check_initialization(machine: StateMachine, context: Context, *, reused: bool) -> None:
    """Report variables without a first value that some way leads to a read of, unwritten.

    Guards are taken to be possible, as is any order of events. What can have no first value, a
    message, may be tested for what it holds; so may whatever a reused machine keeps between visits.
    """
    variables = _unset(machine, context)
    if not variables or _has_unknown(machine) or not all_resolved(machine):
        return
    start = Ways(context.outline(machine)).start
    for variable in variables:
        settable = not reused and _has_literals(variable.type.type, context)
        _check(variable, start, settable, context)


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


def _check(variable: Variable, start: Point, settable: bool, context: Context) -> None:
    """Report the first read of a variable, in the number of steps, that no write comes before."""
    before: dict[Point, Point | None] = {start: None}
    work = deque([start])
    while work:
        point = work.popleft()
        step = point.first(variable)
        if isinstance(step, Read) and (settable or not step.test):
            _report(step, point, before, settable, context)
            return
        if step is not None:
            continue
        for reached in point.leads_to:
            if reached not in before and all(part in before for part in reached.parts):
                before[reached] = point
                work.append(reached)


def _report(
    read: Read, at: Point, before: dict[Point, Point | None], settable: bool, context: Context
) -> None:
    variable = read.variable
    point: Point | None = at
    while point is not None and (point.after is None or _contains(point, read)):
        point = before[point]
    help_ = "write it on every way that leads here"
    if settable:
        written = f"var {variable.name} : {variable.type.span.text} = ..."
        help_ = f"give it a first value, `{written}`, or {help_}"
    context.report.report(
        "early-read",
        read.span,
        name=variable.name,
        label=f"nothing is stored in it yet: {_zero(variable.type.type, context)}",
        related=(Label(point.after, "this way leads here before it is written"),)
        if point is not None and point.after is not None
        else (),
        help=help_,
    )


def _contains(point: Point, read: Read) -> bool:
    assert point.after is not None
    return point.after.start <= read.span.start < point.after.end


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
