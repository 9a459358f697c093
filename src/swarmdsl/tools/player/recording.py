"""Recording of a run: lines of a trace, with what a page needs to show them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from swarmdsl.base.records import dataclass, field, replace
from swarmdsl.execution.monitor import LOST
from swarmdsl.execution.simulate.pictures.state_colours import nth_colour
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND

Step = Mapping[str, Any]
"""Values of a line of a trace; `t` is in milliseconds since the beginning of the recording."""


@dataclass(frozen=True)
class Machine:
    """State machine of members: ids of its states in document order, and its picture as SVG.

    `colours` are those of states without states inside. `places` are the lines of the text of its
    elements by their ids: name of the file and number.
    """

    name: str
    states: tuple[str, ...]
    colours: Mapping[str, str] = field(default_factory=dict)
    picture: str = ""
    places: Mapping[str, tuple[str, int]] = field(default_factory=dict)

    def with_states(self, more: Iterable[str]) -> Machine:
        """Return the machine with states that only a trace has."""
        new = [each for each in dict.fromkeys(more) if each not in self.states]
        colours = {id_: nth_colour(number) for number, id_ in enumerate(new, len(self.colours))}
        return replace(self, states=(*self.states, *new), colours={**self.colours, **colours})

    def head(self) -> dict[str, Any]:
        """Return the machine as plain data, without its name."""
        return {
            "states": self.states,
            "colours": self.colours,
            "picture": self.picture,
            "places": self.places,
        }


@dataclass(frozen=True)
class Member:
    """Machine of a robot or its part; `index` counts the members of a role."""

    name: str
    role: str
    machine: str
    index: int = 0

    def head(self) -> dict[str, Any]:
        """Return the member as plain data."""
        return {"name": self.name, "role": self.role, "machine": self.machine, "index": self.index}


@dataclass(frozen=True)
class Note:
    """Diagnostic that the page tells: its place as `file:line:column`, and the way out."""

    severity: str
    code: str
    message: str
    place: str = ""
    help: str = ""

    def head(self) -> dict[str, Any]:
        """Return the note as plain data."""
        return {
            "severity": self.severity,
            "code": self.code,
            "message": self.message,
            "place": self.place,
            "help": self.help,
        }


@dataclass(frozen=True)
class Recording:
    """Lines of a run with their model; `end` is in nanoseconds.

    `sources` are texts of the model by name, `views` what views need (`view_data`), `tables` the
    tables of the machines for an engine. `live` is the name of a trace whose lines are to come.
    """

    title: str
    lines: Sequence[Step]
    members: Sequence[Member]
    machines: Sequence[Machine]
    end: int = 0
    model: str = ""
    scenario: str = ""
    seed: int | None = None
    sources: Mapping[str, str] = field(default_factory=dict)
    views: Mapping[str, Any] = field(default_factory=dict)
    tables: Mapping[str, Any] = field(default_factory=dict)
    notes: Sequence[Note] = ()
    live: str = ""

    def head(self) -> dict[str, Any]:
        """Return everything but the lines, as plain data."""
        return {
            "title": self.title,
            "model": self.model,
            "scenario": self.scenario,
            "seed": self.seed,
            "end": max(self.end, self.lines[-1]["t"] * MILLISECOND if self.lines else 0),
            "lost": LOST,
            "members": [each.head() for each in self.members],
            "machines": {each.name: each.head() for each in self.machines},
            "sources": self.sources,
            "properties": [],
            "measures": [],
            "coverage": None,
            "map": None,
            "keywords": [],
            **self.views,
            "tables": self.tables,
            "notes": [each.head() for each in self.notes],
            "live": self.live,
        }
