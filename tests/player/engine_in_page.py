"""The engine of the page under node, and what it did beside what the engine in Python does."""

from __future__ import annotations

import json
import shutil
import subprocess
from collections.abc import Iterable, Iterator, Sequence
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from swarmdsl import ir
from swarmdsl.execution.engine import (
    Envelope,
    Event,
    Instance,
    LoopError,
    Machine,
    Observer,
    Run,
    State,
    Transition,
)
from swarmdsl.execution.simulate.machines.machine_data import first_data
from swarmdsl.execution.simulate.machines.table import table
from swarmdsl.ir import System
from swarmdsl.tools.player.engine_table import written_machine, written_table
from swarmdsl.tools.player.engine_values import encoded

from ..agreement.engines import Step, World

HERE = Path(__file__).parent
PAGE = Path(written_machine.__code__.co_filename).parent / "page"
NODE = shutil.which("node")
needs_node = pytest.mark.skipif(NODE is None, reason="needs node: apt install nodejs")


def node(script: str, lines: Iterable[str], folder: Path) -> list[Any]:
    """Run a script of the tests beside the modules of the page, on lines of JSON."""
    assert NODE is not None
    for path in (*PAGE.glob("*.js"), HERE / script):
        shutil.copy(path, folder / path.name)
    (folder / "package.json").write_text('{"type": "module"}')
    (folder / "lines").write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")
    done = subprocess.run(
        [NODE, folder / script, folder / "lines"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return [json.loads(line) for line in done.stdout.splitlines()]


@dataclass(frozen=True)
class Case:
    """A machine, in both engines, with first data and steps of each of its runs."""

    name: str
    machine: Machine
    written: dict[str, Any]
    data: dict[str, Any]
    scripts: Sequence[Sequence[Step]]

    @property
    def line(self) -> str:
        scripts = [
            {"data": encoded(self.data), "steps": [_written(step) for step in steps]}
            for steps in self.scripts
        ]
        return json.dumps({"table": self.written, "scripts": scripts})

    def expected(self) -> Iterator[list[Any]]:
        for steps in self.scripts:
            yield _run(self.machine, self.data, steps)


def of_model(
    name: str,
    machine: ir.StateMachine,
    system: System,
    params: dict[str, Any],
    scripts: Sequence[Sequence[Step]],
) -> Case:
    """The case of a machine of a model."""
    data = first_data(machine, system, params)
    return Case(name, table(machine, system), written_machine(machine, system), data, scripts)


def of_table(name: str, machine: Machine, scripts: Sequence[Sequence[Step]]) -> Case:
    """The case of a table whose guards and effects have trees."""
    return Case(name, machine, written_table(machine), {}, scripts)


def agreed(cases: Sequence[Case], folder: Path) -> list[list[Any]]:
    """Compare all runs of the engine of the page with those of Python; return its steps."""
    found = node("machines.js", (case.line for case in cases), folder)
    runs = []
    for case, made in zip(cases, found, strict=True):
        for steps, run, expected in zip(case.scripts, made, case.expected(), strict=True):
            for number, (here, there) in enumerate(zip(run, expected, strict=False)):
                step = steps[number - 1] if number else "start"
                assert here == there, f"{case.name}, {number}: {step}\n{here}\n{there}"
            assert len(run) == len(expected), case.name
            runs.append(run)
    return runs


def _written(step: Step) -> dict[str, Any]:
    return {
        "event": step.event,
        "data": encoded(step.data),
        "run": step.run,
        "time": step.time,
        "sender": step.sender,
        "sent": step.sent,
    }


class _World(World):
    """Also notes what it was asked for, in detail."""

    def start(self, run: Run) -> None:
        super().start(run)
        self.calls.append(["start", run.activity.name, encoded(run.goal)])

    def cancel(self, run: Run) -> None:
        self.calls.append(["cancel", run.activity.name])
        super().cancel(run)

    def send(self, instance: Instance, event: Event) -> None:
        self.calls.append(["send", event.name, encoded(event.data), event.envelope.to])

    def __init__(self) -> None:
        super().__init__()
        self.calls: list[list[Any]] = []


def _run(machine: Machine, data: Any, steps: Sequence[Step]) -> list[Any]:
    """State after each step, as the script for node prints it."""
    world, calls = _World(), _Calls(machine)
    instance = Instance(machine, world, data=deepcopy(data), observer=calls)
    found: list[Any] = []
    try:
        instance.start()
        found.append(_situation(world, instance, calls))
        for step in steps:
            _take(world, instance, step)
            found.append(_situation(world, instance, calls))
    except LoopError:
        found.append("loop")
    return found


def _take(world: _World, instance: Instance, step: Step) -> None:
    if step.time:
        world.clock.step()
    elif step.run is not None:
        state, outcome = step.run
        run = next(each for each in world.going if instance.machine.states[each.state].id == state)
        world.going.remove(run)
        run.end(outcome, step.data)
    else:
        envelope = Envelope(step.sender, step.sent)
        instance.receive(Event(step.event, step.data, envelope=envelope))


class _Calls(Observer):
    """Notes every call."""

    def __init__(self, machine: Machine) -> None:
        self.calls: list[list[Any]] = []
        self.machine = machine

    def _note(self, call: str, *words: Any) -> None:
        self.calls.append([call, *words])

    def received(self, instance: Any, event: Event) -> None:
        self._note("received", event.name)

    def ignored(self, instance: Any, event: Event) -> None:
        self._note("ignored", event.name)

    def deferred(self, instance: Any, event: Event) -> None:
        self._note("deferred", event.name)

    def dropped(self, instance: Any, event: Event) -> None:
        self._note("dropped", event.name)

    def recalled(self, instance: Any, event: Event) -> None:
        self._note("recalled", event.name)

    def exited(self, instance: Any, state: State) -> None:
        self._note("exited", state.id)

    def taken(self, instance: Any, transition: Transition) -> None:
        self._note("taken", self.machine.called(transition))

    def entered(self, instance: Any, state: State) -> None:
        self._note("entered", state.id)

    def started(self, instance: Any, run: Run) -> None:
        self._note("started", run.activity.name)

    def cancelled(self, instance: Any, run: Run) -> None:
        self._note("cancelled", run.activity.name)

    def sent(self, instance: Any, event: Event) -> None:
        self._note("sent", event.name)

    def scheduled(self, instance: Any, event: Event, delay: int) -> None:
        self._note("scheduled", event.name, str(delay))

    def withdrawn(self, instance: Any, event: Event) -> None:
        self._note("withdrawn", event.name)


def _situation(world: _World, instance: Instance, calls: _Calls) -> dict[str, Any]:
    asked, world.calls = world.calls, []
    noted, calls.calls = calls.calls, []
    due = {id(alarm): time for time, _, alarm in world.clock._alarms}
    found = {
        "active": instance.configuration.ids,
        "histories": [str(each) for each in instance.configuration.histories],
        "final": instance.final,
        "data": encoded(instance.data),
        "timers": [[t.event.name, str(due.get(id(t.handle), 0))] for t in instance._timers or ()],
        "deferred": [event.name for event in instance._deferred or ()],
        "runs": [run.state for run in world.going],
        "now": str(world.time),
        "failures": len(world.errors),
        "asked": asked,
        "calls": noted,
    }
    return json.loads(json.dumps(found))
