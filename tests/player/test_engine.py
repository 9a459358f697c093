"""The engine of the page does what the engine in Python does, step by step."""

from __future__ import annotations

import random
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from hypothesis import Phase, given, settings

from swarmdsl.driver import pipeline
from swarmdsl.execution.engine import (
    Event,
    ExecutionError,
    Kind,
    LoopError,
    Machine,
    State,
    Transition,
)
from swarmdsl.ir import System

from ..agreement.engines import Step
from ..agreement.scripts import Subject
from ..agreement.test_models import FILES
from ..engine.test_random import EVENTS, Maker
from ..swarm_printer.systems import systems
from .engine_in_page import Case, agreed, needs_node, of_model, of_table


@cache
def system_of(path: Path) -> System:
    system = pipeline.check([path]).system
    assert system is not None
    return system


def cases_of(system: System, every: bool) -> Iterator[Case]:
    """Machines of a system, with random walks; with `every`, scripts that take each transition."""
    for machine in system.machines:
        try:
            subject = Subject(machine, system)
            walks = [script.steps for script in subject.scripts()[0]] if every else subject.walks()
        except LoopError:
            walks = [()]
        yield of_model(machine.name, machine, system, subject.params, walks)


@needs_node
def test_machines_of_models(pytestconfig: pytest.Config, tmp_path: Path) -> None:
    every = bool(pytestconfig.getoption("--agreement"))
    cases = [case for path in FILES for case in cases_of(system_of(path), every)]
    assert agreed(cases, tmp_path)


@needs_node
@pytest.mark.filterwarnings("ignore:Generating overly large repr")
def test_machines_of_random_models(pytestconfig: pytest.Config, tmp_path: Path) -> None:
    cases: list[Case] = []

    @settings(
        max_examples=300 if pytestconfig.getoption("--agreement") else 12, phases=[Phase.generate]
    )
    @given(systems())
    def make(system: System) -> None:
        cases.extend(cases_of(system, every=False))

    make()
    assert agreed(cases, tmp_path)


class _Raise:
    """Effect that raises an event, in both engines."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.tree = ["raise", name]

    def __call__(self, instance: Any, event: Event) -> None:
        instance.raise_event(Event(self.name))


class _Wait:
    """Effect that sends an event after a delay, in both engines."""

    def __init__(self, name: str, delay: int) -> None:
        self.name = name
        self.delay = delay
        self.tree = ["start", [name, ["value", delay]]]

    def __call__(self, instance: Any, event: Event) -> None:
        instance.send_after(Event(self.name), self.delay, self.name)


class _IsActive:
    """Guard about a state, in both engines."""

    def __init__(self, state: str, wanted: bool) -> None:
        self.state = state
        self.wanted = wanted
        self.tree = ["in", state] if wanted else ["not", ["in", state]]

    def __call__(self, instance: Any, event: Event) -> bool:
        return bool(instance.active(self.state) is self.wanted)


class _Maker(Maker):
    """Makes a machine whose guards and effects both engines run, and some states that defer."""

    def raising(self) -> object:
        name = self.dice.choice(EVENTS)
        return _Raise(name) if self.dice.random() < 0.5 else _Wait(name, self.dice.choice((0, 5)))

    def state(self, *shape: Any) -> State:
        made = super().state(*shape)
        if made.transitions and self.dice.random() < 0.3:
            made = made._replace(deferred=tuple(self.dice.sample(EVENTS, self.dice.randint(1, 2))))
        return made

    def transition(self) -> Any:
        made = super().transition()
        if made.guard is None:
            return made
        return made._replace(guard=_IsActive(self.dice.choice(self.ids), self.dice.random() < 0.5))


class _Fail:
    """Guard that fails, in both engines."""

    tree = ("field", ("data",), "nothing")

    def __call__(self, instance: Any, event: Event) -> bool:
        raise ExecutionError("there is no field `nothing`")


class _PatientMaker(_Maker):
    """Makes a flat machine that keeps many events, so that one recalled event frees others."""

    def tree(self, depth: int, region: bool = False) -> tuple[str, Kind, list[object]]:
        self.count += 1
        self.ids.append(f"s{self.count}")
        return self.ids[-1], Kind.STATE, []

    def machine(self) -> Machine:
        states = [self.state(*each) for each in self.shape]
        return Machine("m", states, limit=300, most_deferred=5)

    def state(self, *shape: Any) -> State:
        kept = self.dice.sample(EVENTS, self.dice.randint(1, 2))
        others = [each for each in EVENTS if each not in kept]
        transitions = [self.leaving(each, None) for each in others]
        if self.dice.random() < 0.3:
            transitions.append(self.leaving(kept[0], _Fail()))
            transitions.append(Transition(("error.execution",)))
        return State(shape[0], transitions=tuple(transitions), deferred=tuple(kept))

    def leaving(self, event: str, guard: Any) -> Transition:
        return Transition((event,), (self.dice.choice(self.ids),), guard)


@needs_node
def test_random_tables(pytestconfig: pytest.Config, tmp_path: Path) -> None:
    """Histories, regions, internal and conflicting transitions, deferral, and endless loops."""
    cases = []
    for seed in range(20_000 if pytestconfig.getoption("--agreement") else 200):
        dice = random.Random(seed)
        steps = [Step(dice.choice(EVENTS)) for _ in range(20)]
        maker = (_PatientMaker if seed % 4 == 0 else _Maker)(random.Random(seed))
        cases.append(of_table(f"seed {seed}", maker.machine(), [steps]))
    runs = agreed(cases, tmp_path)
    assert any(run[-1] == "loop" for run in runs)
    assert any(["received", "done.state.s2"] in step["calls"] for run in runs for step in run[:-1])
    calls = [[call[0] for call in step["calls"]] for run in runs for step in run if step != "loop"]
    assert any(each.count("recalled") > 2 for each in calls)
    assert any("dropped" in each for each in calls)
