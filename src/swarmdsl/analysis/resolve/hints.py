"""Hints for names that are not resolved.

Only a model with mistakes imports this module.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from swarmdsl.analysis.resolve.scopes import FileScope
from swarmdsl.analysis.resolve.states import states_by_name
from swarmdsl.base.diagnostics.advice import write
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.suggest import closest
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import Declaration, EnumType, ImportLibrary, Node, TypeRef, Vertex
from swarmdsl.syntax.types import PRIMITIVES

# Names of the outcomes of an activity in SMACH, YASMIN and behaviour trees.
_OTHER_OUTCOMES = {
    **dict.fromkeys(("success", "succeed", "finished", "complete", "completed", "ok"), "succeeded"),
    **dict.fromkeys(("failure", "failed", "fail", "error"), "aborted"),
    **dict.fromkeys(("preempt", "cancel", "canceled", "cancelled"), "preempted"),
}
# Names of types in other languages.
_OTHER_TYPES = {
    "int": "int32",
    "integer": "int32",
    "uint": "uint32",
    "float": "float64",
    "double": "float64",
    "number": "float64",
    "boolean": "bool",
    "str": "string",
}
# Text before a type that is an interface of ROS, or a message of the model.
_INTERFACE = re.compile(r'\b(?:event\s+\w+|(?:in|out|monitor|action|service)\s+"[^"\n]*")\s*:\s*\Z')
_SENT = re.compile(r"\bsend\s+([\w.]+)\s+to\s+\Z")
# Functions that need no value in their parentheses.
_CALLED = ("elapsed", "present")
# Names of an absent value in other languages.
_NULL = ("null", "none", "nil", "undefined")

# `Abort` is too far from `aborted`: it is an event.
_LIKE_OUTCOME = 0.85


def other_outcome(name: str) -> str | None:
    """Return the outcome that other tools call by this name: `aborted` for `failure`."""
    return _OTHER_OUTCOMES.get(name.lower())


@cache
def misspelled_outcome(name: str) -> str | None:
    """Return the outcome of an activity that a name is nearly: `succeeded` for `suceeded`."""
    return closest(name, ("succeeded", "aborted", "preempted"), _LIKE_OUTCOME)


def declared_elsewhere(
    name: str, kinds: tuple[type[Node], ...], scope: FileScope
) -> tuple[Declaration, str] | None:
    """Return a declaration in a file that is not imported, and the import that adds it."""
    for file, node in scope.project.declarations():
        if node.name == name and isinstance(node, kinds):
            return node, f"import {_import_path(file, name, scope)}"
    return None


def declarations_elsewhere(
    kinds: tuple[type[Node], ...], scope: FileScope
) -> Iterator[tuple[Declaration, str]]:
    """Yield the declarations in files that are not imported, with the imports that add them."""
    seen = {scope.file, *(file for _, file in scope.file.imports)}
    for file, node in scope.project.declarations():
        if file not in seen and isinstance(node, kinds):
            yield node, f"import {_import_path(file, str(node.name), scope)}"


def candidates_for(
    name: str, kinds: tuple[type[Node], ...], scope: FileScope
) -> dict[str, Declaration]:
    """Return the visible declarations of these kinds, qualified by the package of `name`."""
    package = name.rpartition(".")[0]
    found = {key: node for key, node in scope.visible().items() if isinstance(node, kinds)}
    if package not in scope.packages:
        return found
    qualified = {key: scope.find(key) for key in (f"{package}.{last}" for last in found)}
    return {key: nodes[0][1] for key, nodes in qualified.items() if nodes}


def _import_path(other: File, name: str, scope: FileScope) -> str:
    """Path of an import statement for a declaration of another file: a package or a file."""
    for file in scope.project.files:
        for statement, target in file.imports:
            if target is other and isinstance(statement, ImportLibrary):
                return f"{statement.name.rpartition('.')[0]}.{name}"
    if other.library:
        return f"{other.package}.{name}"
    path = os.path.relpath(other.source.name, Path(scope.file.source.name).parent)
    return f'"{Path(path).as_posix()}"'


def wants_interface(ref: TypeRef) -> bool:
    """Return True for the type of an event, topic, action or service: it is no primitive type."""
    return _INTERFACE.search(ref.span.source.text[: ref.span.start]) is not None


def _message_with(type_: str) -> str:
    """Return the message of ROS that has a value of a primitive type."""
    from swarmdsl.project.rosidl import standard

    messages = standard.names("std_msgs")
    return next(f"std_msgs/{each}" for each in messages if each.lower() == type_)


def type_hint(ref: TypeRef, scope: FileScope, report: Diagnostics) -> str | None:
    """Hint for a type of another language or of ROS, or an address with fields after it."""
    name = ref.name
    interface = wants_interface(ref)
    if name in _OTHER_TYPES:
        type_ = _OTHER_TYPES[name]
        return write(_message_with(type_) if interface else type_)
    package, _, last = name.rpartition(".")
    if last in scope.skipped_names:
        return None
    if sent := _SENT.search(ref.span.source.text[: ref.span.start]):
        return f"write the fields before the address: `send {sent[1]}(...) to {name}`"
    unknown = package and "." not in package and package not in scope.packages
    if unknown and scope.imports_resolved:
        return write(f"{package}/{last}", after=" for an interface of ROS")
    if name.lower() in PRIMITIVES and not interface:
        return None
    if not report.wants_hint("unresolved-name"):
        return None
    if any(declared.name == name for _, declared in scope.project.declarations()):
        return None
    # Slow to read, and correct models do not need it.
    from swarmdsl.project.rosidl import standard

    meant = [f"{each}/{name}" for each in standard.packages() if name in standard.names(each)]
    return write(*meant) if meant else None


def value_hint(name: str, scope: FileScope, report: Diagnostics) -> str | None:
    """Hint for a value of an enum without its enum, a function without `()`, an absent value."""
    if name in _CALLED:
        return write(f"{name}()", before="it is a function: ")
    enums = scope.names(EnumType) if report.wants_hint("unresolved-name") else ()
    meant = [
        f"{known}.{name}"
        for known in enums
        if (enum := scope.one(known, EnumType)) is not None
        and any(value.name == name for value in enum.values)
    ]
    if meant and name not in scope.skipped_names:
        return write(*meant)
    if name.lower() in _NULL:
        return 'values are never absent: compare with a default, 0 or ""'
    return None


def path_to_state(name: str, state: Vertex) -> list[Vertex]:
    """States from one down to a state of this name inside it; empty if there is none."""
    if state.name == name:
        return [state]
    inside = (inner for found in states_by_name(state).values() for inner in found)
    paths = (path_to_state(name, inner) for inner in inside)
    return next(([state, *path] for path in paths if path), [])
