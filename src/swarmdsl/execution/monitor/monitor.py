"""Monitor of a property: its pattern in the parts of a run that its scope selects.

Scopes are those of M. Dwyer, G. Avrunin and J. Corbett, Patterns in Property Specifications for
Finite-State Verification, 1999: all of a run, `after` P, `before` P, `between` P and Q, and
after P `until` Q. A part begins with the step at which P holds, and ends before that of Q.
"""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass
from typing import Literal

from .patterns import Pattern, pattern_of

Verdict = Literal["true", "false", "open"]
TRUE: Verdict = "true"
FALSE: Verdict = "false"
OPEN: Verdict = "open"
_CAUSED = ("leads", "only")
"""Kinds of sentences that say nothing of a run in which their first claim never holds."""


@dataclass(frozen=True)
class Sentence:
    """Kind and scope of a property, with the length of `within` in nanoseconds.

    A claim that is `momentary` is about what happens, not about what is.
    """

    kind: str
    scope: str | None = None
    within: int | None = None
    times: int | None = None
    momentary: bool = False


class Monitor:
    """Deterministic automaton that follows a run.

    `violated` is the time at which the property was violated, once that is certain.
    """

    def __init__(self, sentence: Sentence) -> None:
        self.violated: int | None = None
        self._sentence = sentence
        self._scope = sentence.scope
        self._pattern: Pattern | None = None
        self._over = False
        self._began = False
        self._ended = False
        self._happened = sentence.kind not in _CAUSED

    def copy(self) -> Monitor:
        """Return a monitor that has seen the same."""
        made = copy(self)
        made._pattern = copy(self._pattern)
        return made

    @property
    def memory(self) -> tuple[object, ...]:
        """All that decides on what it says from now on: equal for equal monitors of a sentence."""
        pattern = tuple(sorted(vars(self._pattern).items())) if self._pattern is not None else None
        return (self.violated, self._over, pattern)

    @property
    def history(self) -> tuple[bool, ...]:
        """All that decides on its remark from now on, with the memory."""
        return (self._began, self._ended, self._happened)

    @property
    def clock(self) -> int | None:
        """Time after which the part of the run violates the pattern unless something happens."""
        return self._pattern.due if self._pattern is not None and not self.decided else None

    def forget_times(self, due: int) -> None:
        """Replace the time at which it is due, and forget those of violations."""
        pattern = self._pattern
        if self.violated is not None:
            self.violated = 0
        if pattern is not None and pattern.due is not None:
            pattern.due = due
        if pattern is not None and pattern.broken is not None:
            pattern.broken, pattern.due = 0, None

    @property
    def decided(self) -> bool:
        """Return True if no further step can change the verdict."""
        return self.violated is not None or self._over

    @property
    def state(self) -> Verdict:
        """The verdict so far: open while something must still happen."""
        if self.violated is not None:
            return FALSE
        pattern = self._pattern
        settled = pattern is None or (pattern.broken is None and not pattern.owes)
        return TRUE if settled else OPEN

    @property
    def remark(self) -> str:
        """Return why the property says nothing of the run, else an empty string."""
        if not self._began:
            return "its scope never began"
        if self._waits_for_end and not self._ended:
            return "its scope never ended"
        return "" if self._happened else "its first part never happened"

    @property
    def due(self) -> int | None:
        """Time after which the property is violated unless something happens."""
        if self.decided or self._pattern is None or self._waits_for_end:
            return None
        return self._pattern.due if self._pattern.broken is None else None

    def step(self, time: int, claims: Sequence[bool], scope: Sequence[bool] = ()) -> None:
        """Process a step, with the truth of the claims and of those of the scope."""
        self.advance(time)
        if self.decided:
            return
        if self._pattern is not None and self._ends(scope):
            self._close(time)
            if self.decided:
                return
        if self._pattern is None and self._begins(scope):
            self._open(time)
            if self._scope == "before" and scope[0]:
                self._close(time)
        if self._pattern is not None and self._pattern.broken is None:
            self._happened |= claims[0]
            self._pattern.step(time, claims)
            self._judge()

    def advance(self, time: int) -> None:
        """Let time pass."""
        if self._pattern is not None and not self.decided:
            self._pattern.advance(time)
            self._judge()

    def finish(self, time: int, *, ended: bool = False) -> Verdict:
        """Return the verdict at the end of a run; if it has `ended`, nothing can happen any more.

        Without a violation the verdict is true if nothing is left to happen, else open.
        """
        self.advance(time)
        if self.violated is not None:
            return FALSE
        if self.state == TRUE:
            return TRUE
        if self._waits_for_end:
            # The part of the run that it is about ends with a claim that did not come.
            return TRUE if ended else OPEN
        if ended:
            self.violated = time
            return FALSE
        return OPEN

    @property
    def _waits_for_end(self) -> bool:
        """Return True if only the end of a part of the run makes a violation certain."""
        return self._scope in ("before", "between")

    def _begins(self, scope: Sequence[bool]) -> bool:
        if self._scope in ("between", "until"):
            return scope[0] and not scope[1]
        return self._scope != "after" or scope[0]

    def _ends(self, scope: Sequence[bool]) -> bool:
        if self._scope == "before":
            return scope[0]
        return self._scope in ("between", "until") and scope[1]

    def _open(self, time: int) -> None:
        self._began = True
        said = self._sentence
        self._pattern = pattern_of(
            said.kind, time, said.within, said.times, momentary=said.momentary
        )

    def _close(self, time: int) -> None:
        assert self._pattern is not None
        self._pattern.close(time)
        if self._pattern.broken is not None:
            self.violated = time if self._waits_for_end else self._pattern.broken
        self._ended = True
        self._over = self._scope == "before"
        self._pattern = None

    def _judge(self) -> None:
        assert self._pattern is not None
        if not self._waits_for_end:
            self.violated = self._pattern.broken
