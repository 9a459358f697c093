"""Measure the state machine engine and comparable engines."""

from __future__ import annotations

import json
import tracemalloc
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from time import process_time
from typing import Any

import peers
from measure import Section, interleaved, process, spread
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.execution.engine import Event, Instance, Machine, Observer
from swarmdsl.execution.scxml import read

RUNS = 5
INSTANCES = 1_000
EVENTS = 100_000
"""Number of events in a run of the engine; other engines take fewer."""
FEWER = 50

HEAD = '<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" datamodel="ecmascript"'

TOGGLE = f"""{HEAD} initial="off">
  <state id="off"><transition event="t" target="on"/></state>
  <state id="on"><transition event="t" target="off"/></state>
</scxml>"""

GUARDED = f"""{HEAD} initial="off">
  <datamodel><data id="n" expr="0"/></datamodel>
  <state id="off"><transition event="t" cond="n &lt; 1" target="on">
    <assign location="n" expr="n + 1"/></transition></state>
  <state id="on"><transition event="t" cond="n == 1" target="off">
    <assign location="n" expr="n - 1"/></transition></state>
</scxml>"""


def region(name: str) -> str:
    """Return a region with three states."""
    return f"""<state id="R{name}">
      <state id="{name}a">
        <transition event="e1" target="{name}b"/><transition event="both" target="{name}b"/>
      </state>
      <state id="{name}b"><transition event="e2" target="{name}c"/></state>
      <state id="{name}c"><transition event="e1" target="{name}a"/></state>
    </state>"""


DEEP = f"""{HEAD}>
  <state id="d1"><state id="d2"><state id="d3"><parallel id="P">
    {region("x")}{region("y")}
    <transition event="re" target="P"/>
  </parallel></state></state></state>
</scxml>"""


def large(states: int) -> str:
    """Return a machine of `states` states in groups of ten, connected in a ring."""
    groups = []
    for first in range(0, states, 10):
        inner = "".join(
            f'<state id="s{n}"><transition event="t" target="s{(n + 1) % states}"/></state>'
            for n in range(first + 1, first + 10)
        )
        groups.append(
            f'<state id="s{first}"><transition event="out" target="s{(first + 10) % states}"/>'
            f"{inner}</state>"
        )
    return f"{HEAD}>{''.join(groups)}</scxml>"


CASES = {
    "toggle": (TOGGLE, ["t"]),
    "toggle with data": (GUARDED, ["t"]),
    "depth 6, two regions": (DEEP, ["e1", "e2", "e1", "both", "re"]),
    "1000 states": (large(1000), ["t"] * 8 + ["out"]),
}


class World:
    """World without effects: the machines here request nothing."""

    def schedule(self, *asked: object) -> Any:
        """Raise an error: the request would distort the measurement."""
        raise NotImplementedError(asked)

    unschedule = start = cancel = send = failed = schedule


class Silent(Observer):
    """Observer that ignores everything."""


def machine(text: str) -> Machine:
    """Return the machine of a document."""
    report = Diagnostics()
    found = read(Source("bench.scxml", text), report)
    assert found is not None, [each.message for each in report]
    return found


def instance(made: Machine, observer: Observer | None = None) -> Instance:
    """Return a started instance."""
    running = Instance(made, World(), observer=observer)
    running.start()
    return running


def seconds(action: Callable[[], object]) -> float:
    """Return the CPU seconds of an action."""
    start = process_time()
    action()
    return process_time() - start


def events_a_second(running: Instance, names: list[str]) -> float:
    """Return events per second; each event is created, and active states are read after it."""
    rounds = EVENTS // len(names)

    def run() -> None:
        for _ in range(rounds):
            for name in names:
                running.receive(Event(name))
                running.configuration  # noqa: B018

    return rounds * len(names) / seconds(run)


def events_of_statemachine(text: str, names: list[str]) -> float:
    """Return events per second of python-statemachine."""
    from statemachine.io import load

    running = load(text, format="scxml", trusted=True)()
    rounds = EVENTS // FEWER // len(names)

    def run() -> None:
        for _ in range(rounds):
            for name in names:
                running.send(name)
                running.configuration  # noqa: B018

    return rounds * len(names) / seconds(run)


def events_of_scion(text: str, names: list[str], folder: Path) -> float:
    """Return events per second of SCION, in a separate process."""
    file = folder / "scion.json"
    file.write_text(json.dumps([[text, names, EVENTS]]), encoding="utf-8")
    script = str(peers.FOLDER / "scion.mjs")
    return float(json.loads(process(["node", script, str(file)]).output)[0])


def bytes_an_instance(made: Machine, names: list[str]) -> float:
    """Return the memory of one of many instances after some events, in bytes."""
    warm = instance(made)
    for name in names:
        warm.receive(Event(name))
    world = World()
    tracemalloc.start()
    running = [Instance(made, world) for _ in range(INSTANCES)]
    for each in running:
        each.start()
        for name in names:
            each.receive(Event(name))
    size, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return size / len(running)


@dataclass(frozen=True)
class Engine:
    """Engine with its events per second; `peer` is the package that it needs."""

    name: str
    speed: Callable[[str, list[str]], float]
    peer: str | None = None


def section(folder: Path) -> Section:
    """Send events to each engine."""
    engines = (
        Engine("swarmdsl", lambda text, names: events_a_second(instance(machine(text)), names)),
        Engine(
            "swarmdsl, observed",
            lambda text, names: events_a_second(instance(machine(text), Silent()), names),
        ),
        Engine("python-statemachine", events_of_statemachine, "python-statemachine"),
        Engine(
            "SCION",
            lambda text, names: events_of_scion(text, names, folder),
            "@scion-scxml/scxml",
        ),
    )
    present, absent = peers.divide(engines)
    found = Section(
        "Thousands of events a second of CPU time, with the active states read after each event "
        f"(minimum / median / maximum of {RUNS} rounds). All engines read the same SCXML "
        "documents.",
        ["state machine", *(peers.title(each.name, each.peer) for each in present)],
    )
    for name, (text, names) in CASES.items():
        speeds = interleaved(
            {each.name: partial(each.speed, text, names) for each in present}, RUNS
        )
        found.rows.append([name, *(spread(values, "{:.1f}", 1e-3) for values in speeds.values())])
    text, names = CASES["depth 6, two regions"]
    size = bytes_an_instance(machine(text), names)
    found.notes.append(f"{size:.0f} bytes for each of {INSTANCES:,} instances with two regions")
    text, _ = CASES["1000 states"]
    starts = [seconds(lambda: instance(machine(text))) for _ in range(RUNS)]
    found.notes.append(f"1000 states read and started in {spread(starts, '{:.1f}', 1e3)} ms")
    found.notes += absent
    return found
