"""Random numbers of many robots at a time, each from the seed, the robot, a question and a count.

No number depends on which others are asked for: a run alone, and one of many that are computed
together, are the same, and so are robots when others join them.
"""

from __future__ import annotations

from hashlib import sha256

import numpy as np

from swarmdsl.execution.space.arrays import Floats, Whole, Words

# The finalizer of SplitMix64 (Steele, Lea and Flood, 2014).
_GOLDEN = np.uint64(0x9E3779B97F4A7C15)
_FIRST = np.uint64(0xBF58476D1CE4E5B9)
_SECOND = np.uint64(0x94D049BB133111EB)
_BITS_OF_FLOAT = np.uint64(11)
_TO_SHARE = 2.0**-53


def key(*words: str | int | None) -> int:
    """Return a number of 64 bits for some words."""
    return int.from_bytes(sha256("\0".join(map(str, words)).encode()).digest()[:8], "big")


def mixed(numbers: Words) -> Words:
    """Return numbers in which each bit depends on all bits of the given ones."""
    numbers = numbers + _GOLDEN
    numbers = (numbers ^ (numbers >> np.uint64(30))) * _FIRST
    numbers = (numbers ^ (numbers >> np.uint64(27))) * _SECOND
    return numbers ^ (numbers >> np.uint64(31))


def shares(keys: Words, question: int, counts: Words | Whole | int) -> Floats:
    """Return a random number from 0 to less than 1 for each key and count."""
    asked = mixed(keys ^ np.uint64(question))
    drawn = mixed(asked + np.asarray(counts).astype(np.uint64))
    return (drawn >> _BITS_OF_FLOAT).astype(np.float64) * _TO_SHARE
