"""World in which nodes of ROS 2 decide what robots do, and the flat space what becomes of it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from swarmdsl.codegen.shared import behavior_nodes
from swarmdsl.execution.engine import InstanceLike, Run
from swarmdsl.execution.engine.table import Activity
from swarmdsl.execution.ros2_world.holds import Holds
from swarmdsl.execution.ros2_world.names import name_in, namespace, swarm_namespace
from swarmdsl.execution.ros2_world.ports import Graph, Request, Sender
from swarmdsl.execution.ros2_world.radio import Radio
from swarmdsl.execution.ros2_world.recorded import Recorded
from swarmdsl.execution.ros2_world.scripted import Scripted
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.network.network import Network
from swarmdsl.execution.simulate.scenario.clock import Clock
from swarmdsl.execution.simulate.scenario.random_source import RandomSource
from swarmdsl.execution.simulate.scenario.scenario import Robot, Scenario
from swarmdsl.execution.simulate.scenario.space import Place, Space
from swarmdsl.execution.simulate.world.schedule import schedule
from swarmdsl.execution.space.setting import Setting
from swarmdsl.ir import Delivery, Function, Named

_OUTCOMES = ("succeeded", "aborted", "preempted")
_PLAIN = Delivery()
_TEXT = Named("std_msgs", "String")


class ServedWorld:
    """Surroundings of a flat space, with the nodes of the robots around them."""

    def __init__(
        self,
        subject: Subject,
        scenario: Scenario,
        cast: Sequence[Actor],
        setting: Setting,
        space: Space,
        seed: int,
        graph: Graph,
    ) -> None:
        assert subject.system is not None
        assert subject.swarm is not None
        self.clock = Clock()
        self.robots = list(dict.fromkeys(actor.robot for actor in cast))
        self.failures: Counter[str] = Counter()
        """Arguments of models that had no value, by function and reason."""
        self.outcomes: Counter[tuple[str, str]] = Counter()
        self.holds = Holds()
        self.recorded = Recorded([actor.name or "" for actor in cast])
        self.space = space
        self._subject = subject
        self._system = subject.system
        self._scenario = scenario
        self._setting = setting
        self._cast = cast
        self._chance = RandomSource(seed)
        self._robot_of = {actor.name: actor.robot for actor in cast}
        self._spaces = {each: namespace(subject.swarm.name, each) for each in self.robots}
        self._scripted = Scripted(self.clock, scenario, self._chance)
        self._calls: dict[Run, tuple[Robot, Request]] = {}
        self._served: set[tuple[str, str]] = set()
        self._senders: dict[tuple[Robot, str], Sender] = {}
        self._radio = Radio(
            graph,
            self._system,
            subject.heartbeat,
            swarm_namespace(subject.swarm.name),
            self._spaces,
            self._told,
        )
        self.network = self._radio.network = Network(
            self.clock,
            scenario,
            self._chance,
            self._radio.arrive,
            lambda event, robot: True,
            lambda event, robot: None,
            space,
        )
        # Nodes hear heartbeats, and decide who is there.
        self.members: Any = _Nobody()
        self.activities: Any = None
        for robot in self.robots:
            self._serve(robot, graph)
            self._open(robot, graph)

    def listen(self, graph: Graph) -> None:
        """Hear what the nodes tell of their state machines."""
        for robot in self.robots:
            for node in behavior_nodes(self._subject.member(robot), self._system):
                topic = name_in(self._spaces[robot], f"{node.name}/transitions")
                graph.hear(topic, _TEXT, lambda message: self.hear(message["data"]))

    def begin(self) -> None:
        """Begin, at time 0."""
        self.space.begin(self, self._ended)
        schedule(self._scenario, self, self._chance)

    # ---- called by nodes

    def hear(self, text: str) -> None:
        """Take a line of the trace of a node."""
        line = self.recorded.add(text, self._at)
        if line is None:
            return
        robot = self._robot_of[line["member"]].name or ""
        event = line["event"] or ""
        self.holds.came("line", robot, "do." if event.startswith("do.") else event)
        for function in line["started"]:
            if (robot, function) in self._served:
                self.holds.expect("call", robot, function)
        for function in line["cancelled"]:
            if self._is_action(function) and self._going_on(robot, function):
                self.holds.expect("cancel", robot, function)

    # ---- called by a space

    @property
    def over(self) -> bool:
        """True if no machine is running."""
        return self.recorded.is_over

    @property
    def minds_links(self) -> bool:
        """True if events wait for robots that come in reach."""
        kept = (each.delivery for each in self._system.events if each.swarm)
        return any(each is not None and (each.reliable or each.latest) for each in kept)

    def failed(self, instance: InstanceLike, error: Exception) -> None:
        """Count a failure."""
        self.failures[str(error)] += 1

    def lose(self, robot: Robot, lasts: int | None = None, reason: str = "") -> None:
        """Let a robot lie where it is: nothing that its nodes say has an effect any more."""
        self.network.leave(robot)
        self.space.lose(robot)
        for run, (whose, request) in list(self._calls.items()):
            if whose is robot:
                self._leave(run)
                request.end("aborted", {})
        for name, whose in self._robot_of.items():
            if whose is robot and name is not None:
                self.recorded.lose(name, self.clock.now, reason, self._at)

    def publish(self, robot: Robot, topic: str, data: Any) -> None:
        """Publish what a device of a robot tells, and send it by radio as a swarm event."""
        sender = self._senders.get((robot, topic))
        if sender is not None and sender.listeners:
            sender.send(sender.wire(data))
            for event in self._system.events:
                if event.incoming_topic == topic:
                    self._told(robot, event.name, sender.listeners)
        for said in self._radio.sends(topic):
            self._radio.send(said, robot, data, self.clock.now)

    def awaits(self, robot: Robot, topic: str) -> bool:
        """Return True if somebody listens to a device of a robot."""
        sender = self._senders.get((robot, topic))
        return bool(self._radio.sends(topic)) or (sender is not None and sender.listeners > 0)

    def links_changed(self, pairs: Iterable[tuple[Robot, Robot]]) -> None:
        """Let events that wait go on to those that are in reach now."""
        for one, other in pairs:
            if self.network.reaches(one, other):
                self.network.meet(one, other)

    def flush(self) -> None:
        """Do nothing: nodes write their own traces."""

    # ---- called by the schedule of a scenario

    def listeners(self, event: str, robot: Robot) -> list[Actor]:
        """Return the machines of a robot that react to an event."""
        return [each for each in self._cast if each.robot is robot and each.listens(event)]

    def deliver(self, event: str, data: Any, to: list[Actor], sender: str) -> None:
        """Let robots hear an event from outside."""
        for robot in dict.fromkeys(actor.robot for actor in to):
            topic = self._system.event(event).topic
            local = self._senders.get((robot, topic))
            if robot in self.network.gone:
                continue
            if local is None:
                self._radio.deliver(event, robot, sender, data, self.clock.now)
            else:
                local.send(local.wire(data or {}))
                self._told(robot, event, local.listeners)

    # ---- internal

    def _serve(self, robot: Robot, graph: Graph) -> None:
        """Serve the functions that the machines of a robot call, if it is known how they end."""
        called = {
            state.activity.name
            for actor in self._cast
            if actor.robot is robot
            for state in actor.machine.states
            if state.activity is not None
        }
        for name in sorted(called):
            if self._setting.use(name, robot) is None and not self._scripted.says(name, robot):
                continue
            function = self._system.function(name)
            self._served.add((robot.name or "", name))
            graph.serve(
                name_in(self._spaces[robot], function.communication.name),
                function.communication,
                self._starter(robot, function),
                self._canceller(robot, function),
            )

    def _open(self, robot: Robot, graph: Graph) -> None:
        """Open the topics of a robot's devices, and of events from outside that it hears."""
        types: dict[str, Named] = {}
        unit = next(each for each in self._setting.layout.units if each.robot.name == robot.name)
        devices = [(eye.topic, eye.type) for eye in unit.eyes]
        devices += [(gauge.topic, gauge.type) for gauge in unit.gauges]
        outside = {each.event for each in self._scenario.messages}
        for event in self._system.events:
            if event.name in outside and self._radio.topic_of(event.name) is None:
                devices.append((event.topic, event.type))
        for topic, type_ in devices:
            # What is said to others goes by radio.
            if topic is not None and isinstance(type_, Named) and not self._radio.sends(topic):
                types[topic] = type_
        for topic, named in types.items():
            whole = name_in(self._spaces[robot], topic)
            self._senders[robot, topic] = graph.sender(whole, named, _PLAIN)

    def _starter(self, robot: Robot, function: Function) -> Any:
        events = {each: each for each in _OUTCOMES}
        activity = Activity(function.name, function.communication.name, events)

        def begin(request: Request) -> None:
            self.holds.came("call", robot.name or "", function.name, early=True)
            owner: Any = None  # a node elsewhere
            run = Run(owner, 0, activity)
            run.goal = request.data
            if robot in self.network.gone or not self._start(run, robot):
                request.end("aborted", {})
                return
            self._calls[run] = (robot, request)

        return begin

    def _start(self, run: Run, robot: Robot) -> bool:
        return self.space.start(run, robot) or self._scripted.start(run, robot, self._ended)

    def _canceller(self, robot: Robot, function: Function) -> Any:
        def cancel(request: Request) -> None:
            self.holds.came("cancel", robot.name or "", function.name)
            for run, (_, going_on) in list(self._calls.items()):
                if going_on is request:
                    self._leave(run)
                    self.outcomes[function.name, "cancelled"] += 1
            request.end("preempted", {})

        return cancel

    def _ended(self, run: Run, outcome: str, fields: Mapping[str, Any]) -> None:
        """Answer a call that the space ends."""
        if run not in self._calls:
            return
        robot, request = self._calls[run]
        name = run.activity.name
        self._leave(run)
        self.outcomes[name, outcome] += 1
        given = self._scenario.behavior(name, robot).results if outcome == "succeeded" else ()
        request.end(outcome, {**(given[0] if given else {}), **fields})
        self.holds.expect("line", robot.name or "", "do.")

    def _leave(self, run: Run) -> None:
        del self._calls[run]
        self.space.stop(run)
        self._scripted.stop(run)

    def _told(self, robot: Robot, event: str, listeners: int) -> None:
        """Expect that a node tells what it has made of an event, unless its machine has ended."""
        running = any(
            actor.robot is robot
            and actor.listens(event)
            and not self.recorded.ended(actor.name or "")
            for actor in self._cast
        )
        if listeners > 0 and running and robot not in self.network.gone:
            self.holds.expect("line", robot.name or "", event)

    def _is_action(self, function: str) -> bool:
        return self._system.function(function).communication.paradigm == "action"

    def _going_on(self, robot: str, function: str) -> bool:
        return any(
            whose.name == robot and run.activity.name == function
            for run, (whose, _) in self._calls.items()
        )

    def _at(self, member: str) -> Place | None:
        return self.space.at(self._robot_of[member])


class _Nobody:
    """Members whose presence is not followed here."""

    def follow(self, robots: Iterable[Robot] = ()) -> None:
        """Do nothing: nodes hear the heartbeats of each other."""
