"""Docking: one robot at a charger at a time, in the order in which they asked."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Flags, Floats, Whole

FREE = -1


def admit(guest: Whole, asked: Floats) -> tuple[Whole, Floats]:
    """Return who is at each charger after the free ones were given away, and who still waits.

    `guest` (seeds, chargers) has the number of the robot that holds a charger, or `FREE`; `asked`
    (seeds, robots) has the time at which a robot asked, infinite for one that does not wait. Of
    robots that asked at the same time, the one with the lowest number is first.
    """
    guest, asked = guest.copy(), asked.copy()
    runs = np.arange(len(guest))
    for charger in range(guest.shape[1]):
        first = asked.argmin(axis=1)
        gives = (guest[:, charger] == FREE) & np.isfinite(asked[runs, first])
        guest[gives, charger] = first[gives]
        asked[runs[gives], first[gives]] = np.inf
    return guest, asked


def release(guest: Whole, leaves: Flags) -> Whole:
    """Return who is at each charger after robots (seeds, robots) have left or are lost."""
    held = guest != FREE
    gone = np.take_along_axis(leaves, np.maximum(guest, 0), axis=1) & held
    return np.where(gone, FREE, guest)
