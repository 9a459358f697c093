"""Verdicts as text: how much was looked at, each property, and the conditions."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.base.records import dataclass
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.verify.findings.finding import Survey
from swarmdsl.execution.verify.proofs.verdict import INTERRUPTED
from swarmdsl.execution.verify.report import diagnostics
from swarmdsl.execution.verify.report.results import Results
from swarmdsl.execution.verify.swarm.sizes import shown


@dataclass(frozen=True)
class Search:
    """Surveys of the sizes that were looked at, and the number of `left` sizes."""

    surveys: tuple[Survey, ...]
    left: int
    has_places: bool
    """True if the model has places, which no search looks at."""
    interrupted: bool


def summary(subject: Subject, results: Results, search: Search) -> Iterator[str]:
    """Yield the lines."""
    yield f"{subject.name}: {shown(subject, results.sizes, results.free)}"
    if search.has_places:
        yield "  places are left out: any robot may reach any other one, functions may end"
        yield "  in any way, and nobody sees anything or runs out of energy"
    if results.free and search.surveys:
        yield f"  of {shown(subject, results.sizes)}:"
    for counts, found in zip(results.sizes, search.surveys, strict=False):
        states = diagnostics.counted_in_thousands(found.states, "state")
        steps = diagnostics.counted_in_thousands(found.transitions, "step")
        rest = f"there are more, as {found.missing}" if found.missing else "all there are"
        size = f"{shown(subject, [counts])}: " if len(results.sizes) > 1 else ""
        yield f"  {size}{states}, {steps}: {rest}"
        for told in diagnostics.open_findings([found], results.faults):
            yield printable(f"  open: {told}")
    if search.left:
        sizes_left = diagnostics.counted_in_thousands(search.left, "larger size")
        why = INTERRUPTED if search.interrupted else "the search came to its limit"
        yield f"  {sizes_left} not looked at: {why}"
    lines = list(diagnostics.rows(results.verdicts, results.faults, results.worst_at))
    if lines:
        yield ""
    widths = [max(len(line[n]) for line in lines) for n in range(2)] if lines else []
    for name, outcome, reason in lines:
        text = f"  {name:<{widths[0]}}  {outcome:<{widths[1]}}  {reason}"
        yield printable(text.rstrip())
    yield ""
    yield "under these conditions:"
    for condition in results.conditions:
        yield printable(f"  - {condition}")
    yield ""
    for path in results.runs.values():
        yield f"written: {printable(path.as_posix())}"
