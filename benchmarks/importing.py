"""Measure the import of large documents."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from statistics import median

from measure import Cost, Section, interleaved, process, spread

ROUNDS = 7
STATES = 1_000

JAVA = 5.3
"""Run time of the original generator in seconds, for a document of as many states.

Measured once, on two comparable processors.
"""

_SWARMC = str(Path(sys.executable).with_name("swarmc"))
_HEAD = '<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" name="large" initial="s0">'


def dialect() -> Iterator[str]:
    """Yield states that call actions, in the CPSwarm dialect; each leads to the next or back."""
    yield _HEAD
    for number in range(STATES - 1):
        action = f"<name>cmd/do_{number % 50}</name><action>work_msgs/Do{number % 50}</action>"
        body = f"{action}<goal type='empty'/><result type='empty'/>"
        yield (
            f'<state id="s{number}">\n  <datamodel><data id="invoke"><rosaction>{body}'
            "</rosaction></data></datamodel>\n  <invoke type='ROS_ACTION'/>\n"
            f'  <transition event="succeeded" target="s{number + 1}"/>\n'
            f'  <transition event="aborted" target="s{max(0, number - 1)}"/>\n</state>'
        )
    yield f'<state id="s{STATES - 1}"/>\n</scxml>'


def plain() -> Iterator[str]:
    """Yield states with events, conditions and assignments, in plain SCXML."""
    yield f'{_HEAD}\n<datamodel><data id="n" expr="0"/></datamodel>'
    for number in range(STATES - 1):
        yield (
            f'<state id="s{number}">\n'
            f'  <transition event="e{number % 50}" cond="n &lt; {number}" target="s{number + 1}">\n'
            '    <assign location="n" expr="n + 1"/></transition>\n'
            f'  <transition event="back" target="s{max(0, number - 1)}"/>\n</state>'
        )
    yield f'<final id="s{STATES - 1}"/>\n</scxml>'


def section(folder: Path) -> Section:
    """Import a document of each kind in a separate process."""
    commands: dict[str, list[str]] = {}
    for name, made in (("CPSwarm", dialect()), ("W3C", plain())):
        path = folder / f"{name.rpartition(' ')[2].lower()}.xml"
        path.write_text("\n".join(made), encoding="utf-8")
        commands[name] = [_SWARMC, "import", "scxml", str(path)]
    costs: dict[str, list[Cost]] = {name: [] for name in commands}

    def run(name: str) -> float:
        costs[name].append(process(commands[name]))
        return costs[name][-1].cpu

    # The first round compiles the modules of Python.
    processor = interleaved({name: partial(run, name) for name in commands}, ROUNDS, warm_up=1)
    found = Section(
        f"`swarmc import scxml` of {STATES:,} states, in milliseconds of whole processes "
        f"(minimum / median / maximum of {ROUNDS} rounds).",
        ["dialect", "CPU, ms", "wall clock, ms"],
    )
    for name, times in processor.items():
        walls = spread([cost.wall for cost in costs[name][1:]], scale=1e3)
        found.rows.append([name, spread(times, scale=1e3), walls])
    for name, times in processor.items():
        found.goal(f"import from the {name} dialect, in seconds", median(times), 1, "{:.2f}")
    least = median(processor["CPSwarm"])
    found.notes.append(
        f"for comparison: the original generator in Java takes {JAVA} s to generate code from a "
        f"CPSwarm document with as many states, {JAVA / least:.1f} times as long as the import"
    )
    return found
