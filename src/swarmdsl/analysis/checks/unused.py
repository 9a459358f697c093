"""Declarations that nothing else of the model uses."""

from __future__ import annotations

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.node_kinds import kind_name
from swarmdsl.analysis.resolve.type_names import interface_name
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    Constant,
    Declaration,
    EnumType,
    Event,
    Function,
    Member,
    Node,
    Param,
    StateMachine,
    StructType,
    TopLevel,
    nodes_of,
)

_KINDS = (Event, Function, Constant, StructType, EnumType)


def check_unused(project: Project, context: Context) -> None:
    """Report what the project declares for others of its declarations, and none of them uses.

    That is a lint: a file may be there for other projects. A state machine that no member
    runs is one only where there are members. Nothing is said where a piece could not be read or
    a name was not resolved: it may mean what seems to be unused.
    """
    if not context.report.wants("unused-declaration"):
        return
    pairs = list(project.declarations())
    types = {interface_name(file, node.name): node for file, node in pairs}
    owners: list[TopLevel] = [node for _, node in pairs]
    owners += [optimization for _, optimization in project.optimizations()]
    uses = context.known.uses
    if context.damaged or not all(uses[owner].complete for owner in owners):
        return
    used: set[Node | None] = set()
    for owner in owners:
        used |= {*uses[owner].nodes, *map(types.get, uses[owner].types)} - {owner}
    has_members = any(isinstance(node, Member) for node in owners)
    for file, node in pairs:
        if file.library:
            continue
        wanted = isinstance(node, _KINDS) or (has_members and isinstance(node, StateMachine))
        unused: list[Declaration | Param] = [node] if wanted and node not in used else []
        if isinstance(node, StateMachine):
            unused += [item for item in nodes_of(node, Param) if item not in used]
        for each in unused:
            context.report.report(
                "unused-declaration",
                each.name.span,
                kind=kind_name(each),
                name=each.name,
                help="remove it, or use it",
            )
