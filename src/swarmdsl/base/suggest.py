"""Suggestions for misspelled words."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from itertools import pairwise

from swarmdsl.base.diagnostics.advice import meant, only
from swarmdsl.base.diagnostics.collector import listed

# As many words are compared closely; out of more, those with most pairs of letters in common.
_COMPARED = 50


def closest(word: str, known: Iterable[str], likeness: float = 0.6) -> str | None:
    """Return the known word most like another, None if none is similar enough (1: equal)."""
    by_lower = {name.lower(): name for name in known}
    if not word or not by_lower:
        return None
    # Imported here because they are slow and most models have no such word.
    from difflib import get_close_matches
    from heapq import nlargest

    word = word.lower()
    compared: Iterable[str] = by_lower
    if len(by_lower) > _COMPARED:
        pairs = _pairs(word)
        compared = nlargest(_COMPARED, by_lower, key=lambda name: len(pairs & _pairs(name)))
    close = get_close_matches(word, compared, n=3, cutoff=likeness)
    meant = next((each for each in close if _abbreviates(word, each)), close[0] if close else None)
    return by_lower[meant] if meant is not None else None


def _abbreviates(word: str, name: str) -> bool:
    """Return True if a word is a longer name without some letters inside: `idx` for `index`."""
    letters = iter(name)
    return word[0] == name[0] and word[-1] == name[-1] and all(one in letters for one in word)


@lru_cache(maxsize=1 << 14)
def _pairs(word: str) -> frozenset[tuple[str, str]]:
    return frozenset(pairwise(word))


def did_you_mean(word: str, known: Iterable[str]) -> str | None:
    """Return a question that names the closest known word, None if none is similar."""
    name = closest(word, known)
    return meant(name) if name else None


def suggest(word: str, known: Iterable[str], what: str) -> str:
    """`did_you_mean`, or else all there is: "the targets are `a` and `b`"."""
    names = list(known)
    if question := did_you_mean(word, names):
        return question
    return (
        only(f"the {what} are {listed(names, 'and')}", names) if names else f"there are no {what}"
    )
