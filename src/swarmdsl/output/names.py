"""Rename a model element in generated paths and contents."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cached_property

from swarmdsl.base.naming import camel_case, snake_case

_WORD = re.compile(r"\w+")


class Names:
    """Old and new name of an element, in all forms that generated code uses."""

    def __init__(self, old: str, new: str) -> None:
        forms_of_old, forms_of_new = _forms(old), _forms(new)
        self.old, self.new = old, new
        self._plain = forms_of_old[0]
        self._forward = _Replacement(forms_of_old, forms_of_new)
        self._backward = _Replacement(forms_of_new, forms_of_old)

    def __call__(self, text: str) -> str:
        """Replace the old name in a generated path or string."""
        return self._forward(text)

    def place(self, text: str) -> tuple[int, int]:
        """Return the range of the first old name in a string."""
        return self._forward.place(text)

    def same(self, before: Sequence[str], now: Sequence[str]) -> bool:
        """Return True if lines are equal except for the new name."""
        pairs = zip(before, now, strict=False)
        equal = all(new in (old, self._forward(old)) for old, new in pairs)
        return equal and len(before) == len(now)

    def rewritten(self, of_user: str, generated: str) -> tuple[str, list[int]]:
        """Replace the old name in a file of the user as far as that is unambiguous.

        `generated` is the generated content under the new name. Lines that only differ in the name
        are taken from it; in other lines, identifiers that can mean nothing else are replaced.
        Also returns the lines, from 1, that still contain the old name.
        """
        lines = {self._backward(line): line for line in generated.splitlines()}
        words = set(_WORD.findall(generated))
        renamed = {self._backward(word): word for word in words}
        safe = {old: new for old, new in renamed.items() if old not in (*words, self._plain)}
        made, left = [], []
        for number, line in enumerate(of_user.splitlines(keepends=True), 1):
            bare = line.rstrip("\r\n")
            if bare in lines:
                made.append(lines[bare] + line[len(bare) :])
                continue
            new = _WORD.sub(lambda word: safe.get(word[0], word[0]), line)
            made.append(new)
            if self._forward(new) != new:
                left.append(number)
        return "".join(made), left


class _Replacement:
    def __init__(self, forms: tuple[str, ...], into: tuple[str, ...]) -> None:
        self._forms, self._into = forms, into

    @cached_property
    def _pattern(self) -> re.Pattern[str]:
        snake, camel, upper, plain = map(re.escape, self._forms)
        # It is a word in `TestTakeoff` and `takeoff_base`, but not in `takeoffs`.
        apart, after = "(?<![A-Za-z0-9])", "(?![A-Za-z0-9])"
        return re.compile(
            f"{apart}({snake}){after}|({camel})(?![a-z0-9])"
            f"|{apart}({upper}){after}|{apart}({plain}){after}"
        )

    def place(self, text: str) -> tuple[int, int]:
        found = self._pattern.search(text)
        return found.span() if found is not None else (0, len(text))

    def __call__(self, text: str) -> str:
        return self._pattern.sub(lambda found: self._into[(found.lastindex or 1) - 1], text)


def _forms(name: str) -> tuple[str, ...]:
    snake = snake_case(name) or name
    return snake, camel_case(name) or name, snake.upper(), name
