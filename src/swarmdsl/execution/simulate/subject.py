"""What is simulated: a swarm of a model, or one machine of it or of an SCXML document."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import islice

from swarmdsl import ir
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import COMMAND_LINE, Source, Span
from swarmdsl.base.suggest import suggest
from swarmdsl.execution.engine import Machine
from swarmdsl.execution.simulate.scenario import Robot
from swarmdsl.execution.simulate.table import table
from swarmdsl.ir import StateMachine, Swarm, System

MOST_MEMBERS = 10_000


@dataclass(frozen=True)
class Document:
    """An SCXML file, read."""

    source: Source
    machine: Machine

    @property
    def name(self) -> str:
        """What it is called: its own name, or that of the file."""
        path = self.source.path
        return path.stem if self.machine.name == "scxml" and path is not None else self.machine.name


@dataclass
class Subject:
    """A swarm, or one machine: of the system, or of a document."""

    name: str
    system: System | None = None
    swarm: Swarm | None = None
    machine: StateMachine | None = None
    document: Document | None = None
    tables: dict[str, Machine] = field(default_factory=dict)

    def size(self, counts: Mapping[str, int]) -> int:
        """How many members there are: as many as there must be, if nothing else is said.

        One at least of each role; counts can say that there is none.
        """
        return sum(self._number(role, counts) for role in self.swarm.roles) if self.swarm else 1

    def _number(self, role: ir.Role, counts: Mapping[str, int]) -> int:
        return counts.get(role.name, max(role.multiplicity.lower, 1))

    def crew(self, counts: Mapping[str, int]) -> list[Robot]:
        """The members, as many as `size` says, up to MOST_MEMBERS."""
        if self.swarm is None:
            return [Robot()]
        members = (
            Robot(f"{role.name}[{number}]", role.name, role.member)
            for role in self.swarm.roles
            for number in range(self._number(role, counts))
        )
        return list(islice(members, MOST_MEMBERS))

    def behaviours(self, robot: Robot) -> Iterator[tuple[ir.Part | None, StateMachine]]:
        """The machines of the model that a robot runs: its own, and those of its parts."""
        if self.machine is not None:
            yield None, self.machine
        if self.system is None or self.swarm is None:
            return
        member = next(each for each in self.system.members if each.name == robot.kind)
        machines = {machine.name: machine for machine in self.system.machines}
        if member.behavior is not None:
            yield None, machines[member.behavior]
        components = {component.name: component for component in self.system.components}
        for part in member.parts:
            behavior = components[part.component].behavior
            if behavior is not None:
                yield part, machines[behavior]

    def table(self, machine: StateMachine) -> Machine:
        """The table of a machine, which all that run it share."""
        assert self.system is not None
        if machine.name not in self.tables:
            self.tables[machine.name] = table(machine, self.system)
        return self.tables[machine.name]

    def place(self, origin: object) -> Span | None:
        """Where a state or transition of a table stands in a file."""
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
) -> Subject | None:
    """What the command line names, else the only swarm there is, else the only machine.

    None where there is no such thing, or more than one, which has been reported.
    """
    swarms = {each.name: each for each in system.swarms} if system is not None else {}
    machines: dict[str, StateMachine | Document] = {each.name: each for each in documents}
    machines.update({each.name: each for each in system.machines} if system is not None else {})
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
        help_ = f"say which: {', '.join(choices[:-1])} or {choices[-1]}"
        report.report("unclear-subject", help=help_)
    return None


def _alone(name: str, machine: StateMachine | Document, system: System | None) -> Subject:
    if isinstance(machine, Document):
        return Subject(name, document=machine)
    return Subject(name, system, machine=machine)


def _unknown(word: str, name: str, known: Mapping[str, object], report: Diagnostics) -> None:
    source = Source(COMMAND_LINE, f"--{word} {name}")
    place = Span(source, len(source.text) - len(name), len(source.text))
    kind = "state machine" if word == "machine" else word
    help_ = suggest(name, known, f"{kind}s")
    report.report("unresolved-name", place, kind=kind, name=name, help=help_)
