"""The nodes of all examples run on a real ROS 2, and come through all of their states.

Somebody looks at where each machine is, and lets happen what leads on: a goal or a request ends,
an event comes, time passes. What became of it is then held against the model, as after each test.
"""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from swarmdsl.codegen.bundled.ros2.names import type_name

from swarmdsl.base.naming import snake_case
from swarmdsl.codegen.api import chosen_machines
from swarmdsl.codegen.shared.envelopes import envelopes_of
from swarmdsl.driver import pipeline
from swarmdsl.ir import (
    Communication,
    DoneTrigger,
    EventTrigger,
    OutcomeTrigger,
    State,
    StateKind,
    StateMachine,
    System,
    TimeTrigger,
    Transition,
)

EXAMPLES = Path(__file__).parents[2] / "examples"
# What machines wait for at most, in simulated seconds, and how often something is let happen.
LONG = 3600
STEPS = 200
FAR = 30
GONE = 3.0
"""After how many seconds without a server a call is aborted."""
ALIKE = {"crazyflies", "emergency_exit", "flocking", "meadow", "minimal"}
"""Examples whose nodes do nothing that those of others do not do."""
_ONCE = ("event", "wait", "gone")
_PATIENCE = {"wait": 0.5, "gone": 12.0}
"""Seconds to wait for a visible effect, by kind of deed."""
_OF_OTHERS = "bridge/events/"

Deed = tuple[str, str]


