"""Machines, sources and properties of a model, as a recording has them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from swarmdsl.base.source import Span
from swarmdsl.execution.engine import Machine as Table
from swarmdsl.execution.simulate.measures import fitness_of, inputs_of
from swarmdsl.execution.simulate.properties import watchable
from swarmdsl.execution.simulate.state_colours import state_colours
from swarmdsl.execution.simulate.subject import Subject
from swarmdsl.ir import StateMachine
from swarmdsl.tools.diagram.layout import lay_out
from swarmdsl.tools.diagram.map import maps
from swarmdsl.tools.diagram.svg import draw
from swarmdsl.tools.diagram.views import diagrams
from swarmdsl.tools.player.recording import Machine

_MAX_NODES = 2_000
"""Larger diagrams are slow to lay out and unreadable."""


class Model:
    """What a page shows of the subject of a run."""

    def __init__(self, subject: Subject) -> None:
        self._subject = subject
        self._system = subject.system
        self.sources: dict[str, str] = {}
        """Texts of the model by the name of the file, as far as something in them is shown."""

    @property
    def name(self) -> str:
        """Name of the swarm or the machine."""
        return self._subject.name

    def machines(self) -> Mapping[str, Machine]:
        """Return the machines that members can run, by name."""
        document = self._subject.document
        if document is not None:
            table = document.machine
            return {table.name: Machine(table.name, _states(table), state_colours(table))}
        found = {}
        for machine in dict.fromkeys(each for _, each in self._behaviours()):
            table = self._subject.table(machine)
            places = dict(self._places(table))
            found[machine.name] = Machine(
                machine.name,
                _states(table),
                state_colours(table),
                self._picture(machine.name),
                places,
            )
        return found

    def machine_of(self, role: str) -> str | None:
        """Return the name of the machine of a role, or of a part: `uav.camera`; None if unknown."""
        return next((each.name for name, each in self._behaviours() if name == role), None)

    @property
    def alone(self) -> str | None:
        """Name of the machine that runs without a swarm."""
        if self._subject.document is not None:
            return self._subject.document.machine.name
        return self._subject.machine.name if self._subject.machine is not None else None

    def properties(self) -> dict[str, str]:
        """Return the comment of each property, or the line that it begins on, by its name."""
        return {
            each.name: each.doc or _line(each.origin) or each.name
            for each in watchable(self._subject)
        }

    def measures(self) -> tuple[str, ...]:
        """Return the names of the measures."""
        return tuple(each.name for each in inputs_of(fitness_of(self._subject)))

    def map(self) -> str:
        """Return the map of the environment as SVG, or an empty string."""
        around = self._subject.environment
        drawn = maps(self._system) if self._system is not None and around is not None else ()
        return next((each.svg(lambda _: None) for each in drawn if each.environment is around), "")

    def _behaviours(self) -> Iterator[tuple[str, StateMachine]]:
        """Yield the roles, and the parts of their members, with their machines."""
        subject = self._subject
        roles = subject.swarm.roles if subject.swarm is not None else ()
        for robot in subject.create_robots({role.name: 1 for role in roles}):
            for part, machine in subject.behaviours(robot):
                yield robot.role if part is None else f"{robot.role}.{part.name}", machine

    def _picture(self, name: str) -> str:
        assert self._system is not None
        for each in diagrams(self._system):
            if each.kind == "statechart" and each.name == name:
                if sum(1 for _ in each.frame.walk()) > _MAX_NODES:
                    return ""
                return draw(lay_out(each), lambda _: None)
        return ""

    def _places(self, table: Table) -> Iterator[tuple[str, tuple[str, int]]]:
        """Yield the lines of states and transitions by their ids; keep the texts they are in."""
        for state in table.states[1:]:
            yield from self._place(state.id, state.origin)
            for each in state.transitions:
                yield from self._place(table.called(each), each.origin)

    def _place(self, id_: str, origin: object) -> Iterator[tuple[str, tuple[str, int]]]:
        span = self._subject.place(origin)
        if span is not None:
            span = span.absolute
            self.sources.setdefault(span.source.name, span.source.text)
            yield id_, (span.source.name, span.source.line_column(span.start)[0])


def _line(origin: Span | None) -> str:
    """Return the line of a place."""
    if origin is None:
        return ""
    span = origin.absolute
    return span.source.line_text(span.source.line_column(span.start)[0]).strip()


def _states(table: Table) -> tuple[str, ...]:
    """Return the ids of all states."""
    return tuple(each.id for each in table.states[1:])
