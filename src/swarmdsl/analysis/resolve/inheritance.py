"""What components and members have from those they extend."""

from __future__ import annotations

from typing import TypeVar

from swarmdsl.syntax.ast import (
    BehaviorUse,
    CommunicationSettings,
    Component,
    Connector,
    Member,
    Operation,
    Param,
    Part,
    Port,
)

Item = Port | Param | Operation | Part | Connector | BehaviorUse | CommunicationSettings
Kind = TypeVar("Kind", bound=Item)
# Of these an own one takes the place of an inherited one.
_REPLACED = (Param, BehaviorUse, CommunicationSettings)


# More than anyone writes: who extends something extends all that this extends, in turn.
MOST_BASES = 64


def lineage(owner: Component | Member) -> list[Component | Member]:
    """The owner and what it extends, the nearest first; each once, also in a cycle.

    What is further away than any model needs is left out, and reported.
    """
    if owner.base is None:
        return [owner]
    found: dict[Component | Member, None] = {}
    current: Component | Member | None = owner
    while current is not None and current not in found and len(found) <= MOST_BASES:
        found[current] = None
        current = current.base.target if current.base is not None else None
    return list(found)


def all_items(owner: Component | Member, kind: type[Kind]) -> list[Kind]:
    """The items of a kind, the inherited ones first.

    An own param takes the place of an inherited one of its name; an own behaviour and
    own communication settings that of the inherited ones.
    """
    bases = reversed(lineage(owner))
    items: list[Kind] = [item for each in bases for item in each.items if isinstance(item, kind)]
    if kind not in _REPLACED:
        return items
    return list({_place(item): item for item in items}.values())


def _place(item: Item) -> str:
    return str(item.name) if isinstance(item, Param) else ""
