"""Generated machines do what the engine does with the same model, step by step.

After each step the same states are active, also in SMACH; the same activities were begun with
the same goals, the same ones were cancelled, and the same events were sent. What begins and ends in
different regions in one step has no order.
"""

from __future__ import annotations

import keyword
import os
import sys
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import fields, is_dataclass, replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import Phase, given, settings

from swarmdsl import ir
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.naming import snake_case
from swarmdsl.cli import run
from swarmdsl.codegen.registry import load
from swarmdsl.codegen.shared import envelopes_of
from swarmdsl.driver import pipeline
from swarmdsl.execution.engine import Event, Instance, LoopError, Run
from swarmdsl.ir import Array, Literal, Named, System
from swarmdsl.syntax.types import DURATION

from ..agreement.engines import Step
from ..agreement.scripts import NEVER, WALKS, Model, Subject, Watch, params, titled
from ..swarm_printer.systems import systems
from .ros1 import for_ros_1

ROOT = Path(__file__).resolve().parents[2]
MEMBERS = ROOT / "tests" / "golden" / "members" / "model.swarm"
MODELS = [
    ROOT / "tests" / "agreement" / "machines.swarm",
    *sorted(path.parent for path in (ROOT / "examples").glob("*/README.md")),
    # Machines are alone here, without members to count.
    *sorted(set((ROOT / "tests" / "golden").glob("*/model.swarm")) - {MEMBERS}),
]
# How many transitions no script takes, for they are those of preempted services.
NO_SERVICE = {("agreement", "Regions"): 2, ("agreement", "Activities"): 1}
CORPUS = Path(os.environ.get("SWARMDSL_CORPUS", ROOT.parent / "shared" / "corpus"))
DOCUMENTS = sorted((CORPUS / "scxml").glob("head_*.xml"))
SYSTEMS = 25
BEGIN = 10.0
"""The time at which generated machines begin, in seconds."""
LATE = 1e-6
"""Lag of steps behind the engine in seconds, against rounding; below any delay."""

Build = Callable[..., Any]


class Asked(Watch):
    """Notes what the engine asks for."""

    def __init__(self, system: System) -> None:
        super().__init__()
        self.system = system
        self.calls: Counter[str] = Counter()
        self.messages: list[Any] = []
        self._begun: dict[Run, str] = {}

    def begin(self) -> None:
        """Begin a step."""
        self._begun.clear()

    def started(self, instance: Instance, run: Run) -> None:
        call = f"call {run.activity.server} {flat(plain(run.goal))}"
        self.calls[call] += 1
        self._begun[run] = call

    def cancelled(self, instance: Instance, run: Run) -> None:
        if run in self._begun:
            # A deferred event leaves the state at once: SMACH does not call its server.
            self.calls[self._begun[run]] -= 1
            return
        # What becomes of the call of a service that is left, nobody sees.
        if self.system.function(run.activity.name).communication.paradigm == "action":
            self.calls[f"cancel {run.activity.server}"] += 1

    def sent(self, instance: Instance, event: Event) -> None:
        if event.envelope.to != "":  # nobody's
            message = without_header(plain(event.data))
            self.messages.append((event.name, message, event.envelope.to))


