"""Checks of variables that are read before they are written."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator, Mapping

from swarmdsl.analysis.checks.accesses import Read, storing_nodes
from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.control_flow import ControlFlowGraph, Node
from swarmdsl.analysis.resolve.states import all_resolved
from swarmdsl.analysis.types import stored_name
from swarmdsl.analysis.types.enum_values import numbers
from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import (
    Address,
    Append,
    EnumType,
    NameUse,
    StateMachine,
    Variable,
    nodes_of,
)
from swarmdsl.syntax.types import DURATION, Named, Primitive, Type


def check_initialization(machine: StateMachine, context: Context) -> None:
    """Report variables without an initial value that a path reads before it writes them.

    All guards and all orders of events are assumed to be possible. A guard may test a variable
    that cannot have an initial value (a message), and any variable of a submachine, which keeps
    its values between visits.
    """
    if context.errors_only:
        return
    variables = _unset(machine, context)
    if not variables or _has_unknown(machine) or not all_resolved(machine):
        return
    graph = ControlFlowGraph(context.hierarchy(machine))
    reused = machine in context.facts.reused
    settable = {
        variable: not reused and _has_literals(variable.type.type, context)
        for variable in variables
    }
    for read, path in _early_reads(graph.entry, settable):
        _report(read, path, settable[read.variable], context)
    graph.clear()


def _has_unknown(machine: StateMachine) -> bool:
    """Return True if a name that may be a variable was not resolved."""
    roles = [each.role_use for each in nodes_of(machine, Address)]
    return any(
        use.target is None and not use.is_predefined and use not in roles
        for use in nodes_of(machine, NameUse)
    )


def _unset(machine: StateMachine, context: Context) -> list[Variable]:
    """Return the variables without an initial value that are written somewhere."""
    stores = [(node, stored_name(node.target.tree)) for node in storing_nodes(machine)]
    written = {name.target for _, name in stores if name is not None}
    # An array that grows starts without items on purpose.
    grown = {name.target for node, name in stores if isinstance(node, Append) and name is not None}
    return [
        item
        for item in nodes_of(machine, Variable)
        if item.initial is None and item in written - grown and _has_zero(item.type.type, context)
    ]


def _has_zero(type_: Type | None, context: Context) -> bool:
    """Return True unless the type is an enum without the value 0, which is reported elsewhere."""
    enum = context.interfaces.get(type_) if isinstance(type_, Named) else None
    return not isinstance(enum, EnumType) or 0 in numbers(enum).values()


def _early_reads(
    entry: Node, settable: Mapping[Variable, bool]
) -> Iterator[tuple[Read, Iterator[Node]]]:
    """Yield the nearest read of each variable that no write precedes, with a path to it.

    The path is reversed, and has the nodes of transitions at least. A guard may test a variable
    that is not `settable`. One breadth-first search propagates the unwritten variables as bits
    of an integer.
    """
    bits = {variable: 1 << number for number, variable in enumerate(settable)}
    everything = (1 << len(bits)) - 1
    found: dict[Variable, tuple[Read, Node]] = {}
    # By node: the variables that may be unwritten, those still to propagate, and their origins.
    unset, ahead = {entry: everything}, {entry: everything}
    came: dict[Node, dict[Node, int]] = {entry: {}}
    work = deque([entry])
    while work:
        node = work.popleft()
        left = ahead.pop(node)
        for access in node.accesses:
            bit = bits.get(access.variable, 0) & left
            if bit:
                left &= ~bit
                if isinstance(access, Read) and (settable[access.variable] or not access.test):
                    found.setdefault(access.variable, (access, node))
        for reached in node.successors if left else ():
            known, new = unset.get(reached, 0), left
            for branch in reached.joined:
                new &= unset.get(branch, 0)
            new &= ~known
            if new:
                unset[reached] = known | new
                origins = came.setdefault(reached, {})
                origins[node] = origins.get(node, 0) | new
                if reached not in ahead:
                    work.append(reached)
                ahead[reached] = ahead.get(reached, 0) | new

    # By node without a transition, all paths to which lead through one other node: a node before.
    jumps: dict[Node, Node] = {}

    def path(node: Node | None, bit: int) -> Iterator[Node]:
        while node is not None:
            passed = []
            while node.transition is None and len(came[node]) == 1:
                passed.append(node)
                node = jumps.get(node) or next(iter(came[node]))
            jumps.update((each, node) for each in passed)
            yield node
            node = next((before for before, some in came[node].items() if some & bit), None)

    for variable, bit in bits.items():
        if variable in found:
            read, node = found[variable]
            yield read, path(node, bit)


def _report(read: Read, path: Iterable[Node], settable: bool, context: Context) -> None:
    variable = read.variable
    transitions = (node.transition for node in path)
    here = next((span for span in transitions if span and not _contains(span, read)), None)
    help_: str = "write it on every path to this place"
    if settable:
        written = f"var {variable.name} : {variable.type.span.text} = ..."
        text = f"give it an initial value, `{written}`, or {help_}"
        help_ = Advice(text, "initialize", variable.name.span)
    context.report.report(
        "early-read",
        read.span,
        name=variable.name,
        label=f"not written yet: {_zero(variable.type.type, context)}",
        related=(Label(here, "this path leads here without a write"),) if here else (),
        help=help_,
    )


def _contains(span: Span, read: Read) -> bool:
    return span.start <= read.span.start < span.end


def _has_literals(type_: Type | None, context: Context) -> bool:
    """Return True if a type has literals: a primitive type or an enum."""
    if isinstance(type_, Named):
        return isinstance(context.interfaces.get(type_), EnumType)
    return isinstance(type_, Primitive)


def _zero(type_: Type | None, context: Context) -> str:
    """Describe the initial content of a variable without an initial value."""
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
