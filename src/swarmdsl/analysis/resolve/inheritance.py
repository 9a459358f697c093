"""Inherited items of components and members."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

from swarmdsl.syntax.ast import (
    BehaviorUse,
    CommunicationSettings,
    Component,
    Connector,
    Contract,
    Equipment,
    Member,
    Operation,
    Param,
    Part,
    Port,
    Role,
    Sight,
    Variable,
)

Item = (
    Port
    | Param
    | Operation
    | Part
    | Connector
    | Contract
    | BehaviorUse
    | CommunicationSettings
    | Equipment
    | Sight
)
Kind = TypeVar("Kind", bound=Item)
Named = TypeVar("Named", Param, Variable, Part, Port, Operation, Role)
# Own items of these kinds replace inherited ones.
_REPLACED = (Param, Contract, BehaviorUse, CommunicationSettings, Equipment, Sight)


# More than real models have.
MOST_BASES = 64


def lineage(owner: Component | Member) -> list[Component | Member]:
    """Return the owner and its bases, the nearest first, each once even in a cycle.

    Bases beyond MOST_BASES are left out; a check reports them.
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
    """Return the items of a kind, the inherited ones first.

    An own param replaces an inherited one of its name; an own behaviour and own communication
    settings replace the inherited ones, as do equipment of one kind and sight of one target.
    """
    bases = reversed(lineage(owner))
    items: list[Kind] = [item for each in bases for item in each.items if isinstance(item, kind)]
    if kind not in _REPLACED:
        return items
    return list({_place(item): item for item in items}.values())


def _place(item: Item) -> str:
    match item:
        case Param() | Contract():
            return f"{type(item).__name__} {item.name}"
        case Equipment():
            return item.kind
        case Sight():
            return item.target.name
    return ""


def by_name(items: Iterable[object], kind: type[Named]) -> dict[str, Named]:
    """Return the items of a kind by name. The first of a repeated name counts."""
    named: dict[str, Named] = {}
    for item in items:
        if isinstance(item, kind):
            named.setdefault(str(item.name), item)
    return named