class Twin:
    """The generated machine, in a ROS of one process."""

    def __init__(self, robot: Any, system: System, machine: ir.StateMachine) -> None:
        self.robot = robot
        self.world = robot.world
        self.system = system
        self.envelopes = envelopes_of(system)
        self.servers = {
            state.id: system.function(state.activity.function).communication
            for state in machine.walk()
            if state.activity is not None
        }

    @property
    def active(self) -> frozenset[str]:
        """The states that are active in SMACH."""
        if self.robot.outcome is not None:
            return frozenset([self.robot.outcome])
        found = set()
        for path in self.robot.active():
            labels = path.split("/")
            found |= {".".join(labels[: depth + 1]) for depth in range(len(labels))}
        return frozenset(found)

    @property
    def calls(self) -> Counter[str]:
        """Calls to servers and cancellations, counted."""
        begun = (f"call {call.name} {self.plain_goal(call)}" for call in [*self.world.calls])
        cancelled = (f"cancel {name}" for what, name in [*self.world.log] if what == "cancel")
        return Counter([*begun, *cancelled])

    def plain_goal(self, call: Any) -> Any:
        """The fields of a goal or request that the model fills, as the engine has them."""
        filled = self.filled[call.name]
        return {name: each for name, each in flat(plain(call.content)).items() if name in filled}

    @property
    def messages(self) -> list[Any]:
        """The events that were sent."""
        topics = {event.topic: event.name for event in self.system.events}
        found = []
        for topic, message in self.world.sent:
            name, to = topics[topic], None
            if name in self.envelopes:
                message, to = message.message, message.to or None
            found.append((name, without_header(plain(message)), to))
        return found

    @property
    def filled(self) -> dict[str, set[str]]:
        """The fields of goals that the model fills, by server."""
        return {
            self.system.function(state.activity.function).communication.name: {
                name for name, _ in state.activity.arguments
            }
            for machine in self.system.machines
            for state in machine.walk()
            if state.activity is not None
        }

    def take(self, step: Step) -> None:
        """Let something happen; time has gone on already."""
        if step.run is not None:
            state, outcome = step.run
            call = self.servers[state]
            result = self.world.wait_for(call.name).content.result_class()
            types = fields_of(self.system, call)
            for name, value in (step.data or {}).items():
                setattr(result, python_name(name), self.made(types.get(name), value))
            given = map(python_name, types or step.data or {})
            self.world.finish(call.name, outcome, **{n: getattr(result, n) for n in given})
        elif step.time:
            chart = self.robot.machine.chart
            with chart.changed:
                chart.changed.notify_all()
            self.world.wait_until(lambda: not is_due(chart), "the time is over")
        else:
            event = self.system.event(step.event)
            for _, callback in self.world._subscribers[event.incoming_topic]:
                message = self.made(event.type, step.data)
                if event.name in self.envelopes:
                    envelope = self.world.default(self.envelopes[event.name].type)
                    envelope.sender, envelope.message = step.sender, message
                    envelope.sent = sys.modules["fake_ros"].Time(step.sent / 1e9)
                    message = envelope
                callback(message)

    def made(self, type_: Any, value: Any) -> Any:
        """A value of the engine as it is in ROS."""
        if type_ == DURATION:
            return type(self.world.default(DURATION))(value / 1e9)
        if isinstance(type_, Array):
            return [self.made(type_.element, each) for each in value]
        if isinstance(type_, Named):
            message = self.world.default(type_)
            types = {field.name: field.type for field in inner(self.system, type_)}
            for name, each in value.items():
                # Values are drawn for the fields of all events together.
                if name in types or hasattr(message, "__dict__"):
                    setattr(message, python_name(name), self.made(types.get(name), each))
            return message
        if isinstance(value, dict):
            return SimpleNamespace(**{name: self.made(None, each) for name, each in value.items()})
        return value


def is_due(chart: Any) -> bool:
    """Return True if a delay is over that the machine has not yet handled."""
    with chart.changed:
        now = sys.modules["fake_ros"].Time.now()
        return any(now >= due for due, *_ in chart._timers)


def inner(system: System, type_: Named) -> tuple[ir.Field, ...]:
    """The fields of a message, as far as they are known."""
    known = system.interface(type_)
    return known.fields if isinstance(known, ir.Message) else ()


def fields_of(system: System, call: ir.Communication) -> dict[str, ir.Type]:
    """The fields of what a call gives."""
    known = system.interface(call.type)
    fields: tuple[ir.Field, ...] = ()
    if isinstance(known, ir.Action):
        fields = known.result
    elif isinstance(known, ir.Service):
        fields = known.response
    return {field.name: field.type for field in fields}


def python_name(field: str) -> str:
    """Return the name of a field in Python."""
    return f"{field}_" if keyword.iskeyword(field) else field


