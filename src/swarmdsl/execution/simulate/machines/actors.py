"""Machines of a simulation, one per robot and per part with behavior."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from swarmdsl import ir
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass, field
from swarmdsl.execution.engine import Machine
from swarmdsl.execution.simulate.machines.machine_data import first_data, first_value, stored
from swarmdsl.execution.simulate.machines.subject import MOST_MEMBERS, Subject
from swarmdsl.execution.simulate.scenario.scenario import Robot, Scenario
from swarmdsl.ir import Param, StateMachine


@dataclass(eq=False)
class Actor:
    """Machine of a robot or of one of its parts, with its initial data.

    `name` is the name of the robot, followed by a dot and the name of the part. `params` are the
    values of the owner, those that the machine does not have too.
    """

    name: str | None
    robot: Robot
    machine: Machine
    data: Any = None
    role: str = ""
    params: dict[str, Any] = field(default_factory=dict)

    @property
    def states(self) -> list[str]:
        """Ids of all states of the machine."""
        return [state.id for state in self.machine.states[1:]]

    @property
    def functions(self) -> list[tuple[str, str]]:
        """Ids of states with the functions that they call."""
        return [(s.id, s.activity.name) for s in self.machine.states if s.activity is not None]

    def listens(self, event: str) -> bool:
        """Return True if a state of the machine reacts to the event."""
        return any(edge.matches(event) for edges in self.machine.edges for edge in edges)


def actors(
    subject: Subject, robots: Iterable[Robot], scenario: Scenario, report: Diagnostics
) -> list[Actor]:
    """Create the actors in the order of the robots; report params without a value."""
    size = subject.size(scenario.counts)
    if size > MOST_MEMBERS:
        help_ = "ask for fewer members, or for one state machine: `--machine`"
        report.report("too-many-members", count=size, help=help_)
        return []
    if subject.document is not None:
        return [Actor(None, robot, subject.document.machine) for robot in robots]
    assert subject.system is not None
    made = []
    for robot in robots:
        for part, machine in subject.behaviours(robot):
            given = values(subject, robot, part, scenario)
            missing = [p for p in machine.params if first_value(p) is None and p.name not in given]
            for param in missing:
                report.report(
                    "no-param-value",
                    param.origin,
                    name=param.name,
                    machine=machine.name,
                    help=f"set it in `{_table(robot, part)}` of a scenario: `{param.name} = ...`",
                )
            if not missing:
                data = first_data(machine, subject.system, given, robot)
                name = robot.name if part is None else f"{robot.name}.{part.name}"
                role = robot.role if part is None else f"{robot.role}.{part.name}"
                made.append(Actor(name, robot, subject.table(machine), data, role, given))
    if not made and not report.has_errors:
        report.report("nothing-to-simulate", help=f"give a member of `{subject.name}` a `behavior`")
    return made


def _table(robot: Robot, part: ir.Part | None) -> str:
    """Return the table of a scenario with the params of a role, or of a machine alone."""
    if not robot.kind:
        return "[params]"
    return f"[params.{robot.role}]" if part is None else f'[params."{robot.role}.{part.name}"]'


def params(
    subject: Subject, robot: Robot, part: ir.Part | None, machine: StateMachine
) -> dict[str, Param]:
    """Return the params that can be set: of the machine and of its owner."""
    found = {param.name: param for param in machine.params}
    found.update({param.name: param for param in _owner_params(subject, robot, part)})
    return found


def values(
    subject: Subject, robot: Robot, part: ir.Part | None, scenario: Scenario
) -> dict[str, Any]:
    """Return the param values of a machine's owner, from the model and the scenario.

    Values of a part may refer to params of the robot.
    """
    found: dict[str, Any] = {}
    for param in _owner_params(subject, robot, part):
        if param.default is not None:
            found[param.name] = stored(param.default, param.type, subject.system)(found, None)
    if part is not None and part.values:
        around = values(subject, robot, None, scenario)
        for name, value in part.values:
            found[name] = stored(value, None, subject.system)(around, None)
    for word in words(robot, part):
        found.update(scenario.params.get(word, {}))
    return found


def words(robot: Robot, part: ir.Part | None) -> Iterator[str]:
    """Yield the words that select a robot or its part, the most specific last.

    The word of a machine without a swarm is "".
    """
    for word in robot.words or ("",):
        yield word if part is None else f"{word}.{part.name}"


def _owner_params(subject: Subject, robot: Robot, part: ir.Part | None) -> tuple[Param, ...]:
    system = subject.system
    if system is None or subject.swarm is None:
        return ()
    if part is not None:
        return system.components_by_name[part.component].params
    return subject.member(robot).params
