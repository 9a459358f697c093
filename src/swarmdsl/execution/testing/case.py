"""Tests as plain data: what is done to the robots, and what is expected of them.

A machine that runs is known by its number in the cast, so that a test can run with any seed.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

from swarmdsl.base.diagnostics.collector import Diagnostic
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Source, Span
from swarmdsl.execution.simulate.scenario import Scenario
from swarmdsl.execution.simulate.subject import Subject

Deed = Literal["sends", "starts", "cancels"]
"""What a machine does in a moment; what it is in is another thing."""


@dataclass(frozen=True)
class Quantity:
    """How many of those who are named; no bound on either side means all of them."""

    least: int | None = None
    most: int | None = None

    def holds(self, count: int, of: int) -> bool:
        """Whether so many of so many are enough, and not too many."""
        if self.least is None and self.most is None:
            return count == of > 0
        return count >= (self.least or 0) and (self.most is None or count <= self.most)

    @property
    def waits(self) -> bool:
        """Whether somebody is needed: what nobody needs to do is so from the beginning."""
        return bool(self.least) or self == ALL


ALL = Quantity()
ANY = Quantity(least=1)
NONE = Quantity(most=0)


@dataclass(frozen=True)
class Claim:
    """That so many of the machines `who` are in all these states, hold values, or did something.

    `states` has, for each machine that is meant, the states, and `values` what its variables
    hold; `deed` and `name` are what was done, `data` what the event carries that is sent. Of
    data, what is not named may be anything. `text` says it in words.
    """

    place: Span
    text: str
    quantity: Quantity
    who: tuple[int, ...]
    states: Mapping[int, tuple[str, ...]] = field(default_factory=dict)
    values: Mapping[int, Mapping[str, Any]] = field(default_factory=dict)
    deed: Deed | None = None
    name: str = ""
    data: Any = None


@dataclass(frozen=True)
class Send:
    """An event from outside."""

    place: Span
    event: str
    data: Any
    to: tuple[int, ...]


@dataclass(frozen=True)
class End:
    """A function that robots are running ends."""

    place: Span
    function: str
    outcome: str
    result: Mapping[str, Any] | None
    of: tuple[int, ...]


@dataclass(frozen=True)
class Pass:
    """Time passes, in nanoseconds."""

    place: Span
    length: int


@dataclass(frozen=True)
class Lose:
    """Robots are lost; by name."""

    place: Span
    robots: tuple[str | None, ...]


@dataclass(frozen=True)
class Expect:
    """Something is so: now, at some time `within` so long, or all the time `lasting` so long."""

    place: Span
    claim: Claim
    within: int | None = None
    lasting: int | None = None


Step = Send | End | Pass | Lose | Expect


@dataclass(frozen=True)
class Case:
    """One test. It passes where at least the share `passing` of its runs does."""

    name: str
    place: Span
    subject: Subject
    scenario: Scenario
    steps: tuple[Step, ...]
    always: tuple[Claim, ...] = ()
    seeds: tuple[int, ...] = (0,)
    passing: float = 1.0


@dataclass(frozen=True)
class Unread:
    """A test that is not run, for what is wrong with it."""

    name: str
    problems: tuple[Diagnostic, ...]


@dataclass(frozen=True)
class TestFile:
    """The tests of a file, in their order."""

    __test__ = False  # for pytest, which takes the class for a test

    source: Source
    cases: tuple[Case | Unread, ...]

    @property
    def unread(self) -> tuple[Unread, ...]:
        """Those that are not run."""
        return tuple(case for case in self.cases if isinstance(case, Unread))
