"""Random numbers of many robots at a time, each from the seed, the robot, a question and a count.

No number depends on which others are asked for: a run alone, and one of many that are computed
together, are the same, and so are robots when others join them.
"""

from __future__ import annotations

from hashlib import sha256

import numpy as np

from swarmdsl.execution.space.arrays import Floats, Whole, Words

# The finalizer of SplitMix64 (Steele, Lea and Flood, 2014).
# Arrays of no dimension: NumPy takes them in half the time of numbers.
_GOLDEN = np.array(0x9E3779B97F4A7C15, dtype=np.uint64)
_FIRST = np.array(0xBF58476D1CE4E5B9, dtype=np.uint64)
_SECOND = np.array(0x94D049BB133111EB, dtype=np.uint64)
_SHIFTS = tuple(np.array(bits, dtype=np.uint64) for bits in (30, 27, 31))
_BITS_OF_FLOAT = np.array(11, dtype=np.uint64)
_TO_SHARE = np.array(2.0**-53)


def key(*words: str | int | None) -> int:
    """Return a number of 64 bits for some words."""
    return int.from_bytes(sha256("\0".join(map(str, words)).encode()).digest()[:8], "big")


def mixed(numbers: Words) -> Words:
    """Return numbers in which each bit depends on all bits of the given ones."""
    numbers = numbers + _GOLDEN
    numbers ^= numbers >> _SHIFTS[0]
    numbers *= _FIRST
    numbers ^= numbers >> _SHIFTS[1]
    numbers *= _SECOND
    numbers ^= numbers >> _SHIFTS[2]
    return numbers


def shares(keys: Words, question: int, counts: Words | Whole | int) -> Floats:
    """Return a random number from 0 to less than 1 for each key and count."""
    return numbered(mixed(keys ^ np.uint64(question)), counts)


def numbered(asked: Words, counts: Words | Whole | int) -> Floats:
    """Return a random number from 0 to less than 1 for each mixed question and count."""
    drawn = mixed(asked + np.asarray(counts).astype(np.uint64))
    found: Floats = (drawn >> _BITS_OF_FLOAT).astype(np.float64) * _TO_SHARE
    return found
