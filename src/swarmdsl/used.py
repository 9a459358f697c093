"""Which declarations belong to a system: the project's own and what they use of libraries."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.ir.types import Array, Named
from swarmdsl.link_types import interface_name
from swarmdsl.load import File, Project
from swarmdsl.syntax import Component, Declaration, Node, Operation, Ref, TypeRef, walk


def used_declarations(project: Project) -> list[tuple[File, Declaration]]:
    """All that the project declares itself, and what that leads to, in the order of the files."""
    pairs = list(project.declarations())
    by_type = {interface_name(file, node.name): node for file, node in pairs}
    owners: dict[Node, Declaration] = {}
    for _, declaration in pairs:
        owners[declaration] = declaration
        if isinstance(declaration, Component):
            for item in declaration.items:
                if isinstance(item, Operation):
                    owners[item] = declaration
    work: list[Node] = [node for file, node in pairs if not file.library]
    work += [optimization for _, optimization in project.optimizations()]
    used: set[Node] = set()
    while work:
        node = work.pop()
        if node in used:
            continue
        used.add(node)
        for inside in walk(node):
            work += [owners[target] for target in _targets(inside) if target in owners]
            if isinstance(inside, TypeRef):
                element = inside.type.element if isinstance(inside.type, Array) else inside.type
                if isinstance(element, Named) and element in by_type:
                    work.append(by_type[element])
    return [(file, node) for file, node in pairs if node in used]


def _targets(node: Node) -> Iterator[Node]:
    for attribute in node.__dataclass_fields__:
        value = getattr(node, attribute)
        if isinstance(value, Ref):
            value = value.target
        elif attribute not in ("target", "owner"):
            continue
        if isinstance(value, Node):
            yield value
