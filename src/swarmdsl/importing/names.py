"""Names that the language takes, each given once."""

from __future__ import annotations

import re
from collections.abc import Callable

from swarmdsl.base.naming import camel_case, snake_case
from swarmdsl.syntax.parser.keywords import RESERVED

_PLAIN = re.compile(r"[A-Za-z_]\w*", re.ASCII)


def is_plain(name: str) -> bool:
    """Whether only its style may have to change for the language to take it."""
    return _PLAIN.fullmatch(name) is not None and name not in RESERVED


class Names:
    """The names of one kind of thing; `style` brings one into the form that is usual."""

    def __init__(self, style: Callable[[str], str]) -> None:
        self.style = style
        self.taken: set[str] = set()
        self.given: dict[str, str] = {}
        self.numbers: dict[str, int] = {}

    def of(self, text: str) -> str:
        """The name of a thing; the same for the same text."""
        if text not in self.given:
            self.given[text] = self.new(text)
        return self.given[text]

    def exact(self, text: str) -> str:
        """The name itself, where the language takes it; else one that no other thing has."""
        if not is_plain(text) or text in self.taken:
            return self.new(text)
        self.taken.add(text)
        return text

    def new(self, text: str) -> str:
        """A name that no other thing has, in the usual style."""
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


def type_names() -> Names:
    """Names of states, machines and events, `LikeThis`."""
    return Names(camel_case)


def value_names() -> Names:
    """Names of variables and functions, `like_this`."""
    return Names(snake_case)
