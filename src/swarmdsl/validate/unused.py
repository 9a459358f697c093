"""Declarations that nothing else of the model uses."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from swarmdsl.ir.types import Array, Named
from swarmdsl.link_types import interface_name
from swarmdsl.load import Project
from swarmdsl.scopes import bare, kind_of
from swarmdsl.syntax import (
    Constant,
    Declaration,
    EnumType,
    Event,
    Function,
    Member,
    NameUse,
    Node,
    Param,
    StateMachine,
    StructType,
    TopLevel,
    TypeRef,
    nodes_of,
    references,
)
from swarmdsl.validate.context import Context

_KINDS = (Event, Function, Constant, StructType, EnumType)


def check_unused(project: Project, context: Context) -> None:
    """Report what the project declares for others of its declarations, and none of them uses.

    That is a lint: a file may be there for other projects. A state machine that no member
    runs is one only where there are members. Nothing is said where a piece could not be read or
    a name was not resolved: it may mean what seems to be unused.
    """
    if context.report.allows("unused-declaration"):
        return
    pairs = list(project.declarations())
    types = {interface_name(file, node.name): node for file, node in pairs}
    owners: list[TopLevel] = [node for _, node in pairs]
    owners += [optimization for _, optimization in project.optimizations()]
    refs = [ref for owner in owners for _, ref in references(owner)]
    if context.damaged or any(ref.target is None for ref in refs):
        return
    used = {target for owner in owners for target in _used(owner, types) if target is not owner}
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
                kind=bare(kind_of(each)),
                name=each.name,
                help="remove it, or use it",
            )


def _used(owner: TopLevel, types: Mapping[Named, TopLevel]) -> Iterator[Node | None]:
    """What a declaration names: others, their values and types."""
    for _, ref in references(owner):
        yield ref.target
    for use in nodes_of(owner, NameUse):
        yield use.target
    for type_ in nodes_of(owner, TypeRef):
        element = type_.type.element if isinstance(type_.type, Array) else type_.type
        if isinstance(element, Named):
            yield types.get(element)
