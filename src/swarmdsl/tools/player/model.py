"""Machines, sources and properties of a model, as a recording has them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from swarmdsl.execution.engine import Machine as Table
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.pictures.state_colours import state_colours
from swarmdsl.ir import StateMachine
from swarmdsl.tools.player.machine_pictures import machine_picture
from swarmdsl.tools.player.recording import Machine, Step
from swarmdsl.tools.player.view_data import view_data


class Model:
    """Texts and machines of the subject of a run, for a page."""

    def __init__(self, subject: Subject) -> None:
        self._subject = subject
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
                machine_picture(machine),
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

    def view_data(self, lines: Iterable[Step]) -> dict[str, Any]:
        """Return what views show beside the lines."""
        return view_data(self._subject, lines)

    def _behaviours(self) -> Iterator[tuple[str, StateMachine]]:
        """Yield the roles, and the parts of their members, with their machines."""
        subject = self._subject
        roles = subject.swarm.roles if subject.swarm is not None else ()
        for robot in subject.create_robots({role.name: 1 for role in roles}):
            for part, machine in subject.behaviours(robot):
                yield robot.role if part is None else f"{robot.role}.{part.name}", machine

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


def _states(table: Table) -> tuple[str, ...]:
    """Return the ids of all states."""
    return tuple(each.id for each in table.states[1:])
