"""Measure the run time of `swarmc` commands."""

from __future__ import annotations

import shutil
import sys
from functools import partial
from pathlib import Path
from statistics import median

import workspace
from measure import Cost, Section, interleaved, process, spread

ROUNDS = 15
LINES = 300

JAVA = 1.5
"""Run time of the original generator in seconds.

For one state machine with ten states that call actions; the model here has five with eight.
Measured once, on two comparable processors.
"""
SHARE = 0.12
"""Goal: share of the time of the original generator."""

_SWARMC = str(Path(sys.executable).with_name("swarmc"))


def section(folder: Path) -> Section:
    """Run `swarmc` on a model of a few hundred lines, and Python on an empty program."""
    model = folder / "bench.swarm"
    lines = workspace.write_file(model, LINES, plain=True)
    out = folder / "out"
    commands = {
        "`python -c pass`": [sys.executable, "-c", "pass"],
        "`swarmc --version`": [_SWARMC, "--version"],
        f"`swarmc check`, {lines} lines": [_SWARMC, "check", str(model)],
        f"`swarmc build --target smach`, {lines} lines": [
            *(_SWARMC, "build", str(model), "--target", "smach", "--out", str(out))
        ],
    }
    costs: dict[str, list[Cost]] = {name: [] for name in commands}

    def run(name: str) -> float:
        shutil.rmtree(out, ignore_errors=True)
        costs[name].append(process(commands[name]))
        return costs[name][-1].cpu

    # The first round compiles the modules of Python.
    processor = interleaved({name: partial(run, name) for name in commands}, ROUNDS, warm_up=1)
    found = Section(
        f"Milliseconds of whole processes, {ROUNDS} rounds (minimum / median / maximum).",
        ["command", "CPU, ms", "wall clock, ms"],
    )
    for name, times in processor.items():
        walls = spread([cost.wall for cost in costs[name][1:]], scale=1e3)
        found.rows.append([name, spread(times, scale=1e3), walls])
    python, _, check, build = (median(times) * 1e3 for times in processor.values())
    found.goal(
        f"a check, in ms, where the goal is twice `python -c pass` ({python:.0f}) plus 60",
        check,
        2 * python + 60,
        "{:.0f}",
    )
    found.goal(
        f"a build, relative to the {JAVA} s of a cold run of the original generator in Java",
        build / (JAVA * 1e3),
        SHARE,
        "{:.3f}",
    )
    return found
