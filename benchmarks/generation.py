"""Measure the generation of ROS packages by the size of the state machine."""

from __future__ import annotations

import shutil
import sys
from functools import partial
from pathlib import Path
from statistics import median

from measure import Section, interleaved, process, spread

ROUNDS = 7

JAVA = {10: 1.5, 100: 2.5, 1000: 5.3, 5000: 18.2}
"""Run time of the original generator in seconds, by number of states that call actions.

Measured once, on two comparable processors.
"""
SHARE = 0.2
"""Goal: share of the time of the original generator."""

_SWARMC = str(Path(sys.executable).with_name("swarmc"))


def section(folder: Path) -> Section:
    """Build ROS 1 packages for state machines whose states all call actions."""
    out = folder / "out"
    commands: dict[str, list[str]] = {}
    for states in JAVA:
        model = folder / f"states{states}.swarm"
        model.write_text(machine(states), encoding="utf-8")
        commands[f"{states} states"] = [
            *(_SWARMC, "build", str(model), "--target", "smach", "--out", str(out))
        ]

    def run(name: str) -> float:
        shutil.rmtree(out, ignore_errors=True)
        return process(commands[name]).cpu

    # The first round compiles the modules of Python.
    times = interleaved({name: partial(run, name) for name in commands}, ROUNDS, warm_up=1)
    found = Section(
        "CPU time of whole processes in milliseconds, `swarmc build --target smach`, "
        f"{ROUNDS} rounds (minimum / median / maximum).",
        ["state machine", "swarmc, ms", "original generator, ms"],
    )
    for (name, taken), java in zip(times.items(), JAVA.values(), strict=True):
        found.rows.append([name, spread(taken, scale=1e3), f"{java * 1e3:.0f}"])
    for (name, taken), java in zip(times.items(), JAVA.values(), strict=True):
        found.goal(
            f"{name}: relative to the {java} s of a cold run of the original generator in Java",
            median(taken) / java,
            SHARE,
            "{:.3f}",
        )
    return found


def machine(states: int) -> str:
    """Return a machine whose states form a ring."""
    lines = [
        "package bench",
        "action Go { goal { x : float64 } }",
        'function go : abstraction { action "go" : Go }',
        "endless statemachine Long {",
        "  initial S0",
    ]
    for number in range(states):
        after = f"on succeeded -> S{(number + 1) % states}; on aborted -> S{number}"
        lines.append(f"  state S{number} {{ do go(x = {number}.5); {after} }}")
    return "\n".join([*lines, "}", ""])
