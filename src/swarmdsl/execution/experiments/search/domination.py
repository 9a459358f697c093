"""Domination of losses: one is no worse in any objective, and better in one."""

from __future__ import annotations

import math
from collections.abc import Sequence

Losses = tuple[float, ...]
"""A number for each objective, which is less for a better one."""


def dominates(left: Losses, right: Losses) -> bool:
    """Return True if `left` is no worse anywhere, and better somewhere."""
    return left != right and all(a <= b for a, b in zip(left, right, strict=True))


def fronts(losses: Sequence[Losses]) -> list[list[int]]:
    """Return the numbers of those that nothing dominates, then those after these are gone, ..."""
    left, found = list(range(len(losses))), []
    while left:
        front = [each for each in left if not any(dominates(losses[o], losses[each]) for o in left)]
        found.append(front)
        left = [each for each in left if each not in set(front)]
    return found


def crowding(losses: Sequence[Losses], front: Sequence[int]) -> dict[int, float]:
    """Return how far the neighbours of each one are; those at an end have none.

    The measure is that of K. Deb and others, 2002.
    """
    found = dict.fromkeys(front, 0.0)
    for number in range(len(losses[front[0]])):
        ordered = sorted(front, key=lambda each: losses[each][number])
        width = losses[ordered[-1]][number] - losses[ordered[0]][number]
        found[ordered[0]] = found[ordered[-1]] = math.inf
        for before, each, after in zip(ordered, ordered[1:], ordered[2:], strict=False):
            if width > 0:
                found[each] += (losses[after][number] - losses[before][number]) / width
    return found


def in_order(losses: Sequence[Losses]) -> list[int]:
    """Return all numbers, the first front first, in it those with the most room around them."""
    found: list[int] = []
    for front in fronts(losses):
        room = crowding(losses, front)
        found += sorted(front, key=lambda each: (-room[each], losses[each], each))
    return found
