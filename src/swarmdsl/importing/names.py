"""Unique names that are valid in the language."""

from __future__ import annotations

import re
from collections.abc import Callable

from swarmdsl.base.naming import camel_case, snake_case
from swarmdsl.syntax.parser.keywords import RESERVED

_PLAIN = re.compile(r"[A-Za-z_]\w*", re.ASCII)


def is_plain(name: str) -> bool:
    """Return True for a valid identifier that is not reserved."""
    return _PLAIN.fullmatch(name) is not None and name not in RESERVED


class NamePool:
    """Unique names of one namespace; `style` converts a name to its usual form."""

    def __init__(self, style: Callable[[str], str]) -> None:
        self.style = style
        self.taken: set[str] = set()
        self.given: dict[str, str] = {}
        self.numbers: dict[str, int] = {}

    def of(self, text: str) -> str:
        """Name for a string; equal strings get equal names."""
        if text not in self.given:
            self.given[text] = self.new(text)
        return self.given[text]

    def exact(self, text: str) -> str:
        """Return the string itself if it is a valid and free name, otherwise a new name."""
        if not is_plain(text) or text in self.taken:
            return self.new(text)
        self.taken.add(text)
        return text

    def new(self, text: str) -> str:
        """Return a new unique name in the usual style."""
        ascii_ = text.encode("ascii", "ignore").decode()
        name = self.style(re.sub(r"[^A-Za-z0-9]+", "_", ascii_))
        if not name or not name[0].isalpha():
            name = self.style(f"n_{name}") if name else self.style("unnamed")
        if name in RESERVED:
            name += "_"
        number, free = self.numbers.get(name, 1), name
        while free in self.taken:
            number += 1
            free = f"{name}{number}"
        self.numbers[name] = number
        self.taken.add(free)
        return free


def type_names() -> NamePool:
    """Names of states, machines and events, in CamelCase."""
    return NamePool(camel_case)


def value_names() -> NamePool:
    """Names of variables and functions, in snake_case."""
    return NamePool(snake_case)
