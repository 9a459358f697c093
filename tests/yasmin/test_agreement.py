"""Machines of YASMIN go the way of the engine: the same states, in the same order, to the same end.

After each step the same states are active, and YASMIN has come to each innermost state as often as
the engine has entered it; where no regions run side by side, in the same order.
"""

from __future__ import annotations

import threading
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from hypothesis import HealthCheck, Phase, given, settings

from swarmdsl import compiler
from swarmdsl.diagnostics import Diagnostics
from swarmdsl.ir import Named, StateKind, System
from swarmdsl.plugins import load
from swarmdsl.runtime import Event, Instance, LoopError, State, Transition

from ..agreement.engines import Ours, Step
from ..agreement.scripts import WALKS, Model, Subject, Watch
from ..printer.systems import systems
from ..smach.test_agreement import apart, for_ros

ROOT = Path(__file__).resolve().parents[2]
SMALL = (
    ROOT / "tests" / "agreement" / "machines.swarm",
    *sorted((ROOT / "tests" / "golden").glob("*/model.swarm")),
)
MODELS = [*SMALL, *sorted(path.parent for path in (ROOT / "examples").glob("*/README.md"))]
SYSTEMS = 40
PATIENCE = 20.0

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

    def begin_engine(self) -> None:
        self.chart.begun()
        self.model = Model(self.subject, self.told)
        self.settle()

    def end_engine(self) -> None:
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
        """What is active in the engine, and what has been entered."""
        model = self.model
        return Ours.active.fget(model) if model else frozenset(), [*self.told.order]

    @property
    def final(self) -> str | None:
        """The final state in which the engine has ended."""
        return self.model.instance.final if self.model is not None else None

    def settle(self) -> None:
        self.chart.settle(self.model is not None and self.model.instance.running)


class Twin:
    """A generated machine that runs in YASMIN."""

    def __init__(self, module: ModuleType, subject: Subject) -> None:
        self.host = Host(subject, module.CHART)
        self.order: list[str] = []
        self.outcome: str | None = None
        self.error: BaseException | None = None
        self.chart = module.CHART

        def noted(path: str, blackboard: Any) -> Any:
            self.order.append(path)
            return type(self.chart).visit(self.chart, path, blackboard)

        self.chart.visit = noted
        self.machine = module.build()
        self.machine.validate(True)
        self._blackboard = Blackboard()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()
        while self.host.model is None:
            assert self._thread.is_alive(), self.error
            time.sleep(0.0005)

    def _run(self) -> None:
        try:
            self.outcome = self.machine(self._blackboard())
        except BaseException as error:
            self.error = error

    @property
    def active(self) -> frozenset[str]:
        """The states that are active in YASMIN."""
        return frozenset([self.outcome] if self.outcome is not None else _inside(self.machine, ""))

    def end(self) -> str | None:
        """Cancel the machine; its outcome."""
        self.chart.cancel()
        self._thread.join(PATIENCE)
        assert self.error is None, self.error
        return self.outcome


def Blackboard() -> Any:  # noqa: N802 - imported late: of the stand-in, or the real one
    """The class of YASMIN that is imported now."""
    import yasmin  # type: ignore[import-not-found]

    return yasmin.Blackboard


def _inside(container: Any, path: str) -> Iterator[str]:
    states = container.get_states()
    if hasattr(container, "get_current_state"):
        current = container.get_current_state()
        states = {current: states[current]["state"]} if current else {}
    for name, state in states.items():
        found = f"{path}.{name}" if path else name
        yield found
        if hasattr(state, "get_states"):
            yield from _inside(state, found)


def check(subject: Subject, scripts: Iterable[tuple[Step, ...]], build: Build) -> None:
    """Let the engine and YASMIN do the same, one run of the machine after the other."""
    module = build(subject.system, subject.machine.name, subject.table)
    for steps in scripts:
        check_run(subject, steps, module)


def check_run(subject: Subject, steps: tuple[Step, ...], module: ModuleType) -> None:
    """Let both do what a script says."""
    machine = subject.machine
    states = [each for each in machine.walk() if each.kind is not StateKind.HISTORY]
    ends = {each.id for each in machine.states if each.kind is StateKind.FINAL}
    innermost = {each.id for each in states if not each.states} - ends
    has_regions = any(each.kind is StateKind.PARALLEL for each in states)

    def seen(active: frozenset[str], order: list[str]) -> Any:
        known = [each for each in order if each in innermost]
        return active, Counter(known) if has_regions else known

    twin = Twin(module, subject)
    for number, step in enumerate((None, *steps)):
        if step is not None:
            twin.host.take(step)
        end = time.monotonic() + PATIENCE
        while (expected := seen(*twin.host.seen)) != (found := seen(twin.active, twin.order)):
            where = (machine.name, steps[:number], twin.error)
            assert twin.error is None, where
            assert time.monotonic() < end, (expected, found, where)
            time.sleep(0.0005)
    assert twin.end() == (twin.host.final or "canceled")


def is_reported(system: System) -> bool:
    """Whether the generator finds something that it cannot make."""
    report = Diagnostics()
    generator = load("yasmin")
    list(generator.emit(system, generator.options_type(), report))
    return bool(list(report))


@pytest.mark.parametrize(
    "path", [pytest.param(p, id=(p.parent if p.suffix else p).name) for p in MODELS]
)
def test_models(path: Path, build: Build) -> None:
    system = compiler.check([path]).system
    assert system is not None
    system = apart(system)
    for machine in system.machines:
        alone = replace(system, machines=(machine,))
        if any(isinstance(param.type, Named) for param in machine.params):
            assert is_reported(alone)  # a parameter of ROS 2 is no message
            continue
        subject = Subject(machine, alone)
        if path in SMALL:
            # Those beyond walks by chance, and two of these: together they take most transitions.
            scripts, _ = subject.scripts()
            check(subject, [each.steps for each in (*scripts[:-WALKS], *scripts[-2:])], build)
        else:
            check(subject, subject.walks()[:4], build)


@pytest.mark.filterwarnings("ignore:Generating overly large repr")
def test_models_made_by_chance(build: Build) -> None:
    ran: Counter[str] = Counter()

    @settings(
        max_examples=SYSTEMS,
        derandomize=True,
        database=None,
        deadline=None,
        phases=[Phase.generate],
        suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture],
    )
    @given(systems())
    def compare_all(system: System) -> None:
        system = apart(for_ros(system))
        for machine in system.machines:
            alone = replace(system, machines=(machine,))
            subject = Subject(machine, alone)
            try:
                walks = subject.walks()[:2]
            except LoopError:
                continue
            if is_reported(alone):
                ran["reported"] += 1
                continue
            check(subject, [steps[:20] for steps in walks], build)
            ran["run"] += 1

    compare_all()
    assert ran["run"] > ran["reported"] / 2
