"""What a preview shows of a model, as plain data: the same for a browser and for an editor."""

from __future__ import annotations

from typing import TypedDict

from swarmdsl.compiler import Result
from swarmdsl.dataclass import dataclass
from swarmdsl.diagnostics import Severity
from swarmdsl.diagram import Diagram, diagrams
from swarmdsl.diagram.svg import svg

_TITLES = {"composition": "swarm", "internal": "member", "statechart": "state machine"}


class Message(TypedDict, total=False):
    """News for a page: titles of all diagrams by their ids, one drawn, or why there is nothing new.

    `broken` is the number of mistakes. An id stays the same while its subject has its name.
    """

    titles: dict[str, str]
    id: str
    svg: str
    broken: int


@dataclass(frozen=True)
class Pictures:
    """The diagrams of a model, each drawn when it is asked for: most are not looked at."""

    diagrams: tuple[Diagram, ...]

    def listed(self) -> Message:
        """What there is."""
        return {
            "titles": {each.stem: f"{each.name} ({_TITLES[each.kind]})" for each in self.diagrams}
        }

    def drawn(self, id_: str | None) -> Message:
        """A diagram, or the first if there is none of this id."""
        named = (each for each in self.diagrams if each.stem == id_)
        found = next(named, self.diagrams[0] if self.diagrams else None)
        return {"id": found.stem, "svg": svg(found)} if found is not None else {}


def pictures(result: Result) -> Pictures | Message:
    """The diagrams of a checked model; of one with errors a message that says so."""
    if result.system is None:
        return {"broken": result.report.count(Severity.ERROR)}
    return Pictures(tuple(diagrams(result.system)))
