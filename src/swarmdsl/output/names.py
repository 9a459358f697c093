"""An element of the model that gets another name: its files, and the names in them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cached_property

from swarmdsl.base.naming import camel_case, snake_case

_WORD = re.compile(r"\w+")


class Names:
    """Two names of an element, in all the forms in which generated code has them."""

    def __init__(self, old: str, new: str) -> None:
        forms_of_old, forms_of_new = _forms(old), _forms(new)
        self.old, self.new = old, new
        self._plain = forms_of_old[0]
        self._forward = _Replacement(forms_of_old, forms_of_new)
        self._backward = _Replacement(forms_of_new, forms_of_old)

    def __call__(self, text: str) -> str:
        """A path or a text of the generator under the new name."""
        return self._forward(text)

    def place(self, text: str) -> tuple[int, int]:
        """Where the old name first stands in a text that has it."""
        return self._forward.place(text)

    def same(self, before: Sequence[str], now: Sequence[str]) -> bool:
        """Whether lines are the same, but for the new name where it may be meant."""
        pairs = zip(before, now, strict=False)
        equal = all(new in (old, self._forward(old)) for old, new in pairs)
        return equal and len(before) == len(now)

    def rewritten(self, of_user: str, generated: str) -> tuple[str, list[int]]:
        """A file of the user as far as it is clear what the new name changes in it.

        `generated` is what the generator makes of it under the new name. Lines that it has are
        taken from there; in others, identifiers that it has and that can be nothing else.
        The second value are the lines, counted from 1, in which the old name still stands.
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
        # In `TestTakeoff` and `takeoff_base` it is a word too, in `takeoffs` it is not.
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
