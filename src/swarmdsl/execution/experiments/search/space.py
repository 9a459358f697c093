"""Search space of an optimization: params and numbers of members with their ranges.

Methods work on points of the unit cube. A setting with steps has the values of its steps only, and
each of them has the same share of its edge.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import islice, product
from typing import Literal

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.codegen.exchange.search_space import number
from swarmdsl.codegen.shared.constants import constant
from swarmdsl.execution.experiments.task import COUNT, Candidate
from swarmdsl.execution.simulate.scenario.durations import SECOND, written_duration
from swarmdsl.ir import CountRange, Expression, Optimization, ParamRange, Primitive, Role, System
from swarmdsl.syntax.types import DURATION, INTEGERS

Point = tuple[float, ...]
"""A place in the unit cube."""

Kind = Literal["whole", "number", "time"]


@dataclass(frozen=True)
class Dimension:
    """A setting from `lower` to `upper`, in seconds for a time; without a step it is continuous."""

    name: str
    kind: Kind
    lower: Fraction
    upper: Fraction
    step: Fraction | None = None
    today: Fraction | None = None
    """Value in the model as it is, if it is known."""

    @property
    def today_value(self) -> int | float | str | None:
        """Value in the model as it is, as it would stand in a scenario."""
        return self._written(self.today) if self.today is not None else None

    @property
    def size(self) -> int | None:
        """Number of values, None if they are not counted."""
        if self.step is None:
            return None if self.upper > self.lower else 1
        return int((self.upper - self.lower) // self.step) + 1

    def value(self, place: float) -> int | float | str:
        """Return the value at a place from 0 to 1, as it stands in a scenario."""
        place = min(max(place, 0.0), 1.0)
        if self.step is None:
            exact = float(self.lower) + place * float(self.upper - self.lower)
            return self._written(Fraction(exact))
        size = self.size or 1
        return self._written(self.lower + round(place * (size - 1)) * self.step)

    def _written(self, value: Fraction) -> int | float | str:
        if self.kind == "time":
            return written_duration(round(value * SECOND))
        return int(value) if self.kind == "whole" else float(value)


@dataclass(frozen=True)
class SearchSpace:
    """All settings that a search varies."""

    dimensions: tuple[Dimension, ...]

    @property
    def size(self) -> int | None:
        """Number of candidates, None if they are not counted."""
        sizes = [each.size for each in self.dimensions]
        return None if None in sizes else math.prod(size for size in sizes if size is not None)

    def candidate(self, point: Sequence[float]) -> Candidate:
        """Return the candidate at a point."""
        pairs = zip(self.dimensions, point, strict=True)
        return Candidate.of({each.name: each.value(place) for each, place in pairs})

    def changed(self, candidate: Candidate) -> Candidate:
        """Return the settings that differ from the model as it is."""
        today = {each.name: each.today_value for each in self.dimensions}
        return Candidate.of(
            {name: each for name, each in candidate.settings if each != today[name]}
        )

    def grid(self, most: int) -> Iterator[Point]:
        """Yield points on a grid, at most so many: all if they are not more."""
        levels = self._levels(most)
        places = [
            [index / (count - 1) for index in range(count)] if count > 1 else [0.0]
            for count in levels
        ]
        yield from islice(product(*places), most)

    def _levels(self, most: int) -> list[int]:
        """Return the number of levels of each dimension, as equal as can be."""
        levels = [1] * len(self.dimensions)
        while True:
            growing = [
                index
                for index, each in enumerate(self.dimensions)
                if levels[index] < (each.size or most)
                and math.prod(levels) // levels[index] * (levels[index] + 1) <= most
            ]
            if not growing:
                return levels
            levels[min(growing, key=lambda index: levels[index])] += 1


def space_of(optimization: Optimization, system: System) -> SearchSpace:
    """Return the search space of an optimization, whose ranges are known and not empty.

    A range of counts that has nothing in common with the multiplicity ends below its start.
    """
    swarm = next(each for each in system.swarms if each.name == optimization.swarm)
    roles = {each.name: each for each in swarm.roles}
    counts = (_count(each, roles[each.role]) for each in optimization.counts)
    params = (_dimension(each, roles[each.role], system) for each in optimization.params)
    return SearchSpace((*counts, *params))


_ONE = Fraction(1)


def _count(range_: CountRange, role: Role) -> Dimension:
    """Return the numbers that are in the range and in the multiplicity."""
    allowed = role.multiplicity
    lower = max(_exact(range_.lower), Fraction(allowed.lower))
    upper = _exact(range_.upper)
    if allowed.upper is not None:
        upper = min(upper, Fraction(allowed.upper))
    today = Fraction(max(allowed.lower, 1))
    return Dimension(f"{COUNT}{range_.role}", "whole", lower, upper, _ONE, today)


def report_narrowed(
    optimization: Optimization, system: System, space: SearchSpace, report: Diagnostics
) -> None:
    """Report ranges of counts with numbers that the multiplicity of the role does not allow."""
    swarm = next(each for each in system.swarms if each.name == optimization.swarm)
    roles = {each.name: each for each in swarm.roles}
    found = {each.name: each for each in space.dimensions}
    for range_ in optimization.counts:
        dimension, role = found[f"{COUNT}{range_.role}"], roles[range_.role]
        lower, upper = _exact(range_.lower), _exact(range_.upper)
        allowed, whole = f"`{role.member}[{role.multiplicity}]`", f"{lower} .. {upper}"
        help_ = f"`{role.member}[{lower}..{upper}]` allows all of them"
        if dimension.lower > dimension.upper:
            reason = f"{allowed} as `{role.name}`, and none of {whole} in its `optimize`"
            name = optimization.swarm
            report.report("nothing-to-optimize", name=name, reason=reason, help=help_)
        elif (dimension.lower, dimension.upper) != (lower, upper):
            taken = f"{dimension.lower} .. {dimension.upper}"
            report.report(
                "narrowed-range",
                name=dimension.name,
                range=whole,
                taken=taken,
                allowed=allowed,
                help=help_,
            )


def _dimension(range_: ParamRange, role: Role, system: System) -> Dimension:
    member = role.configured(system.members_by_name[role.member])
    param = next(each for each in member.params if each.name == range_.param)
    type_ = param.type
    default = constant(param.default, {}) if param.default is not None else None
    is_known = isinstance(default, (int, float)) and not isinstance(default, bool)
    today = Fraction(str(default)) if is_known else None
    is_whole = isinstance(type_, Primitive) and type_.name in INTEGERS
    kind: Kind = "time" if type_ == DURATION else "whole" if is_whole else "number"
    step = _exact(range_.step) if range_.step is not None else _ONE if is_whole else None
    name = f"{range_.role}.{range_.param}"
    return Dimension(name, kind, _exact(range_.lower), _exact(range_.upper), step, today)


def _exact(expression: Expression) -> Fraction:
    """Return the value as a decimal fraction: 0.1 is a tenth."""
    return Fraction(str(number(expression)))
