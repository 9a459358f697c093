"""Fitness of a swarm and the search space of an optimization."""

from __future__ import annotations

from typing import Literal

from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span
from swarmdsl.ir.docs import Docs
from swarmdsl.ir.expressions import Expression
from swarmdsl.ir.interfaces import Param
from swarmdsl.ir.properties import Measure
from swarmdsl.ir.space import SpaceMeasure
from swarmdsl.syntax.types import Type


@dataclass(frozen=True, slots=True)
class FitnessInput:
    """Value that is measured in a run or in a `space`; without a measure, by other programs."""

    name: str
    type: Type
    measure: Measure | None = None
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)
    space: SpaceMeasure | None = None


@dataclass(frozen=True, slots=True)
class Fitness:
    """Value to maximize or minimize, computed from measurements of a run.

    The expression reads inputs as variables. Measures are about swarm `subject`.
    """

    name: str
    inputs: tuple[FitnessInput, ...]
    params: tuple[Param, ...]
    goal: Literal["maximize", "minimize"]
    value: Expression
    doc: str = ""
    docs: Docs = ()
    origin: Span | None = field(default=None, compare=False, repr=False)
    subject: str | None = None


@dataclass(frozen=True, slots=True)
class ParamRange:
    """Range of a param of the members in a role."""

    role: str
    param: str
    lower: Expression
    upper: Expression
    step: Expression | None
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class CountRange:
    """Range of the number of members in a role."""

    role: str
    lower: Expression
    upper: Expression
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Constraint:
    """Property that no run of a candidate may violate."""

    property: str
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Optimization:
    """Search for the best swarm.

    `settings` are the number of steps of a run, that of candidates (`evaluations`) and the
    random seed, as far as they are given.
    """

    swarm: str
    params: tuple[ParamRange, ...]
    counts: tuple[CountRange, ...]
    settings: tuple[tuple[str, Expression], ...] = ()
    doc: str = ""
    docs: Docs = ()
    origin: Span | None = field(default=None, compare=False, repr=False)
    constraints: tuple[Constraint, ...] = ()
