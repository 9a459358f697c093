"""Usage of declarations by others, and the declarations that a system reaches."""

from __future__ import annotations

from swarmdsl.analysis.resolve.interfaces import is_secondary_description, own_interfaces
from swarmdsl.analysis.resolve.type_names import interface_name
from swarmdsl.base.records import dataclass
from swarmdsl.project.loader import File, Project
from swarmdsl.syntax.action_messages import generated_from
from swarmdsl.syntax.ast import (
    Activity,
    Component,
    Declaration,
    Fitness,
    NameUse,
    Node,
    Operation,
    Property,
    TopLevel,
    TypeRef,
    nodes_of,
    references,
)
from swarmdsl.syntax.types import Array, Named


@dataclass(frozen=True)
class Usage:
    """Nodes and types that a declaration uses; not `complete` if a name was not resolved."""

    nodes: frozenset[Node]
    types: frozenset[Named]
    complete: bool


class UsageCache(dict[TopLevel, Usage]):
    """Usage of each declaration, computed on first use."""

    def __missing__(self, owner: TopLevel) -> Usage:
        self[owner] = found = _usage(owner)
        return found

    def restricted_to(self, project: Project) -> UsageCache:
        """Return the cache without declarations that are no longer in the project."""
        owners = (*project.declarations(), *project.optimizations())
        return UsageCache({owner: self[owner] for _, owner in owners if owner in self})


def used_declarations(
    project: Project, usage: UsageCache | None = None
) -> list[tuple[File, Declaration]]:
    """Return the declarations of the project itself and those of libraries that they reach.

    The order is that of the files.
    """
    pairs = list(project.declarations())
    if not any(file.library for file in project.files):
        return pairs
    usage = usage if usage is not None else UsageCache()
    by_type: dict[Named, Declaration] = {}
    owners: dict[Node, Declaration] = {}
    own = own_interfaces(project)
    for file, declaration in pairs:
        if not file.library:
            continue
        name = interface_name(file, declaration.name)
        if not (is_secondary_description(file) and name in own):
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
        found = usage[work.pop()]
        of_library = {owners[node] for node in found.nodes & nodes}
        of_library.update(by_type[type_] for type_ in found.types & types)
        work += of_library - used
        used |= of_library
    return [(file, node) for file, node in pairs if node in used]


def _usage(owner: TopLevel) -> Usage:
    refs = [ref.target for _, ref in references(owner)]
    names = [use.target for use in nodes_of(owner, NameUse) if not use.is_predefined]
    owners: list[Node | None] = [activity.owner for activity in nodes_of(owner, Activity)]
    if isinstance(owner, (Fitness, Property)):
        owners.append(owner.about)
    types = (ref.type for ref in nodes_of(owner, TypeRef))
    elements = (type_.element if isinstance(type_, Array) else type_ for type_ in types)
    named = {element for element in elements if isinstance(element, Named)}
    actions = {made.action for element in named for made in generated_from(element)}
    return Usage(
        frozenset(node for node in (*refs, *names, *owners) if node is not None),
        frozenset(named | actions),
        None not in refs and None not in names,
    )
