"""Measure the drawing of large state machines, and their layout beside that of ELK."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from statistics import median

import layouts
from measure import Section, interleaved, process, spread

ROUNDS = 5
STATES = 1_000

_SWARMC = str(Path(sys.executable).with_name("swarmc"))
_EVENTS = 20


def nested() -> Iterator[str]:
    """Yield composite states of ten states each, with transitions inside and across them."""
    count = STATES // 10
    yield "  initial C0"
    for number in range(count):
        yield f"  state C{number} {{\n    initial S0"
        for at in range(10):
            yield f"    state S{at} {{\n      on E{(number + at) % _EVENTS} -> S{(at + 1) % 10}"
            if at % 2:
                yield f"      on E{(number + at + 1) % _EVENTS} -> S{at * 7 % 10}"
            if at % 5 == 4:
                yield f"      on E{(number + at + 2) % _EVENTS} -> C{(number + 3) % count}"
            yield "    }"
        yield f"    on E{(number + 7) % _EVENTS} -> C{(number + 1) % count}\n  }}"


def flat() -> Iterator[str]:
    """Yield a chain of states, some with a transition a few states back."""
    yield "  initial S0"
    for number in range(STATES):
        yield f"  state S{number} {{\n    on E{number % _EVENTS} -> S{(number + 1) % STATES}"
        if number % 3 == 0:
            yield f"    on E{(number + 1) % _EVENTS} -> S{max(0, number - 4)}"
        yield "  }"


def model(states: Iterator[str]) -> str:
    """Return a model with one state machine."""
    events = (f"event E{number} : std_msgs/Empty" for number in range(_EVENTS))
    return "\n".join(["package large", *events, "endless statemachine Large {", *states, "}\n"])


def section(folder: Path) -> Section:
    """Draw a machine of each kind in each format, in a separate process."""
    commands: dict[str, list[str]] = {}
    for name, states in (("in composite states", nested()), ("side by side", flat())):
        path = folder / f"{name.rpartition(' ')[2]}.swarm"
        path.write_text(model(states), encoding="utf-8")
        for format_ in ("svg", "mermaid"):
            out = path.with_suffix(f".{format_}")
            options = ["--format", format_, "-o", str(out)]
            commands[f"{name}, as {format_}"] = [_SWARMC, "diagram", str(path), *options]

    def run(name: str) -> float:
        return process(commands[name]).cpu

    # The first round compiles the modules of Python.
    processor = interleaved({name: partial(run, name) for name in commands}, ROUNDS, warm_up=1)
    found = Section(
        f"`swarmc diagram` of a state machine with {STATES:,} states, CPU time of whole processes "
        f"in milliseconds (minimum / median / maximum of {ROUNDS} rounds).",
        ["states", "CPU, ms"],
    )
    for name, times in processor.items():
        found.rows.append([name, spread(times, scale=1e3)])
    for name, times in processor.items():
        if name.endswith("svg"):
            found.goal(f"states {name}, in seconds", median(times), 2, "{:.2f}")
    found.more.append(layouts.section(folder))
    return found
