"""Positions near those of neighbors, from which the network simplex has little to do.

Each number moves to the mean of what its segments ask for. Where these are too near to each other,
half of the way is made from either side, as positions pushed forwards and positions pushed
backwards both have the distances, and so has their mean.
"""

from __future__ import annotations

from collections.abc import Sequence

Pull = tuple[int, int, int, int]
"""(one, other, distance, weight): it is best if other = one + distance."""

_ROUNDS = 2


def relax(
    places: Sequence[int],
    order: Sequence[int],
    after: Sequence[Sequence[tuple[int, int, int]]],
    pulls: Sequence[Pull],
) -> list[int]:
    """Return better places; `after` are the numbers after each one, with their least distance.

    `order` has all numbers, each before those after it.
    """
    found = list(places)
    weight = [0] * len(found)
    for one, other, _, cost in pulls:
        weight[one] += cost
        weight[other] += cost
    for _ in range(_ROUNDS):
        total = [0] * len(found)
        for one, other, distance, cost in pulls:
            total[one] += cost * (found[other] - distance)
            total[other] += cost * (found[one] + distance)
        forwards = [
            sum_ // cost if cost else place
            for sum_, cost, place in zip(total, weight, found, strict=True)
        ]
        backwards = list(forwards)
        for number in order:
            place = forwards[number]
            for head, room, _ in after[number]:
                if forwards[head] < place + room:
                    forwards[head] = place + room
        for number in reversed(order):
            for head, room, _ in after[number]:
                if backwards[number] > backwards[head] - room:
                    backwards[number] = backwards[head] - room
        found = [(one + other) // 2 for one, other in zip(forwards, backwards, strict=True)]
    return found
