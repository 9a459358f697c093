"""Result of one run of a test, and its failures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from swarmdsl.base.diagnostics.collector import Label, listed
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.execution.engine import LoopError
from swarmdsl.execution.simulate.scenario.durations import format_duration
from swarmdsl.execution.simulate.world.line import Line


@dataclass(frozen=True)
class Failure:
    """Failure of a run: the parts of its diagnostic, and the last trace lines."""

    code: str
    place: Span
    fields: dict[str, str]
    label: str
    related: tuple[Label, ...]
    last: tuple[Line, ...]


@dataclass(frozen=True)
class RunResult:
    """Result of a run; `faults` are failed guards and effects, by machine.

    `remarks` by property say why it says nothing of the run; `skipped` is the number of
    impossible actions that were left out.
    """

    failure: Failure | None
    faults: tuple[tuple[str, str], ...]
    remarks: Mapping[str, str]
    skipped: int = 0


def endless_reaction(
    error: LoopError, place: Span, subject: str, time: int, last: Sequence[Line]
) -> Failure:
    """Return the failure of a run that does not come to rest at a step, after the last lines."""
    states = set(error.states)
    going = [line.actor for line in last if states <= line.actor.machine.numbers.keys()]
    related = []
    for state in error.states if going else ():
        machine = going[-1].machine
        origin = getattr(machine.states[machine.numbers[state]].origin, "origin", None)
        if isinstance(origin, Span):
            related.append(Label(origin, "part of the loop"))
    who = (going[-1].name if going else None) or subject
    fields = {"who": f"`{who}`", "time": format_duration(time)}
    label = f"it loops through {listed(error.states, 'and')}"
    return Failure("never-settles", place, fields, label, tuple(related), tuple(last))
