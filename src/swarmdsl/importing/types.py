"""Types as the CPSwarm project writes them: `pkg/Class`, `pkg.srv.Class`, or only `Class`."""

from __future__ import annotations

import re

from swarmdsl.ir import Array, Named, Primitive, Type
from swarmdsl.ir.types import PRIMITIVES

# Scripts of the code generator find bare names in these two packages.
_VALUES = ("Bool", "Int", "UInt", "Double", "String")
_SWARMROS = {"EventHeader", "NodeInfo", "SimpleEvent", *_VALUES, *(f"ArrayOf{v}" for v in _VALUES)}
_ARRAY = re.compile(r"(.+)\[(\d*)\]")
_ALIASES = {"number": "float64", "boolean": "bool", "float": "float64", "int": "int32"}
_ALIASES |= {"double": "float64", "integer": "int32", "String": "string"}
MISSPELT = {"stds_msgs": "std_msgs"}
"""Packages that do not exist, and what they mean: the files of the project have them."""


def qualified(text: str, kind: str) -> Named:
    """The interface that a class means; `kind` is message, service or action."""
    words = re.findall(r"[A-Za-z][A-Za-z0-9_]*", text)
    name = words[-1] if words else "Empty"
    if len(words) > 1:
        return Named(MISSPELT.get(words[0], words[0]), name)
    if kind == "service" and name in ("Empty", "Trigger", "SetBool"):
        return Named("std_srvs", name)
    return Named("swarmros" if kind == "message" and name in _SWARMROS else "cpswarm_msgs", name)


def data_type(text: str) -> Type:
    """The type of a field or parameter."""
    array = _ARRAY.fullmatch(text)
    if array is not None:
        return Array(data_type(array[1]), int(array[2]) if array[2] else None)
    name = _ALIASES.get(text, text)
    if name in PRIMITIVES:
        return Primitive(name)
    if name == "Header":
        return Named("std_msgs", name)
    return qualified(text, "message")