def model_name(field: str) -> str:
    """Return the name in the model of a field of a Python message."""
    return field[:-1] if keyword.iskeyword(field[:-1]) else field


def plain(value: Any) -> Any:
    """A value of ROS as the engine has it."""
    if hasattr(value, "to_nsec"):
        return value.to_nsec()
    if isinstance(value, (list, tuple, bytes)):
        return [plain(each) for each in value]
    if hasattr(value, "__slots__"):
        fields = getattr(value, "__dict__", {}).keys() or value.__slots__
        return {model_name(n): plain(getattr(value, n)) for n in fields if n != "__dict__"}
    if isinstance(value, SimpleNamespace):
        return plain(vars(value))
    if isinstance(value, dict):
        return {name: plain(each) for name, each in value.items()}
    return int(value) if isinstance(value, float) and value.is_integer() else value


def flat(fields: dict[str, Any]) -> dict[str, Any]:
    """The fields that are no messages: what is in those of other packages is not known here."""
    return {name: each for name, each in fields.items() if not isinstance(each, dict)}


def without_header(message: Any) -> Any:
    """Return the fields of a message without its header, which sending fills in."""
    known = flat(message)
    return {name: value for name, value in known.items() if name not in ("header", "swarmio")}


def apart(system: System) -> System:
    """The same with a server of its own for each state, so that it is known whose call is meant.

    Without what is not needed to run all machines.
    """
    functions = [*system.functions]

    def state(each: ir.State) -> ir.State:
        activity = each.activity
        if activity is not None:
            function = system.function(activity.function)
            name = f"{function.name}_{len(functions)}"
            call = replace(function.communication, name=f"server_{len(functions)}")
            functions.append(replace(function, name=name, communication=call))
            activity = replace(activity, function=name)
        return replace(each, activity=activity, states=tuple(map(state, each.states)))

    machines = [replace(m, states=tuple(map(state, m.states))) for m in system.machines]
    return replace(
        system,
        machines=tuple(machines),
        functions=tuple(functions),
        name="model",
        members=(),
        components=(),
        swarms=(),
        optimizations=(),
    )


def subject_of(machine: ir.StateMachine, system: System) -> Subject:
    """A machine and what can happen to it; services are not preempted in ROS 1."""
    subject = Subject(machine, system)
    for state in machine.walk():
        if state.activity is not None:
            call = system.function(state.activity.function).communication
            if call.paradigm == "service":
                ends = subject.ends[state.id]
                subject.ends[state.id] = [e for e in ends if e.run != (state.id, "preempted")]
    return subject


def for_ros(node: Any) -> Any:
    """The same with names of types that ROS can have, and longer delays.

    What is left in the moment in which it is entered may not begin in SMACH.
    """
    if isinstance(node, ir.TimeTrigger):
        known = node.delay.value if isinstance(node.delay, Literal) else 1
        return replace(node, delay=Literal(max(int(known), 1) * 10**6, DURATION))
    if isinstance(node, Named):
        return Named(node.package.replace(".", "_"), "T" + node.name.replace("_", ""))
    if isinstance(node, tuple):
        return tuple(map(for_ros, node))
    if is_dataclass(node):
        known = {field.name: getattr(node, field.name) for field in fields(node)}
        found = {name: for_ros(value) for name, value in known.items() if name != "origin"}
        return replace(node, **found)
    return node


def check(subject: Subject, steps: tuple[Step, ...], build: Build, clock: Any) -> None:
    """Let the engine and the generated machine do the same."""
    system, machine = subject.system, subject.machine
    asked = Asked(system)
    model = Model(subject, asked)
    params = {f"~{name}": value for name, value in subject.params.items()}
    params["namespace"] = "/"  # alone, a robot of the engine has no name
    for param in machine.params:
        if param.type == DURATION and param.name in subject.params:
            params[f"~{param.name}"] = subject.params[param.name] / 1e9
    clock.now = BEGIN
    twin = Twin(build(system, snake_case(machine.name), **params), system, machine)
    twin.robot.start()
    for number, step in enumerate((None, *steps)):
        asked.begin()
        if step is not None:
            model.take(step)
            clock.now = BEGIN + model.world.clock.now / 1e9 + number * LATE
            twin.take(step)
        expected = (frozenset(super(Model, model).active), +asked.calls, asked.messages)
        compare(twin, expected, (machine.name, steps[:number]))
    assert twin.robot.preempt() in ("preempted", *super(Model, model).active)


