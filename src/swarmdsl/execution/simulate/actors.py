"""The machines that run: each is of a robot, or of a part of one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from swarmdsl import ir
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.execution.engine import Machine
from swarmdsl.execution.simulate.scenario import Robot, Scenario
from swarmdsl.execution.simulate.subject import MOST_MEMBERS, Subject
from swarmdsl.execution.simulate.table import first_data, first_value, stored
from swarmdsl.ir import Param, StateMachine


@dataclass(eq=False)
class Actor:
    """A machine, whose it is, and the data it begins with.

    `name` is that of the robot, with that of the part after a dot.
    """

    name: str | None
    robot: Robot
    machine: Machine
    data: Any = None
    role: str = ""

    def listens(self, event: str) -> bool:
        """Whether some state of the machine waits for an event of that name."""
        return any(edge.matches(event) for edges in self.machine.edges for edge in edges)


def actors(
    subject: Subject, robots: Iterable[Robot], scenario: Scenario, report: Diagnostics
) -> list[Actor]:
    """All that run, in the order of the robots; a param without a value is reported."""
    size = subject.size(scenario.counts)
    if size > MOST_MEMBERS:
        help_ = "give each role fewer in `[count]` of a scenario, or run one machine: `--machine`"
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
                    help=f"give it one in `[params]` of a scenario: `{param.name} = ...`",
                )
            if not missing:
                data = first_data(machine, subject.system, given)
                name = robot.name if part is None else f"{robot.name}.{part.name}"
                role = robot.role if part is None else f"{robot.role}.{part.name}"
                made.append(Actor(name, robot, subject.table(machine), data, role))
    if not made and not report.has_errors:
        report.report("nothing-to-simulate", help=f"give a member of `{subject.name}` a `behavior`")
    return made


def params(
    subject: Subject, robot: Robot, part: ir.Part | None, machine: StateMachine
) -> dict[str, Param]:
    """The params that can be given values: of the machine, and of whoever runs it."""
    found = {param.name: param for param in machine.params}
    found.update({param.name: param for param in _owner_params(subject, robot, part)})
    return found


def values(
    subject: Subject, robot: Robot, part: ir.Part | None, scenario: Scenario
) -> dict[str, Any]:
    """The values of the params of whoever runs a machine, as the model and the scenario say."""
    found: dict[str, Any] = {}
    for param in _owner_params(subject, robot, part):
        if param.default is not None:
            found[param.name] = stored(param.default, param.type)(found, None)
    for name, value in part.values if part is not None else ():
        found[name] = stored(value, None)(found, None)
    for word in words(robot, part):
        found.update(scenario.params.get(word, {}))
    return found


def words(robot: Robot, part: ir.Part | None) -> Iterator[str]:
    """What a robot or a part of it is meant by; the last counts most. A machine alone is ""."""
    for word in robot.words or ("",):
        yield word if part is None else f"{word}.{part.name}"


def _owner_params(subject: Subject, robot: Robot, part: ir.Part | None) -> tuple[Param, ...]:
    system = subject.system
    if system is None or subject.swarm is None:
        return ()
    if part is not None:
        return next(each for each in system.components if each.name == part.component).params
    return next(each for each in system.members if each.name == robot.kind).params
