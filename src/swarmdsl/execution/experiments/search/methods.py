"""Methods of a search: they propose points, and learn how good these are.

A method is asked for a generation as a whole, and told of it in order: what it proposes does not
depend on who runs the candidates, nor on when they are done.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from importlib.util import find_spec
from itertools import islice
from random import Random
from typing import Literal, Protocol

from swarmdsl.execution.experiments.failures import StoppedError
from swarmdsl.execution.experiments.search.domination import Losses
from swarmdsl.execution.experiments.search.nsga import Nsga
from swarmdsl.execution.experiments.search.space import Point, SearchSpace

Name = Literal["auto", "cma", "nsga", "tpe", "grid", "random"]
NAMES: tuple[Name, ...] = ("auto", "cma", "nsga", "tpe", "grid", "random")
GENERATION = 20
"""Points of a generation, for methods that do not care."""


class Method(Protocol):
    """Proposes points."""

    def ask(self, most: int) -> list[Point]:
        """Return the points of a generation, at most so many; none if there are no more."""

    def tell(self, points: Sequence[Point], losses: Sequence[Losses]) -> None:
        """Learn how bad the points of the generation are: the least loss is the best."""


class Listed:
    """Points that do not depend on losses."""

    def __init__(self, points: Iterator[Point]) -> None:
        self._points = points

    def ask(self, most: int) -> list[Point]:
        """Return the next points."""
        return list(islice(self._points, min(most, GENERATION)))

    def tell(self, points: Sequence[Point], losses: Sequence[Losses]) -> None:
        """Learn nothing."""


def random_points(space: SearchSpace, seed: int) -> Iterator[Point]:
    """Yield points that are equally likely everywhere."""
    chance = Random(seed)
    while True:
        yield tuple(chance.random() for _ in space.dimensions)


def method_of(
    name: Name, space: SearchSpace, evaluations: int, seed: int, objectives: int = 1
) -> Method:
    """Return a method; raise StoppedError if a package is missing."""
    if name == "grid":
        return Listed(space.grid(evaluations))
    if name == "random":
        return Listed(random_points(space, seed))
    if name == "nsga":
        return Nsga(space, seed)
    if name == "tpe":
        _require("optuna", "tpe", "--method tpe")
        from swarmdsl.execution.experiments.search.tpe import Tpe

        return Tpe(space, seed, objectives)
    _require("cmaes", "optimize", "--method cma")
    from swarmdsl.execution.experiments.search.cma import Cma

    return Cma(space, seed)


def is_small(space: SearchSpace, evaluations: int) -> bool:
    """Return True if all candidates can be tried."""
    return space.size is not None and space.size <= evaluations


def _require(module: str, extra: str, what: str) -> None:
    if find_spec(module) is None:
        help_ = (
            f"`pip install 'swarmdsl[{extra}]'` installs it, and `--method random` needs nothing"
        )
        raise StoppedError("missing-package", help_, what=what, package=module)
