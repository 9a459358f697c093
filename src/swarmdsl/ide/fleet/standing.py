"""Standing of the robots of a fleet: who is there, in which states, and what is wrong."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from swarmdsl.base.records import dataclass, field
from swarmdsl.execution.monitor import LOST
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.execution.simulate.world.trace_line import is_beside_steps

EXPECTED, THERE, ENDED, GONE = "expected", "there", "ended", "lost"
_SECOND = 1_000_000_000
_KEPT = 20
"""Number of events sent by a person that are told."""


@dataclass
class _Machine:
    """Machine of a robot or of a part of it, after its last line."""

    states: list[str] = field(default_factory=list)
    event: str = ""
    time: int = 0
    has_ended: bool = False
    is_lost: bool = False


@dataclass
class _Robot:
    """A robot: its machines by member, the nodes that run them, and what it has told.

    `heard` is the time of its last heartbeat. Without nodes that come and go, as in a trace, it
    is there from its first line on.
    """

    machines: dict[str, _Machine] = field(default_factory=dict)
    nodes: set[str] = field(default_factory=set)
    has_left: bool = False
    heard: float | None = None
    battery: float | None = None
    models: dict[str, str] = field(default_factory=dict)


class Standing:
    """Folds lines of traces, heartbeats and the graph into a row for each robot.

    `clock` returns the time in seconds by which heartbeats are late.
    """

    def __init__(self, subject: Subject | None, clock: Callable[[], float]) -> None:
        self._clock = clock
        heartbeat = subject.heartbeat if subject is not None else None
        self._timeout = heartbeat.timeout / _SECOND if heartbeat is not None else None
        self._robots: dict[str, _Robot] = {}
        self._verdicts: dict[str, str] = {}
        self._sent: list[dict[str, Any]] = []
        swarm = subject.swarm if subject is not None else None
        self._swarm = swarm
        for robot in subject.create_robots({}) if subject is not None and swarm is not None else ():
            if robot.name is not None:
                self._robots[robot.name] = _Robot()

    # ---- what comes

    def read(self, lines: Iterable[Mapping[str, Any]]) -> None:
        """Process lines of a trace, as a page shows them."""
        for line in lines:
            if isinstance(line.get("property"), str):
                self._verdicts[line["property"]] = str(line.get("verdict"))
            elif not is_beside_steps(line):
                self._step(line)

    def begin(self, member: str, node: str) -> None:
        """Note a node that runs the machine of a member."""
        robot = self._robot(member)
        robot.nodes.add(node)
        robot.has_left = False
        robot.heard = self._clock() if robot.heard is not None else None

    def end(self, node: str) -> None:
        """Note that a node is gone."""
        for robot in self._robots.values():
            if node in robot.nodes:
                robot.nodes.remove(node)
                robot.has_left = not robot.nodes
            robot.models.pop(node, None)

    def beat(self, name: str) -> None:
        """Note a heartbeat of a robot."""
        self._robot(name).heard = self._clock()

    def charge(self, name: str, share: float | None) -> None:
        """Note the charge of the battery of a robot, from 0 to 1; None if it is not known."""
        self._robot(name).battery = share

    def tell_model(self, member: str, node: str, model: str) -> None:
        """Note the model that a node has told."""
        self._robot(member).models[node] = model

    def note_sent(self, event: str, heard: int) -> None:
        """Note an event that a person has sent, and how many nodes listened."""
        self._sent = [*self._sent, {"event": event, "heard": heard}][-_KEPT:]

    # ---- what is told

    def lost(self) -> list[str]:
        """Return the robots that are lost."""
        return [name for name, robot in self._robots.items() if self._status(robot) == GONE]

    def head(self) -> dict[str, Any]:
        """Return all as plain data."""
        return {
            "robots": [self._row(name, robot) for name, robot in self._robots.items()],
            "alarms": list(self._alarms()),
            "verdicts": dict(self._verdicts),
            "sent": self._sent,
        }

    def _robot(self, name: str) -> _Robot:
        return self._robots.setdefault(name.partition(".")[0], _Robot())

    def _step(self, line: Mapping[str, Any]) -> None:
        member = str(line["member"])
        machine = self._robot(member).machines.setdefault(member, _Machine())
        machine.is_lost = line["event"] == LOST
        machine.states = list(line["configuration"])
        machine.event = str(line["event"] or "start") + (
            " (ignored)" if line.get("ignored") else ""
        )
        machine.time = line["t"]
        machine.has_ended = bool(line.get("ended"))

    def _status(self, robot: _Robot) -> str:
        machines = robot.machines.values()
        if machines and all(each.has_ended for each in machines):
            return ENDED
        silent = (
            self._timeout is not None
            and robot.heard is not None
            and self._clock() - robot.heard > self._timeout
        )
        if silent or robot.has_left or any(each.is_lost for each in machines):
            return GONE
        return THERE if machines or robot.nodes or robot.heard is not None else EXPECTED

    def _row(self, name: str, robot: _Robot) -> dict[str, Any]:
        return {
            "robot": name,
            "status": self._status(robot),
            "machines": [
                {"member": member, "states": each.states, "event": each.event, "t": each.time}
                for member, each in robot.machines.items()
            ],
            "battery": robot.battery,
            "models": sorted(set(robot.models.values())),
        }

    def _alarms(self) -> Iterator[str]:
        yield from (f"{name} is lost" for name in self.lost())
        yield from self._strangers()
        for name, verdict in self._verdicts.items():
            if verdict == "false":
                yield f"property {name} is violated"
        told = {each for robot in self._robots.values() for each in robot.models.values()}
        if len(told) > 1:
            yield f"robots have different models: {', '.join(sorted(told))}"

    def _strangers(self) -> Iterator[str]:
        """Yield the robots with a higher number than the swarm can have."""
        swarm = self._swarm
        if swarm is None:
            return
        most = {each.name: each.multiplicity.upper for each in swarm.roles}
        for name in self._robots:
            robot = Robot.called(name)
            upper = most.get(robot.role or "")
            if upper is not None and robot.index >= upper:
                last = f" to {robot.role}[{upper - 1}]" if upper > 1 else ""
                yield f"{name} is not in the model: {swarm.name} has {robot.role}[0]{last}"
