"""A run of a swarm, its trace, and the steps between the states of a search."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

from swarmdsl.base.records import dataclass, field
from swarmdsl.execution.simulate.world.line import Line, as_json
from swarmdsl.execution.verify.swarm.groups import Step


class Loss(NamedTuple):
    """Loss of a robot, with the number of lines before, and its time."""

    at: int
    robot: str
    time: int


@dataclass(frozen=True)
class Run:
    """A run of a swarm: its trace lines, and the messages that are lost on the way.

    `lost` has the event and the receiver of each, with the number of lines before, `gone` the
    robots that are lost. `flaw` says why no swarm can run so, or is empty: then the model itself
    has run so. The last `loop` lines repeat for ever; 0 says that nothing happens after the run,
    None that it can go on in any way. There may be others that are shorter unless it is a
    `shortest` one.
    """

    lines: tuple[Line, ...]
    lost: tuple[tuple[int, str, str], ...] = ()
    gone: tuple[Loss, ...] = ()
    flaw: str = ""
    loop: int | None = None
    shortest: bool = True
    period: int = 0
    """Length of a repetition in nanoseconds."""
    lost_before: int = 0
    """Number of messages that are lost before the first repetition."""
    causes: Mapping[int, int] = field(default_factory=dict)
    """For lines on which events of other robots arrive, those on which they were sent."""


Find = Callable[[int], "list[tuple[int, Step]]"]


def written(run: Run) -> Iterator[str]:
    """Yield the lines of a trace, with their causes; the last one has the loop of the run."""
    for number, line in enumerate(run.lines):
        more = {}
        if number in run.causes:
            more["cause"] = run.causes[number] + 1
        if run.loop is not None and number == len(run.lines) - 1:
            more["loop"] = run.loop
        yield as_json(line, more)


def steps_between(states: Sequence[int], find: Find) -> list[Step]:
    """Return the steps from each state to the next one, those in turn where there are several."""
    found = []
    for state, following in pairwise(states):
        steps = (step for after, step in find(state) if after == following)
        found.append(min(steps, key=lambda step: step.turn))
    return found
