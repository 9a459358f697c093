"""The types that can be named at a place."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.analysis.resolve.scopes import FileScope
from swarmdsl.ide.server.candidates import visible
from swarmdsl.ide.server.speculative_parse import WORD
from swarmdsl.project.rosidl import standard
from swarmdsl.project.rosidl.interface_file import Kind
from swarmdsl.syntax.ast import (
    ActionType,
    AliasType,
    Communication,
    EnumType,
    MessageType,
    Node,
    ServiceType,
    StructType,
    TopLevel,
    TypeRef,
    nodes_of,
)
from swarmdsl.syntax.types import PRIMITIVES

_TYPES = (StructType, EnumType, AliasType, MessageType)
_KINDS: dict[Kind, str] = {"msg": "message", "srv": "service", "action": "action"}

Named = tuple[str, str, Node | None]


def type_names(wanted: TypeRef, owner: TopLevel, scope: FileScope) -> Iterator[Named]:
    """The names that fit for a type, each with what it is and its declaration, if there is one.

    In the place of the word behind `package/` they are those of that package, without it.
    """
    kind, kinds = _wanted(wanted, owner)
    before = wanted.name.partition(WORD)[0]
    package, slash, _ = before.rpartition("/")
    if not slash and kind == "msg":
        yield from ((word, "type", None) for word in PRIMITIVES)
    for node in visible(scope, kinds):
        name = str(node.name)  # type: ignore[attr-defined]
        of, _, last = name.rpartition("/")
        if slash and of == package:
            yield last, "", node
        elif not slash:
            yield name, "", node
    for each in [package] if slash else standard.packages():
        for name in standard.names(each, kind):
            yield name if slash else f"{each}/{name}", f"{_KINDS[kind]} of ROS", None


def _wanted(wanted: TypeRef, owner: TopLevel) -> tuple[Kind, tuple[type[Node], ...]]:
    """Which kinds of interfaces fit."""
    for call in nodes_of(owner, Communication):
        if call.type is wanted:
            if call.paradigm == "action":
                return "action", (ActionType,)
            return "srv", (ServiceType,)
    return "msg", _TYPES
