"""Something that is wrong with a swarm, without any property."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Literal

from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.execution.verify.search.run import Run

Fault = Literal["loops", "fails", "stuck", "waits", "unreachable", "untaken", "lost", "answers"]


@dataclass(frozen=True)
class Finding:
    """Something that is wrong with a swarm, its place in the model, and a run that leads there.

    `name` is that of a state, an event or a role, `role` that of the robots, `detail` a reason.
    """

    fault: Fault
    name: str
    role: str
    place: Span | None
    detail: str = ""
    run: Run | None = None

    @property
    def about(self) -> tuple[Fault, str, str, Span | None, str]:
        """All that it says, without the run that shows it."""
        return (self.fault, self.name, self.role, self.place, self.detail)

    @property
    def title(self) -> str:
        """Name of its run."""
        return f"{self.fault}-{self.name}"


@dataclass(frozen=True)
class Survey:
    """States of a swarm that were looked at, and what was found.

    `missing` is the reason why not all states were looked at, or "". Findings are `open` if no run
    to them could be played, each with the flaw of one. Nothing is said of what waits and never
    happens if robots wait for `news` of others that do not come.
    """

    states: int
    transitions: int
    missing: str
    findings: tuple[Finding, ...]
    full: tuple[str, ...] = ()
    open: tuple[tuple[Finding, str], ...] = ()
    news: bool = False


def not_shown(
    open_: Iterable[tuple[Finding, str]], shown: Iterable[Finding]
) -> Iterator[tuple[Finding, str]]:
    """Yield what is open, once, unless it is shown with other values or in another part."""
    told = {each.about for each in shown}
    for finding, flaw in open_:
        if finding.about not in told:
            told.add(finding.about)
            yield finding, flaw
