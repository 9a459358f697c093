"""Type names for completion."""

from __future__ import annotations

from collections import Counter

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
    Event,
    FunctionPort,
    MessageType,
    MonitorTrigger,
    Node,
    Port,
    ServiceType,
    StructType,
    TopLevel,
    TypeRef,
    name_of,
    nodes_of,
)
from swarmdsl.syntax.types import PRIMITIVES

_DATA = (StructType, EnumType, AliasType, MessageType)
_MESSAGES = (StructType, MessageType, AliasType)
_KINDS: dict[Kind, str] = {"msg": "message", "srv": "service", "action": "action"}
# What models use most.
_USUAL = (
    *("float64", "int32", "bool", "string", "uint32", "duration"),
    *("std_msgs/Empty", "std_msgs/Bool", "geometry_msgs/PoseStamped", "geometry_msgs/Pose"),
    *("std_srvs/Trigger", "std_srvs/SetBool", "std_srvs/Empty"),
)

Named = tuple[str, str, Node | None]


def type_names(
    expected: TypeRef, owner: TopLevel, scope: FileScope
) -> tuple[list[Named], tuple[type[Node], ...]]:
    """Return type names with a detail and their declaration, if any; and the kinds that fit.

    After `package/`, return the names of this package without the prefix. Messages of the model
    and types that the file uses come first.
    """
    kind, kinds = _expected(expected, owner)
    before = expected.name.partition(PLACEHOLDER)[0]
    package, slash, _ = before.rpartition("/")
    found: list[Named] = []
    for node in visible(scope, kinds):
        name = str(name_of(node))
        of, _, last = name.rpartition("/")
        if slash and of == package:
            found.append((last, "", node))
        elif not slash and node is not owner and name != str(getattr(owner, "name", "")):
            found.append((name, "", node))
    if not slash and EnumType in kinds:
        found += ((word, "type", None) for word in PRIMITIVES)
    for each in [package] if slash else standard.packages():
        for name in standard.names(each, kind):
            found.append((name if slash else f"{each}/{name}", f"ROS {_KINDS[kind]}", None))
    used = Counter(
        type_.name
        for declaration in scope.file.model.declarations
        for type_ in nodes_of(declaration, TypeRef)
    )

    def order(named: Named) -> tuple[bool, bool, int, bool, int]:
        name = f"{package}/{named[0]}" if slash else named[0]
        usual = _USUAL.index(name) if name in _USUAL else len(_USUAL)
        is_foreign = EnumType not in kinds and named[2] is None
        return is_foreign, used[name] == 0, -used[name], named[2] is None, usual

    return sorted(found, key=order), kinds


def _expected(expected: TypeRef, owner: TopLevel) -> tuple[Kind, tuple[type[Node], ...]]:
    """Return the expected interface kind and the node types that fit."""
    for call in nodes_of(owner, Communication):
        if call.type is expected:
            if call.paradigm == "action":
                return "action", (ActionType,)
            return "srv", (ServiceType,)
    carriers = [
        *(each.type for each in nodes_of(owner, Event)),
        *(each.type for each in nodes_of(owner, Port)),
        *(each.type for each in nodes_of(owner, FunctionPort)),
        *(each.type for each in nodes_of(owner, MonitorTrigger)),
    ]
    if any(type_ is expected for type_ in carriers):
        return "msg", _MESSAGES
    return "msg", _DATA
