"""Elements that are one by their name.

They are params of a member or component and of its behaviour, and the targets of one kind.
"""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.analysis.resolve.inheritance import all_items, lineage
from swarmdsl.driver.workspace import Workspace
from swarmdsl.syntax.ast import (
    BehaviorUse,
    Component,
    Environment,
    Member,
    Node,
    Param,
    Targets,
    nodes_of,
)


def bound_together(node: Node, workspace: Workspace) -> list[Node]:
    """Return what is bound to a param or targets by its name; of other nodes it alone."""
    found = [node]
    if isinstance(node, Targets):
        environments = (
            owner
            for file in workspace.project.files
            for owner in file.model.declarations
            if isinstance(owner, Environment)
        )
        targets = (each for owner in environments for each in nodes_of(owner, Targets))
        return [*found, *(each for each in targets if each.name == node.name and each is not node)]
    if not isinstance(node, Param):
        return found
    groups = [
        group
        for file in workspace.project.files
        for owner in file.model.declarations
        if isinstance(owner, (Component, Member))
        if len(group := list(_named(owner, node.name))) > 1
    ]
    for each in found:  # which grows
        for group in groups:
            if each in group:
                found += [other for other in group if other not in found]
    return found


def _named(owner: Component | Member, name: str) -> Iterator[Param]:
    """Yield the params of this name of an owner, of what it extends, and of its behaviour."""
    machines = [use.machine.target for use in all_items(owner, BehaviorUse)]
    for each in (*lineage(owner), *machines):
        for item in each.items if each is not None else ():
            if isinstance(item, Param) and item.name == name:
                yield item
