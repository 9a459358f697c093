"""Checks of unused declarations, and the declarations that a system uses."""

from __future__ import annotations

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.node_kinds import kind_name
from swarmdsl.analysis.resolve.type_names import interface_name
from swarmdsl.analysis.usage import used_declarations
from swarmdsl.base.diagnostics.advice import Advice
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
    """Report declarations of the project that no other declaration uses.

    This is a lint: other projects may use a file. State machines count only in a project with
    members. Nothing is reported if a part could not be parsed or a name was not resolved,
    which may use the declaration.
    """
    if not context.report.wants("unused-declaration"):
        return
    pairs = list(project.declarations())
    types = {interface_name(file, node.name): node for file, node in pairs}
    owners: list[TopLevel] = [node for _, node in pairs]
    owners += [optimization for _, optimization in project.optimizations()]
    usage = context.facts.usage
    if context.incomplete or not all(usage[owner].complete for owner in owners):
        return
    used: set[Node | None] = set()
    for owner in owners:
        used |= {*usage[owner].nodes, *map(types.get, usage[owner].types)} - {owner}
    has_members = any(isinstance(node, Member) for node in owners)
    for file, node in pairs:
        if file.library:
            continue
        counts = isinstance(node, _KINDS) or (has_members and isinstance(node, StateMachine))
        unused: list[Declaration | Param] = [node] if counts and node not in used else []
        if isinstance(node, StateMachine):
            unused += [item for item in nodes_of(node, Param) if item not in used]
        for each in unused:
            context.report.report(
                "unused-declaration",
                each.name.span,
                kind=kind_name(each),
                name=each.name,
                help=Advice("remove it, or use it", "remove declaration"),
            )


def collect_used(project: Project, context: Context) -> None:
    """Set the used declarations of the context."""
    facts = context.facts
    context.used[:] = used_declarations(project, facts.usage)
    facts.usage = facts.usage.restricted_to(project)
