"""Machines of a library go the way of the engine: the same states, in order, to the same end.

After each step the same states are active, and the library has come to each innermost state as
often as the engine has entered it; where no regions run side by side, in the same order.
"""

from __future__ import annotations

import threading
import time
from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import Any

from hypothesis import Phase, given, settings

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.options import parse_options
from swarmdsl.codegen.registry import load
from swarmdsl.driver import pipeline
from swarmdsl.execution.engine import Event, Instance, LoopError, State, Transition
from swarmdsl.ir import Named, StateKind, System

from ..agreement.engines import Ours, Step
from ..agreement.scripts import NEVER, WALKS, Model, Subject, Watch, titled
from ..smach.test_agreement import apart, for_ros
from ..swarm_printer.systems import systems

ROOT = Path(__file__).resolve().parents[2]
MEMBERS = ROOT / "tests" / "golden" / "members" / "model.swarm"
SMALL = (
    ROOT / "tests" / "agreement" / "machines.swarm",
    # Machines are alone here, without members to count.
    *sorted(set((ROOT / "tests" / "golden").glob("*/model.swarm")) - {MEMBERS}),
)
MODELS = [*SMALL, *sorted(path.parent for path in (ROOT / "examples").glob("*/README.md"))]
PATIENCE = 60.0

Build = Callable[..., ModuleType]


class Told(Watch):
    """Tells a chart what the engine does, and notes which innermost states it enters."""

    def __init__(self, chart: Any) -> None:
        super().__init__()
        self.chart = chart
        self.order: list[str] = []

    def received(self, instance: Instance, event: Event) -> None:
        super().received(instance, event)
        self.chart.received(event)

    def exited(self, instance: Instance, state: State) -> None:
        self.chart.exited(state)

    def taken(self, instance: Instance, transition: Transition) -> None:
        super().taken(instance, transition)
        self.chart.taken(transition)

    def entered(self, instance: Instance, state: State) -> None:
        self.chart.entered(state)
        if not state.states:
            self.order.append(state.id)


class Host:
    """Runs the engine; activities are the business of the test."""

    def __init__(self, subject: Subject, chart: Any) -> None:
        self.subject = subject
        self.chart = chart
        chart.host = self
        self.told = Told(chart)
        self.model: Model | None = None
        self.failure: Exception | None = None
        self._turn = threading.Lock()

    def begin_engine(self) -> None:
        with self._turn:
            if self.chart.is_wanted:
                self.model = Model(self.subject, self.told)
            self.chart.begun()
            self.settle()

    def end_engine(self) -> None:
        with self._turn:
            if self.model is not None and self.model.instance.running:
                self.model.instance.stop()
            self.settle()
            self.chart.released()

    def take(self, step: Step) -> None:
        assert self.model is not None
        self.model.take(step)
        self.settle()

    @property
    def seen(self) -> tuple[frozenset[str], list[str]]:
        """Active states of the engine, and the states entered."""
        model = self.model
        return Ours.active.fget(model) if model else frozenset(), [*self.told.order]

    @property
    def final(self) -> str | None:
        """The final state in which the engine has ended."""
        return self.model.instance.final if self.model is not None else None

    def settle(self) -> None:
        self.chart.settle(self.model is not None and self.model.instance.running)


class Twin(ABC):
    """A generated machine that runs in a library, which `target` with `options` is for.

    Stopped, it ends with the outcome `stopped`.
    """

    target: str
    options: Mapping[str, str] = {}
    stopped: str

    def __init__(self, module: ModuleType, subject: Subject) -> None:
        self.host = Host(subject, module.CHART)
        self.order: list[str] = []
        self.outcome: str | None = None
        self.error: BaseException | None = None
        self.chart = module.CHART

        def noted(path: str, memory: Any) -> Any:
            self.order.append(path)
            return type(self.chart).visit(self.chart, path, memory)

        self.chart.visit = noted
        self.machine = module.build()
        self.prepare()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()
        while self.host.model is None:
            assert self._thread.is_alive(), self.error
            time.sleep(0.0005)

    def _run(self) -> None:
        try:
            self.outcome = self.execute()
        except BaseException as error:
            self.error = error

    @abstractmethod
    def prepare(self) -> None:
        """Have the library check the machine."""

    @abstractmethod
    def execute(self) -> str:
        """Run it to its end."""

    @abstractmethod
    def inside(self) -> Iterator[str]:
        """The ids of the states that are active in the library."""

    @abstractmethod
    def stop(self) -> None:
        """Let the machine end."""

    @property
    def active(self) -> frozenset[str]:
        """The states that are active in the library, or in which it has ended."""
        return frozenset([self.outcome] if self.outcome is not None else self.inside())

    def end(self) -> str | None:
        """Stop the machine; its outcome."""
        self.stop()
        self._thread.join(PATIENCE)
        assert self.error is None, self.error
        return self.outcome


