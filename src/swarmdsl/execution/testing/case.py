"""Tests as plain data: steps and expectations.

Machines are identified by their number in the cast, so that a test can run with any seed.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

from swarmdsl.base.diagnostics.collector import Diagnostic
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Source, Span
from swarmdsl.execution.simulate.inputs.choose_space import Spaces
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.scenario import Scenario
from swarmdsl.execution.testing.measures import ExpectedMeasure
from swarmdsl.ir import Property

ActionKind = Literal["sends", "starts", "cancels"]
"""Kind of action of a machine in a step, in contrast to its state."""


@dataclass(frozen=True)
class Quantity:
    """Number of machines that must satisfy a claim; without bounds, all of them."""

    least: int | None = None
    most: int | None = None

    def holds(self, count: int, of: int) -> bool:
        """Return True if `count` of `of` machines are within the bounds."""
        if self.least is None and self.most is None:
            return count == of > 0
        return count >= (self.least or 0) and (self.most is None or count <= self.most)

    @property
    def waits(self) -> bool:
        """True if at least one machine is needed; otherwise the claim holds initially."""
        return bool(self.least) or self == ALL


ALL = Quantity()
ANY = Quantity(least=1)
NONE = Quantity(most=0)


@dataclass(frozen=True)
class Claim:
    """Claim that a number of the machines `who` have states, values or did an action.

    `states` maps each selected machine to its expected states, `values` to its expected variables,
    of which `written` gives the names in the test;
    `action` and `name` are the expected action, `data` and `to` are the expected data and address
    of a sent event. Of a `property` about each robot, `who` has one machine of each, else any.
    Unnamed fields may have any value. `text` describes the claim.
    """

    place: Span
    text: str
    quantity: Quantity
    who: tuple[int, ...]
    states: Mapping[int, tuple[str, ...]] = field(default_factory=dict)
    values: Mapping[int, Mapping[str, Any]] = field(default_factory=dict)
    written: Mapping[str, str] = field(default_factory=dict)
    action: ActionKind | None = None
    name: str = ""
    data: Any = None
    to: str | None = None
    property: Property | None = None


@dataclass(frozen=True)
class Send:
    """Event from outside, in the name of the robot `sender` if it is not empty."""

    place: Span
    event: str
    data: Any
    to: tuple[int, ...]
    sender: str


@dataclass(frozen=True)
class End:
    """End of a running function."""

    place: Span
    function: str
    outcome: str
    result: Mapping[str, Any] | None
    of: tuple[int, ...]


@dataclass(frozen=True)
class Pass:
    """Passing of time, in nanoseconds."""

    place: Span
    length: int


@dataclass(frozen=True)
class Lose:
    """Loss of robots, by name."""

    place: Span
    robots: tuple[str | None, ...]


@dataclass(frozen=True)
class Arrive:
    """Arrival of an event that is on its way to robots, by name, or its loss.

    With a `sender`, the event is that of this robot.
    """

    place: Span
    event: str
    robots: tuple[str | None, ...]
    sender: str | None
    lost: bool


Action = Send | End | Pass | Lose | Arrive


@dataclass(frozen=True)
class Expect:
    """Expectation: now, at some time `within` a duration, or during all of `lasting`.

    The actions `meanwhile` happen again and again until then.
    """

    place: Span
    claim: Claim
    within: int | None = None
    lasting: int | None = None
    meanwhile: tuple[Action, ...] = ()


Step = Action | Expect


def actions(step: Step) -> tuple[Action, ...]:
    """Return the actions of a step, or those during an expectation."""
    return step.meanwhile if isinstance(step, Expect) else (step,)


@dataclass(frozen=True)
class Case:
    """A test. It passes if at least the share `passing` of its runs does.

    With `skips`, actions that are impossible in a run are left out. In each run, no one of
    `properties` may be violated, and all of `violates` must be; in the
    end, `measures` are as expected.
    """

    name: str
    place: Span
    subject: Subject
    scenario: Scenario
    steps: tuple[Step, ...]
    always: tuple[Claim, ...] = ()
    seeds: tuple[int, ...] = (0,)
    passing: float = 1.0
    properties: tuple[tuple[Property, Span], ...] = ()
    violates: tuple[tuple[Property, Span], ...] = ()
    measures: tuple[ExpectedMeasure, ...] = ()
    skips: bool = False
    spaces: Spaces = field(default_factory=Spaces)

    @property
    def watched(self) -> tuple[Property, ...]:
        """The properties that are named anywhere in the test."""
        expected = (each.claim for each in self.steps if isinstance(each, Expect))
        claimed = (each.property for each in (*expected, *self.always) if each.property)
        named = (each for each, _ in (*self.properties, *self.violates))
        return tuple(dict.fromkeys((*named, *claimed)))


@dataclass(frozen=True)
class InvalidTest:
    """A test that cannot run, with its errors."""

    name: str
    place: Span
    problems: tuple[Diagnostic, ...]


@dataclass(frozen=True)
class TestFile:
    """Tests of a file, in their order."""

    __test__ = False  # for pytest, which would collect the class

    source: Source
    cases: tuple[Case | InvalidTest, ...]

    @property
    def unread(self) -> tuple[InvalidTest, ...]:
        """Tests that cannot run."""
        return tuple(case for case in self.cases if isinstance(case, InvalidTest))