def compare(twin: Twin, expected: tuple[Any, ...], where: Any) -> None:
    """Wait for the machine to come to rest where the engine has."""

    def found() -> tuple[Any, ...]:
        return (twin.active, twin.calls, twin.messages)

    def said() -> str:
        active = twin.robot.machine.chart._instance.configuration.ids
        return (
            f"{expected}\n{found()}\n{active}\n{twin.world.log[-3:]}\n{twin.robot.error!r}\n{where}"
        )

    end = time.monotonic() + 60
    while rounded(found()) != rounded(expected):
        assert time.monotonic() < end, said()
        time.sleep(0.001)


def rounded(value: Any) -> Any:
    """A value whose numbers may have been seconds: they lose the last digits then."""
    match value:
        case float():
            return float(f"{value:.12g}")
        case list() | tuple():
            return [rounded(each) for each in value]
        case dict():
            return {key: rounded(each) for key, each in value.items()}
    return value


def is_reported(system: System) -> bool:
    """Return True if the generator reports something that it cannot emit."""
    report = Diagnostics()
    generator = load("smach")
    list(generator.emit(system, generator.options_type(), report))
    return bool(list(report))


@pytest.fixture
def clock(build: Build, monkeypatch: pytest.MonkeyPatch) -> Any:
    """The time in generated machines."""
    hand = SimpleNamespace(now=BEGIN)
    monkeypatch.setattr(sys.modules["fake_ros"].Time, "clock", staticmethod(lambda: hand.now))
    return hand


@pytest.mark.parametrize("path", params(MODELS))
def test_models(path: Path, build: Build, clock: Any) -> None:
    system = pipeline.check([path]).system
    assert system is not None
    system = for_ros_1(apart(system))
    for machine in system.machines:
        subject = subject_of(machine, system)
        name = (titled(path), machine.name)
        scripts, _ = subject.scripts(NO_SERVICE.get(name, len(NEVER.get(name, ()))))
        # Those beyond walks by chance, and two of these: together they take most transitions.
        for script in [*scripts[:-WALKS], *scripts[-2:]]:
            check(subject, script.steps, build, clock)


@pytest.mark.skipif(not DOCUMENTS, reason=f"no real files in {CORPUS} (set SWARMDSL_CORPUS)")
def test_models_of_others(build: Build, clock: Any, tmp_path: Path) -> None:
    adf = CORPUS / "adf" / "head_scxml.json"
    for document in DOCUMENTS:
        path = tmp_path / f"{document.stem}.swarm"
        assert run(["import", "scxml", str(document), "--adf", str(adf), "-o", str(path)]) == 0
        system = pipeline.check([path]).system
        assert system is not None
        system = apart(system)
        for machine in system.machines:
            subject = subject_of(machine, system)
            for steps in subject.walks()[:2]:
                check(subject, steps[:20], build, clock)


@pytest.mark.filterwarnings("ignore:Generating overly large repr")
def test_models_made_by_chance(build: Build, clock: Any) -> None:
    ran: Counter[str] = Counter()

    @settings(
        max_examples=SYSTEMS,
        phases=[Phase.generate],
    )
    @given(systems())
    def compare_all(system: System) -> None:
        system = apart(for_ros(system))
        for machine in system.machines:
            alone = replace(system, machines=(machine,))
            subject = subject_of(machine, alone)
            try:
                walks = subject.walks()[:2]
            except LoopError:
                continue
            if is_reported(alone):
                ran["reported"] += 1
                continue
            for steps in walks:
                check(subject, steps[:20], build, clock)
                ran["run"] += 1

    compare_all()
    assert ran["run"] > ran["reported"] / 2