class Robot:
    """A node with one machine, and what happens to it."""

    def __init__(self, ros: Any, fakes: Any, system: System, machine: StateMachine) -> None:
        self.ros = ros
        self.fakes = fakes
        self.system = system
        self.machine = machine
        # Each in a swarm of its own, so that it hears nobody else.
        self.swarm = f"/{snake_case(machine.name)}"
        self.space = f"{self.swarm}/robot_0"
        self.states = {state.id: state for state in machine.walk()}
        self.tried: defaultdict[tuple[str, Deed], float] = defaultdict(float)
        self.entered: set[str] = set()
        self._topics: dict[str, str] = {}
        self._to_all: set[str] = set()
        """Events in an envelope, whose address is left empty."""
        self._calls = {self._call(s) for s in self.states.values() if s.activity is not None}
        for call in self._calls:
            self._serve(call)
        for name in self._heard():
            event = system.event(name)
            of_swarm = event.swarm or event.topic.startswith(_OF_OTHERS)
            topic = event.topic.removeprefix(_OF_OTHERS)
            self._topics[name] = f"{self.swarm}/{topic}" if of_swarm else self._name(topic)
            envelope = envelopes_of(system).get(name)
            if envelope is not None:
                self._to_all.add(name)
            type_ = event.type if envelope is None else envelope.type
            fakes.publisher(self._topics[name], f"{type_.package}/msg/{type_.name}")  # type: ignore[union-attr]
        self.begin()

    def _serve(self, call: Communication) -> None:
        serve = self.fakes.action if call.paradigm == "action" else self.fakes.service
        kind = "action" if call.paradigm == "action" else "srv"
        type_ = f"{call.type.package}/{kind}/{type_name(call.type.name)}"
        serve(self._name(call.name), type_, "never")

    def _call(self, state: State) -> Communication:
        assert state.activity is not None
        return self.system.function(state.activity.function).communication

    def _name(self, name: str) -> str:
        return name if name.startswith("/") else f"{self.space}/{name}"

    def _heard(self) -> list[str]:
        triggers = (t for state in self.states.values() for t in _triggers(state))
        # Nobody is heard here, so that nobody is lost.
        heard = (t for t in triggers if isinstance(t, EventTrigger) and not t.predefined)
        return list(dict.fromkeys(t.event for t in heard))

    def begin(self) -> None:
        """Start a node, the first one or one after another has ended."""
        module = f"{self.system.name}_behavior.{snake_case(self.machine.name)}"
        given = [p for p in self.machine.params if (p.default or p.declared) is None]
        params = {param.name: 1.0 for param in given}
        params["timeouts__server"] = GONE
        self.node = self.ros.node(module, self.space, use_sim_time=True, **params)

    def connect(self) -> None:
        """Wait until the node hears of everything."""
        self.node.until(bool, "after its start")
        self.fakes.listeners(*self._topics.values())

    @property
    def missing(self) -> set[str]:
        """The states that the node has not been in."""
        for line in self.node.trace:
            self.entered.update(line["entered"])
        passing = (StateKind.CHOICE, StateKind.HISTORY)
        return {
            state.id
            for state in self.states.values()
            if state.kind not in passing and state.id not in self.entered
        }

    def step(self, number: int) -> None:
        """Let something happen that leads on."""
        missing = self.missing
        line = self.node.trace[-1]
        active = _with_those_around(line["configuration"])
        if any(map(self._ends, active)):
            assert self.node.exit_code() == 0
            self.begin()
            self.connect()
            return
        ways = list(self._ways(active))
        assert ways, f"{self.machine.name} is stuck in {line['configuration']}"
        here = " ".join(line["configuration"])
        _, deed, target = min(
            (
                (self._steps(transition, missing) + self.tried[here, deed], n),
                deed,
                transition.target,
            )
            for n, (deed, transition) in enumerate(ways)
        )
        before = len(self.node.trace)
        end = time.monotonic() + _PATIENCE.get(deed[0], 3.0)
        self._do(*deed, number)
        while len(self.node.trace) == before and time.monotonic() < end:
            time.sleep(0.02)
            if deed[0] not in _ONCE:
                self._do(*deed, number)  # The call may not have come before.
        # What does not lead where it should is left to when other data come.
        led = any(target in line["entered"] for line in self.node.trace[before:])
        self.tried[here, deed] += 0.2 if led else 2
        if deed[0] == "gone":
            self._serve(next(call for call in self._calls if call.name == deed[1]))

    def _do(self, kind: str, what: str, number: int) -> None:
        if kind == "event":
            data = {"to": ""} if what in self._to_all else {}
            self.fakes.do("publish", topic=self._topics[what], data=data, number=number)
        elif kind == "wait":
            Robot.now += LONG
            self.fakes.do("clock", time=Robot.now * 10**9)
        elif kind == "gone":
            self.fakes.do("gone", name=self._name(what))
        else:
            self.fakes.do("finish", name=self._name(what), outcome=kind, number=number)

    def _ends(self, state_id: str) -> bool:
        return self.states[state_id].kind is StateKind.FINAL and "." not in state_id

    def _ways(self, active: list[str]) -> Iterator[tuple[Deed, Transition]]:
        """Yield possible deeds for active states, with the transition triggered."""
        for state_id in active:
            state = self.states[state_id]
            for transition in state.transitions:
                for trigger in transition.triggers:
                    match trigger:
                        case EventTrigger(event=name, predefined=False):
                            yield ("event", name), transition
                        case OutcomeTrigger(outcome=outcome):
                            call = self._call(state)
                            gone = call.paradigm == "service" and outcome == "aborted"
                            yield ("gone" if gone else outcome, call.name), transition
                        case TimeTrigger():
                            yield ("wait", ""), transition

    def _steps(self, transition: Transition, missing: set[str]) -> int:
        """From its target to what is missing, as if all guards held."""
        reached = {transition.target} if transition.target is not None else set()
        if not reached & missing and any(map(self._ends, reached)):
            return 2 * FAR  # Another node would have to be started.
        for steps in range(FAR):
            for each in list(reached):
                reached.update(self._entered_with(self.states[each]))
            if reached & missing:
                return steps
            around = {each for state in reached for each in _with_those_around([state])}
            after = [t for each in around for t in self.states[each].transitions]
            reached.update(t.target for t in after if t.target and self._can_be(t, reached))
        return FAR

    def _can_be(self, transition: Transition, reached: set[str]) -> bool:
        """Return True unless a done trigger needs a final state not yet reached."""
        wanted = [t for t in transition.triggers if isinstance(t, DoneTrigger) and t.final]
        return not wanted or any(t.final in reached for t in wanted)

    def _entered_with(self, state: State) -> set[str]:
        """A state and those in it that are entered with it."""
        inner = [s for s in state.states if s.id == state.initial or s.kind is StateKind.REGION]
        return {state.id}.union(*(self._entered_with(each) for each in inner))

    now = 0


def _triggers(state: State) -> Iterator[Any]:
    for transition in state.transitions:
        yield from transition.triggers


def _with_those_around(configuration: list[str]) -> list[str]:
    found: dict[str, None] = {}
    for state in configuration:
        words = state.split(".")
        found.update((".".join(words[:n]), None) for n in range(len(words), 0, -1))
    return list(found)


@pytest.mark.parametrize(
    "example",
    [
        pytest.param(path.name, marks=[pytest.mark.thorough] if path.name in ALIKE else [])
        for path in sorted(EXAMPLES.iterdir())
        if path.is_dir()
    ],
)
def test_its_nodes_come_through_all_their_states(ros: Any, example: str) -> None:
    system = pipeline.check([EXAMPLES / example]).system
    assert system is not None
    fakes = ros.fakes()
    robots = [Robot(ros, fakes, system, machine) for machine in chosen_machines(system)]
    Robot.now = 0
    # Sooner than a node gives up a server that it has not found yet.
    fakes.do("clock", time=10**8)
    for robot in robots:
        robot.connect()
    for number in range(STEPS):
        for robot in robots:
            if robot.missing:
                robot.step(number)
    for robot in robots:
        assert robot.missing == set(), robot.node.log
