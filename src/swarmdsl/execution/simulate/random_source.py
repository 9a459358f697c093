"""Random numbers that depend on what they are for, and on nothing else."""

from __future__ import annotations

from hashlib import sha256
from random import Random


class Chance:
    """A stream of numbers for each question, made of a seed and the words of the question.

    So whoever is added to a swarm changes nothing for the others, and a run is the same on
    every platform.
    """

    def __init__(self, seed: int) -> None:
        self.seed = seed

    def about(self, *words: str | int | None) -> Random:
        """The numbers for a question."""
        text = "\0".join(map(str, (self.seed, *words)))
        return Random(int.from_bytes(sha256(text.encode()).digest(), "big"))
