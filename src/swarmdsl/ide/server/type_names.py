"""Type names for completion."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.analysis.resolve.scopes import FileScope
from swarmdsl.ide.server.candidates import visible
from swarmdsl.ide.server.speculative_parse import PLACEHOLDER
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


def type_names(expected: TypeRef, owner: TopLevel, scope: FileScope) -> Iterator[Named]:
    """Yield type names with a detail and their declaration, if any.

    After `package/`, yield the names of this package without the prefix.
    """
    kind, kinds = _expected(expected, owner)
    before = expected.name.partition(PLACEHOLDER)[0]
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
            yield name if slash else f"{each}/{name}", f"ROS {_KINDS[kind]}", None


def _expected(expected: TypeRef, owner: TopLevel) -> tuple[Kind, tuple[type[Node], ...]]:
    """Return the expected interface kind and the node types that fit."""
    for call in nodes_of(owner, Communication):
        if call.type is expected:
            if call.paradigm == "action":
                return "action", (ActionType,)
            return "srv", (ServiceType,)
    return "msg", _TYPES
