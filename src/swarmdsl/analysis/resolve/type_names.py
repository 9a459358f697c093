"""Types that are written in full, and the full names of declared interfaces.

float64[3]      -> Array(Primitive("float64"), 3)
std_msgs/Empty  -> Named("std_msgs", "Empty")
Mode            -> None: the name of a declaration, resolved by `resolve.types`
"""

from __future__ import annotations

import re

from swarmdsl.base.numerals import integer
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import TypeRef
from swarmdsl.syntax.types import PRIMITIVES, Array, Named, Primitive, Type, with_unit
from swarmdsl.syntax.units import UNITS

_PRIMITIVES = {name: Primitive(name) for name in PRIMITIVES}
_BRACKETS = re.compile(r"\[\s*(<=?)?\s*([^\]\s]*)\s*\]")
# The number of elements or characters has at most this many digits.
_MAX_DIGITS = 9


def interface_name(file: File, name: str) -> Named:
    """Full name of an interface that a file declares."""
    # Without a slash, the last part is `name` itself: a word, with its place.
    package, _, last = str(name).rpartition("/")
    return Named(package or file.package.replace(".", "_"), last)


def written_type(ref: TypeRef) -> Type | None:
    """Type that a reference writes in full; None for the name of a declaration."""
    element = written_element(ref)
    type_ = array_of(element, ref) if element is not None and ref.array else element
    unit = UNITS.get(ref.unit) if ref.unit is not None else None
    return with_unit(type_, unit) if type_ is not None and unit is not None else type_


def written_element(ref: TypeRef) -> Type | None:
    """Type of a reference without its brackets; None for the name of a declaration."""
    if ref.name in _PRIMITIVES:
        return Primitive(ref.name, integer(bound_of(ref))) if ref.bound else _PRIMITIVES[ref.name]
    package, slash, name = ref.name.partition("/")
    return Named(package, name) if slash else None


def array_of(element: Type, ref: TypeRef) -> Array:
    """Array type of a reference with one valid pair of brackets."""
    ((bounded, size),) = brackets_of(ref)
    return Array(element, integer(size) if size else None, bool(bounded))


def brackets_of(ref: TypeRef) -> list[tuple[str, str]]:
    """Relation and size in each pair of brackets: `[<=4][]` gives `("<=", "4"), ("", "")`."""
    return _BRACKETS.findall(ref.array)


def bound_of(ref: TypeRef) -> str:
    """Bound of a string type: `8` of `string<=8`."""
    return ref.bound.strip("<= \t\n")


def is_size(number: str) -> bool:
    """Return True for a number of elements or characters that a message can hold."""
    return number.isdigit() and len(number) <= _MAX_DIGITS and int(number) > 0
