"""Random numbers that depend only on a seed and a purpose."""

from __future__ import annotations

from hashlib import sha256
from random import Random


class RandomSource:
    """Independent random stream for each question, derived from seed and words.

    Adding members to a swarm thus changes nothing for the others, and a run is the same on every
    platform.
    """

    def __init__(self, seed: int) -> None:
        self.seed = seed

    def stream(self, *words: str | int | None) -> Random:
        """Return the random stream of a question."""
        text = "\0".join(map(str, (self.seed, *words)))
        return Random(int.from_bytes(sha256(text.encode()).digest(), "big"))