def check(
    subject: Subject, scripts: Iterable[tuple[Step, ...]], build: Build, twin: type[Twin]
) -> None:
    """Let the engine and the library do the same, one run of the machine after the other."""
    module = build(subject.system, subject.machine.name, subject.table)
    for steps in scripts:
        check_run(subject, steps, twin(module, subject))


def check_run(subject: Subject, steps: tuple[Step, ...], twin: Twin) -> None:
    """Let both do what a script says."""
    machine = subject.machine
    states = [each for each in machine.walk() if each.kind is not StateKind.HISTORY]
    ends = {each.id for each in machine.states if each.kind is StateKind.FINAL}
    innermost = {each.id for each in states if not each.states} - ends
    has_regions = any(each.kind is StateKind.PARALLEL for each in states)

    def seen(active: frozenset[str], order: list[str]) -> Any:
        known = [each for each in order if each in innermost]
        return active, Counter(known) if has_regions else known

    for number, step in enumerate((None, *steps)):
        if step is not None:
            twin.host.take(step)
        end = time.monotonic() + PATIENCE
        while (expected := seen(*twin.host.seen)) != (found := seen(twin.active, twin.order)):
            where = (machine.name, steps[:number], twin.error)
            assert twin.error is None, where
            assert time.monotonic() < end, (expected, found, where)
            time.sleep(0.0005)
    assert twin.end() == (twin.host.final or twin.stopped)


def is_reported(system: System, twin: type[Twin]) -> bool:
    """Return True if the generator reports something that it cannot emit."""
    report = Diagnostics()
    generator = load(twin.target)
    list(generator.emit(system, parse_options(generator, twin.options, report), report))
    return bool(list(report))


def check_model(path: Path, build: Build, twin: type[Twin], most: int | None = None) -> None:
    """Check the machines of a model with its scripts, or with as many as are wanted at most."""
    system = pipeline.check([path]).system
    assert system is not None
    system = apart(system)
    for machine in system.machines:
        alone = replace(system, machines=(machine,))
        if any(isinstance(param.type, Named) for param in machine.params):
            assert is_reported(alone, twin)  # a parameter of ROS 2 is no message
            continue
        subject = Subject(machine, alone)
        if path in SMALL:
            # Those beyond walks by chance, and two of these: together they take most transitions.
            scripts, _ = subject.scripts(len(NEVER.get((titled(path), machine.name), ())))
            chosen = [each.steps for each in (*scripts[:-WALKS], *scripts[-2:])]
        else:
            chosen = list(subject.walks()[:4])
        check(subject, chosen[:most], build, twin)


def check_models_made_by_chance(build: Build, twin: type[Twin], number: int) -> None:
    """Check so many of them."""
    ran: Counter[str] = Counter()

    @settings(max_examples=number, phases=[Phase.generate])
    @given(systems())
    def compare_all(system: System) -> None:
        system = apart(for_ros(system))
        for machine in system.machines:
            # Launch files of swarms have reports of their own.
            alone = replace(system, machines=(machine,), swarms=(), optimizations=())
            subject = Subject(machine, alone)
            try:
                walks = subject.walks()[:2]
            except LoopError:
                continue
            if is_reported(alone, twin):
                ran["reported"] += 1
                continue
            check(subject, [steps[:20] for steps in walks], build, twin)
            ran["run"] += 1

    compare_all()
    # Many have names of fields that ROS does not take.
    assert ran["run"] > number / 10, ran
