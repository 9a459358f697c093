"""Which declarations belong to a system: the project's own and what they use of libraries."""

from __future__ import annotations

from swarmdsl.ir.types import Array, Named
from swarmdsl.link_types import interface_name
from swarmdsl.load import File, Project
from swarmdsl.syntax import (
    Activity,
    Component,
    Declaration,
    NameUse,
    Node,
    Operation,
    TopLevel,
    TypeRef,
    nodes_of,
    references,
)


def used_declarations(project: Project) -> list[tuple[File, Declaration]]:
    """All that the project declares itself, and what that leads to, in the order of the files."""
    pairs = list(project.declarations())
    if not any(file.library for file in project.files):
        return pairs
    by_type = {interface_name(file, node.name): node for file, node in pairs}
    owners: dict[Node, Declaration] = {}
    for _, declaration in pairs:
        owners[declaration] = declaration
        if isinstance(declaration, Component):
            for item in declaration.items:
                if isinstance(item, Operation):
                    owners[item] = declaration
    work: list[TopLevel] = [node for file, node in pairs if not file.library]
    work += [optimization for _, optimization in project.optimizations()]
    used: set[TopLevel] = set()
    while work:
        node = work.pop()
        if node in used:
            continue
        used.add(node)
        targets = [ref.target for _, ref in references(node)]
        targets += [use.target for use in nodes_of(node, NameUse)]
        targets += [activity.owner for activity in nodes_of(node, Activity)]
        work += [owners[target] for target in targets if target in owners]
        for ref in nodes_of(node, TypeRef):
            element = ref.type.element if isinstance(ref.type, Array) else ref.type
            if isinstance(element, Named) and element in by_type:
                work.append(by_type[element])
    return [(file, node) for file, node in pairs if node in used]
