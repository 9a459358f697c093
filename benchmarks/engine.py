"""Measures the engine of state machines, against python-statemachine."""

from __future__ import annotations

import platform
import tracemalloc
from collections.abc import Callable
from time import process_time
from typing import Any

from statemachine.io import load

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.runtime import Event, Instance, Machine, Observer
from swarmdsl.scxml import read
from swarmdsl.source import Source

RUNS = 5
INSTANCES = 1_000
EVENTS = 100_000
"""How many events a run of the engine takes; one of the other engine takes fewer."""
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
    """A region with three states."""
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
    """A machine of that many states, in groups of ten, which events lead around."""
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
    """In which nothing happens: the machines here ask for nothing."""

    def schedule(self, *asked: object) -> Any:
        """Fail, whatever it is: it would be measured as well."""
        raise NotImplementedError(asked)

    unschedule = start = cancel = send = failed = schedule


class Silent(Observer):
    """Is told everything and says nothing."""


def machine(text: str) -> Machine:
    """The machine of a document."""
    report = Diagnostics()
    found = read(Source("bench.scxml", text), report)
    assert found is not None, [each.message for each in report]
    return found


def instance(made: Machine, observer: Observer | None = None) -> Instance:
    """A started instance."""
    running = Instance(made, World(), observer=observer)
    running.start()
    return running


def best_of(action: Callable[[], object]) -> float:
    """The shortest time of some runs, in seconds of the processor."""
    times = []
    for _ in range(RUNS):
        start = process_time()
        action()
        times.append(process_time() - start)
    return min(times)


def events_a_second(running: Instance, names: list[str]) -> float:
    """How many events the engine takes, each made anew, and the active states looked at."""
    rounds = EVENTS // len(names)

    def run() -> None:
        for _ in range(rounds):
            for name in names:
                running.receive(Event(name))
                running.configuration  # noqa: B018

    return rounds * len(names) / best_of(run)


def events_of_the_other(text: str, names: list[str]) -> float:
    """The same of python-statemachine."""
    running = load(text, format="scxml", trusted=True)()
    rounds = EVENTS // FEWER // len(names)

    def run() -> None:
        for _ in range(rounds):
            for name in names:
                running.send(name)
                running.configuration  # noqa: B018

    return rounds * len(names) / best_of(run)


def bytes_an_instance(made: Machine, names: list[str]) -> float:
    """How much memory each of many instances needs, after some events."""
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


def main() -> None:
    """Print a table."""
    print(f"Python {platform.python_version()}, {platform.machine()}, best of {RUNS} runs")
    print(f"{'events a second':22}{'engine':>11}{'observed':>11}{'other':>9}{'times':>7}")
    for name, (text, names) in CASES.items():
        made = machine(text)
        own = events_a_second(instance(made), names)
        observed = events_a_second(instance(made, Silent()), names)
        other = events_of_the_other(text, names)
        print(f"{name:22}{own:11,.0f}{observed:11,.0f}{other:9,.0f}{own / other:7.0f}")
    text, names = CASES["depth 6, two regions"]
    print(f"{bytes_an_instance(machine(text), names):.0f} bytes an instance of {INSTANCES}")
    text, _ = CASES["1000 states"]
    print(
        f"1000 states read and started in {best_of(lambda: instance(machine(text))) * 1e3:.1f} ms"
    )


if __name__ == "__main__":
    main()
