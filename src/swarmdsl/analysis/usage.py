"""What declarations use of each other, and which belong to a system."""

from __future__ import annotations

from swarmdsl.analysis.resolve.interfaces import only_retells, own_interfaces
from swarmdsl.analysis.resolve.type_names import interface_name
from swarmdsl.base.records import dataclass
from swarmdsl.project.loader import File, Project
from swarmdsl.syntax.action_messages import ways_made
from swarmdsl.syntax.ast import (
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
from swarmdsl.syntax.types import Array, Named


@dataclass(frozen=True)
class Uses:
    """What the names in a declaration mean; not `complete` where one of them means nothing."""

    nodes: frozenset[Node]
    types: frozenset[Named]
    complete: bool


class UsesOfAll(dict[TopLevel, Uses]):
    """What each declaration uses, looked for when it is first asked for."""

    def __missing__(self, owner: TopLevel) -> Uses:
        self[owner] = found = _uses(owner)
        return found

    def only(self, project: Project) -> UsesOfAll:
        """The same without declarations that the project does not have any more."""
        owners = (*project.declarations(), *project.optimizations())
        return UsesOfAll({owner: self[owner] for _, owner in owners if owner in self})


def used_declarations(
    project: Project, uses: UsesOfAll | None = None
) -> list[tuple[File, Declaration]]:
    """All that the project declares itself, and what that leads to, in the order of the files."""
    pairs = list(project.declarations())
    if not any(file.library for file in project.files):
        return pairs
    uses = uses if uses is not None else UsesOfAll()
    by_type: dict[Named, Declaration] = {}
    owners: dict[Node, Declaration] = {}
    own = own_interfaces(project)
    for file, declaration in pairs:
        if not file.library:
            continue
        name = interface_name(file, declaration.name)
        if not (only_retells(file) and name in own):
            by_type[name] = declaration
        owners[declaration] = declaration
        if isinstance(declaration, Component):
            operations = (item for item in declaration.items if isinstance(item, Operation))
            owners.update(dict.fromkeys(operations, declaration))
    nodes, types = frozenset(owners), frozenset(by_type)
    work: list[TopLevel] = [node for file, node in pairs if not file.library]
    work += [optimization for _, optimization in project.optimizations()]
    used: set[TopLevel] = set(work)
    while work:
        found = uses[work.pop()]
        of_library = {owners[node] for node in found.nodes & nodes}
        of_library.update(by_type[type_] for type_ in found.types & types)
        work += of_library - used
        used |= of_library
    return [(file, node) for file, node in pairs if node in used]


def _uses(owner: TopLevel) -> Uses:
    refs = [ref.target for _, ref in references(owner)]
    names = [use.target for use in nodes_of(owner, NameUse) if use.name != "event"]
    asked = [activity.owner for activity in nodes_of(owner, Activity)]
    types = (ref.type for ref in nodes_of(owner, TypeRef))
    elements = (type_.element if isinstance(type_, Array) else type_ for type_ in types)
    named = {element for element in elements if isinstance(element, Named)}
    actions = {made.action for element in named for made in ways_made(element)}
    return Uses(
        frozenset(node for node in (*refs, *names, *asked) if node is not None),
        frozenset(named | actions),
        None not in refs and None not in names,
    )
