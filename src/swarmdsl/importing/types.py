"""Types as the CPSwarm project writes them: `pkg/Class`, `pkg.srv.Class`, `Class`."""

from __future__ import annotations

import re

from swarmdsl.base.numerals import integer
from swarmdsl.ir import Array, Named, Primitive, Type
from swarmdsl.syntax.types import PRIMITIVES

# The CPSwarm code generator looks up unqualified names in these two packages.
_VALUES = ("Bool", "Int", "UInt", "Double", "String")
_SWARMROS = {"EventHeader", "NodeInfo", "SimpleEvent", *_VALUES, *(f"ArrayOf{v}" for v in _VALUES)}
_ARRAY = re.compile(r"(.+)\[(\d*)\]")
_WRITTEN_ARRAY = re.compile(r"(.+)\[(<=)?(\d{,9})\]")
_WRITTEN_NAME = re.compile(r"([A-Za-z_][\w.-]*)/([A-Za-z_]\w*)", re.ASCII)
_ALIASES = {"number": "float64", "boolean": "bool", "float": "float64", "int": "int32"}
_ALIASES |= {"double": "float64", "integer": "int32", "String": "string"}
MISSPELT = {"stds_msgs": "std_msgs"}
"""Misspelt package names in files of the project."""


def qualified(text: str, kind: str) -> Named:
    """Interface for a class name; `kind` is message, service or action."""
    words = re.findall(r"[A-Za-z_][A-Za-z0-9_]*", text)
    name = words[-1] if words else "Empty"
    if len(words) > 1:
        return Named(MISSPELT.get(words[0], words[0]), name)
    if kind == "service" and name in ("Empty", "Trigger", "SetBool"):
        return Named("std_srvs", name)
    return Named("swarmros" if kind == "message" and name in _SWARMROS else "cpswarm_msgs", name)


def data_type(text: str) -> Type:
    """Type of a field or parameter."""
    array = _ARRAY.fullmatch(text)
    if array is not None:
        return Array(data_type(array[1]), integer(array[2]) if array[2] else None)
    name = _ALIASES.get(text, text)
    if name in PRIMITIVES:
        return Primitive(name)
    if name == "Header":
        return Named("std_msgs", name)
    return qualified(text, "message")


def written_type(text: str) -> Type | None:
    """Parse the result of `str(type)`; None if it is not a type."""
    array = _WRITTEN_ARRAY.fullmatch(text)
    if array is not None:
        element = written_type(array[1])
        size = integer(array[3]) if array[3] else None
        return Array(element, size, bool(array[2])) if element is not None else None
    name, bounded, bound = text.partition("<=")
    if name in PRIMITIVES and bound.isdigit() == bool(bounded):
        return Primitive(name, integer(bound) if bounded else None)
    named = _WRITTEN_NAME.fullmatch(text)
    return Named(named[1], named[2]) if named is not None else None
