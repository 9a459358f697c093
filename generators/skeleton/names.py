"""Names for generated code that are valid in Python and C++."""

from __future__ import annotations

import keyword
import re
from collections.abc import Iterable

from swarmdsl.codegen import snake_case

TARGET = "skeleton"

# Keywords of C++20 (ISO/IEC 14882:2020, 5.11).
_CPP_WORDS = """
alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t
char16_t char32_t class compl concept const consteval constexpr constinit const_cast
continue co_await co_return co_yield decltype default delete do double dynamic_cast else
enum explicit export extern false float for friend goto if inline int long mutable
namespace new noexcept not not_eq nullptr operator or or_eq private protected public
register reinterpret_cast requires return short signed sizeof static static_assert
static_cast struct switch template this thread_local throw true try typedef typeid
typename union unsigned using virtual void volatile wchar_t while xor xor_eq
"""
_CPP = frozenset(_CPP_WORDS.split())


def identifiers(names: Iterable[str]) -> list[str]:
    """Return a unique identifier in snake case for each name.

    A topic such as `mavros/state` becomes `mavros_state`.
    """
    found: dict[str, None] = {}
    for name in names:
        base = _identifier(name)
        fresh, number = base, 2
        while fresh in found:
            fresh, number = f"{base}_{number}", number + 1
        found[fresh] = None
    return list(found)


def is_cpp_word(name: str) -> bool:
    """Return True for a reserved word of C++."""
    return name in _CPP


def python_field(name: str) -> str:
    """Return a field's name in Python: generators of ROS append `_` to keywords."""
    return f"{name}_" if keyword.iskeyword(name) or name == "self" else name


def _identifier(name: str) -> str:
    made = snake_case(re.sub(r"[^A-Za-z0-9]+", "_", name))
    if not made or made[0].isdigit():
        made = f"topic_{made}".rstrip("_")
    return f"{made}_" if keyword.iskeyword(made) or made in _CPP else made
