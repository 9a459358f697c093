"""Verdicts on whole runs by the definitions of the patterns, word for word; slow.

A run is a list of steps; nothing is carried from one step to the next.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement

from swarmdsl.execution.monitor import FALSE, OPEN, TRUE, Sentence, Verdict


@dataclass(frozen=True, eq=False)
class Step:
    """Moment of a run, with the truth of the claims and of those of the scope."""

    time: int
    claims: tuple[bool, ...]
    scope: tuple[bool, ...]


@dataclass(frozen=True)
class Part:
    """Steps that a property is about; `closed` is the time of the step after them."""

    start: int
    steps: Sequence[Step]
    closed: int | None


def parts(run: Sequence[Step], scope: str | None) -> list[Part]:
    """Return the parts of a run that a scope selects."""
    if not run:
        return []
    if scope is None:
        return [Part(run[0].time, run, None)]
    if scope == "after":
        first = next((n for n, step in enumerate(run) if step.scope[0]), None)
        return [] if first is None else [Part(run[first].time, run[first:], None)]
    if scope == "before":
        last = next((n for n, step in enumerate(run) if step.scope[0]), None)
        closed = None if last is None else run[last].time
        return [Part(run[0].time, run[:last], closed)]
    found = []
    for begin, step in enumerate(run):
        inside = any(part.steps[0] is not step and step in part.steps for part in found)
        if step.scope[0] and not step.scope[1] and not inside:
            end = next((n for n in range(begin, len(run)) if run[n].scope[1]), None)
            closed = None if end is None else run[end].time
            found.append(Part(step.time, run[begin:end], closed))
    return found


def verdict(sentence: Sentence, run: Sequence[Step], end: int, *, ended: bool) -> Verdict:
    """Return the verdict on a run until a time, by the definitions."""
    found = [_of_part(sentence, part, end, ended) for part in parts(run, sentence.scope)]
    return FALSE if FALSE in found else OPEN if OPEN in found else TRUE


def _of_part(sentence: Sentence, part: Part, end: int, ended: bool) -> Verdict:
    waits = sentence.scope in ("before", "between") and part.closed is None
    if waits and ended:
        return TRUE
    over = part.closed is not None or (ended and not waits)
    last = end if part.closed is None else part.closed
    found = _holds(sentence, part, last, over)
    return OPEN if waits and found is FALSE else found


def _holds(sentence: Sentence, part: Part, last: int, over: bool) -> Verdict:
    steps, within = part.steps, sentence.within
    every, many = range(len(steps)), len(steps)

    def p(number: int) -> bool:
        return steps[number].claims[0]

    def q(number: int) -> bool:
        return steps[number].claims[1]

    def late(since: int) -> bool:
        return over or (within is not None and last > since + within)

    def soon(number: int, since: int) -> bool:
        return within is None or steps[number].time <= since + within

    match sentence.kind:
        case "never":
            return FALSE if any(map(p, every)) else TRUE
        case "always":
            return TRUE if all(map(p, every)) else FALSE
        case "eventually":
            if any(p(n) and soon(n, part.start) for n in every):
                return TRUE
            return FALSE if late(part.start) else OPEN
        case "leads":
            waiting = [
                steps[n].time
                for n in every
                if p(n) and not any(q(m) and soon(m, steps[n].time) for m in range(n, many))
            ]
            return TRUE if not waiting else FALSE if any(map(late, waiting)) else OPEN
        case "only":
            allowed = all(any(map(q, range(n + 1))) for n in every if p(n))
            return TRUE if allowed else FALSE
        case "times":
            times = [n for n in every if p(n) and (sentence.momentary or not n or not p(n - 1))]
            return TRUE if len(times) <= (sentence.times or 0) else FALSE
        case "then":
            wanted = len(steps[0].claims) if steps else 1
            for places in combinations_with_replacement(every, wanted):
                if all(steps[n].claims[k] for k, n in enumerate(places)):
                    return TRUE
            return FALSE if over else OPEN
        case "again":
            return TRUE if steps and p(many - 1) else FALSE if over else OPEN
        case "possible":
            if part.closed is not None or (steps and p(many - 1)):
                return TRUE
            return FALSE if over else OPEN
    raise AssertionError(sentence.kind)
