"""Choices of what is left open in a step: how many robots are near, whether a condition holds."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from swarmdsl.execution.simulate.machines.expressions import CHOICE, NEIGHBORS

_MOST_FREE = 8
"""Maximum number of free choices in a step that are followed."""


class Nearness:
    """Answers to `neighbors within`, chosen from 0 to the number of other robots; free choices.

    A macrostep takes no time: in one, the answer is the same for the same distance, and no less for
    a longer one. Where no answer is chosen it is the least.
    """

    def __init__(self, others: int) -> None:
        self._others = others
        self._chosen: Sequence[int] = ()
        self._asked: list[tuple[int, int]] = []
        """Each answer of the step, with the greatest that was possible."""
        self._known: dict[float, int] = {}
        self.has_too_many = False
        """True if a step had more free choices than are followed."""

    @property
    def functions(self) -> dict[str, Any]:
        """Functions that machines ask, as their data have them."""
        return {NEIGHBORS: self.count, CHOICE: self.choice}

    @property
    def is_asked(self) -> bool:
        """True if the step asks who is near."""
        return bool(self._asked)

    def choose(self, answers: Sequence[int]) -> None:
        """Begin a step with these answers, in the order of the questions."""
        self._chosen = answers
        self._asked.clear()
        self._known.clear()

    def begin_macrostep(self) -> None:
        """Forget the answers: another machine asks, or time may have passed."""
        self._known.clear()

    def count(self, distance: float) -> int:
        """Return the number of robots within a distance."""
        if distance not in self._known:
            known = self._known.items()
            least = max((n for d, n in known if d < distance), default=0)
            most = min((n for d, n in known if d > distance), default=self._others)
            self._known[distance] = self._answer(least, most)
        return self._known[distance]

    def choice(self, number: int) -> int:
        """Return any number less than the given one: a free choice, which no other one binds."""
        if len(self._asked) >= _MOST_FREE:
            self.has_too_many = True
            return 0
        return self._answer(0, number - 1)

    def others(self) -> Iterator[tuple[int, ...]]:
        """Yield the beginnings of answers that the step leaves out, and no other step tries."""
        answers = tuple(answer for answer, _ in self._asked)
        for at in range(len(self._chosen), len(answers)):
            answer, most = self._asked[at]
            for more in range(answer + 1, most + 1):
                yield (*answers[:at], more)

    def _answer(self, least: int, most: int) -> int:
        at = len(self._asked)
        answer = self._chosen[at] if at < len(self._chosen) else least
        self._asked.append((answer, most))
        return answer
