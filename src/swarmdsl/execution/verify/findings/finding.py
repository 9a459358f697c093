"""Something that is wrong with a swarm, without any property."""

from __future__ import annotations

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
