"""Subject of a simulation: a swarm, or a machine of a model or SCXML document."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from itertools import islice

from swarmdsl import ir
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import COMMAND_LINE, Source, Span
from swarmdsl.base.suggest import suggest
from swarmdsl.driver.config import ModelSource
from swarmdsl.execution.engine import Machine
from swarmdsl.execution.simulate.machines.table import table
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.ir import StateMachine, Swarm, System
from swarmdsl.project.loader import Project

MOST_MEMBERS = 10_000


@dataclass(frozen=True)
class Document:
    """SCXML document with its machine."""

    source: Source
    machine: Machine

    @property
    def name(self) -> str:
        """Name of the machine, or of the file."""
        path = self.source.path
        return path.stem if self.machine.name == "scxml" and path is not None else self.machine.name


@dataclass
class Subject:
    """A swarm or a single machine, of a system or a document."""

    name: str
    system: System | None = None
    swarm: Swarm | None = None
    machine: StateMachine | None = None
    document: Document | None = None
    tables: dict[str, Machine] = field(default_factory=dict)
    models: Mapping[str, ModelSource] = field(default_factory=dict)
    """Function models of the project, by name."""
    project: Project | None = None
    """Syntax trees of the system, for expressions that are read while it runs."""

    @property
    def heartbeat(self) -> ir.Heartbeat | None:
        """Heartbeat of the robots of the swarm."""
        return self.swarm.heartbeat if self.swarm is not None else None

    @property
    def environment(self) -> ir.Environment | None:
        """Environment of the swarm."""
        if self.system is None or self.swarm is None:
            return None
        name = self.swarm.environment
        return next((each for each in self.system.environments if each.name == name), None)

    def size(self, counts: Mapping[str, int]) -> int:
        """Return the number of members: by default, the minimum of each multiplicity.

        By default at least one of each role; counts can be 0.
        """
        return sum(self._number(role, counts) for role in self.swarm.roles) if self.swarm else 1

    def _number(self, role: ir.Role, counts: Mapping[str, int]) -> int:
        return counts.get(role.name, max(role.multiplicity.lower, 1))

    def create_robots(self, counts: Mapping[str, int], alone: Robot | None = None) -> list[Robot]:
        """Create the members, up to MOST_MEMBERS; `alone` is that of a machine without a swarm."""
        if self.swarm is None:
            return [alone or Robot()]
        members = (
            Robot(f"{role.name}[{number}]", role.name, role.member, number, count)
            for role in self.swarm.roles
            for count in (self._number(role, counts),)
            for number in range(count)
        )
        return list(islice(members, MOST_MEMBERS))

    def behaviours(self, robot: Robot) -> Iterator[tuple[ir.Part | None, StateMachine]]:
        """Yield the machines that a robot and its parts run."""
        if self.machine is not None:
            yield None, self.machine
        if self.system is None or self.swarm is None:
            return
        member = self.member(robot)
        machines = self.system.machines_by_name
        if member.behavior is not None:
            yield None, machines[member.behavior]
        components = self.system.components_by_name
        for part in member.parts:
            behavior = components[part.component].behavior
            if behavior is not None:
                yield part, machines[behavior]

    def member(self, robot: Robot) -> ir.Member:
        """Return the type of a robot of the swarm, with its own values as defaults of params."""
        assert self.system is not None
        assert self.swarm is not None
        member = self.system.members_by_name[robot.kind]
        return self._roles[robot.role].configured(member, robot.index)

    @cached_property
    def _roles(self) -> Mapping[str, ir.Role]:
        return {each.name: each for each in self.swarm.roles} if self.swarm else {}

    def table(self, machine: StateMachine) -> Machine:
        """Return the engine table of a machine, shared by all its instances."""
        assert self.system is not None
        if machine.name not in self.tables:
            self.tables[machine.name] = table(machine, self.system)
        return self.tables[machine.name]

    def place(self, origin: object) -> Span | None:
        """Return the span of a state or transition."""
        if isinstance(origin, (ir.State, ir.Transition)):
            return origin.origin
        if isinstance(origin, int) and self.document is not None:
            source = self.document.source
            text = source.line_text(origin)
            start = source.line_starts[origin - 1] + len(text) - len(text.lstrip())
            return Span(source, start, start + len(text.strip()))
        return None


def choose(
    system: System | None,
    documents: list[Document],
    machine: str | None,
    swarm: str | None,
    report: Diagnostics,
    properties: Sequence[str] = (),
) -> Subject | None:
    """Return the named subject, else that of `properties`, the only swarm or the only machine.

    None if there is none or several, which is reported.
    """
    if properties:
        about = _about(properties, machine or swarm, system, report)
        if about is None or system is None:
            return None
        machine, swarm = (about, None) if about in system.machines_by_name else (None, about)
    swarms = {each.name: each for each in system.swarms} if system is not None else {}
    machines: dict[str, StateMachine | Document] = {each.name: each for each in documents}
    machines.update(system.machines_by_name if system is not None else {})
    if machine is not None:
        if machine in machines:
            return _alone(machine, machines[machine], system)
        _unknown("machine", machine, machines, report)
    elif swarm is not None:
        if swarm in swarms:
            return Subject(swarm, system, swarms[swarm])
        _unknown("swarm", swarm, swarms, report)
    elif len(swarms) == 1 and not documents:
        (name,) = swarms
        return Subject(name, system, swarms[name])
    elif len(machines) == 1 and not swarms:
        (name,) = machines
        return _alone(name, machines[name], system)
    elif not machines:
        report.report("nothing-to-simulate", help="declare a `statemachine`")
    else:
        choices = [f"`--swarm {name}`" for name in swarms]
        choices += [f"`--machine {name}`" for name in machines]
        help_ = f"choose one: {', '.join(choices[:-1])} or {choices[-1]}"
        report.report("unclear-subject", help=help_)
    return None


def _alone(name: str, machine: StateMachine | Document, system: System | None) -> Subject:
    if isinstance(machine, Document):
        return Subject(name, document=machine)
    return Subject(name, system, machine=machine)


def _about(
    names: Sequence[str], named: str | None, system: System | None, report: Diagnostics
) -> str | None:
    """Return what properties are about: one subject, and the named one if there is one."""
    known = {each.name: each for each in system.judged} if system is not None else {}
    unknown = [name for name in names if name not in known]
    for name in unknown:
        _unknown("property", name, known, report)
    about = named
    for name in names if not unknown else ():
        found = known[name].subject
        about = about or found
        if found != about:
            place = _on_command_line("property", name)
            kind, help_ = f"property of `{about}`", f"it is about `{found}`"
            report.report("unresolved-name", place, kind=kind, name=name, help=help_)
            return None
    return about if not unknown else None


def _on_command_line(word: str, name: str) -> Span:
    source = Source(COMMAND_LINE, f"--{word} {name}")
    return Span(source, len(source.text) - len(name), len(source.text))


def _unknown(word: str, name: str, known: Mapping[str, object], report: Diagnostics) -> None:
    kind = "state machine" if word == "machine" else word
    help_ = suggest(name, known, "properties" if word == "property" else f"{kind}s")
    place = _on_command_line(word, name)
    report.report("unresolved-name", place, kind=kind, name=name, help=help_)
