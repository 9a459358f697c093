"""Measures the phases of the compiler on models of growing size, against bare textX."""

from __future__ import annotations

import gc
import platform
import sys
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any

from swarmdsl import compiler
from swarmdsl.diagnostics import Diagnostics
from swarmdsl.emit import Request
from swarmdsl.parse import parse
from swarmdsl.source import Source
from swarmdsl.textx_entry import metamodel

SIZES = (10, 30, 115)
"""Numbers of state machines, each with 10 states."""

STATES = 10
RUNS = 5


def model(machines: int) -> str:
    """A valid model of that many state machines."""
    parts = ["package bench\n", "swarm event Stop : std_msgs/Empty\n"]
    parts += [machine(number) for number in range(machines)]
    return "\n".join(parts)


def machine(number: int) -> str:
    """A function, a state machine that calls it, and a member that runs the machine."""
    states = "".join(
        f"""
  state Step{step} {{
    do work_{number}(distance = 1.5)
    on succeeded [tries < 3] / tries = tries + 1 -> {following(step)}
    on succeeded -> End
    on aborted -> End
    on Stop -> End
  }}"""
        for step in range(STATES)
    )
    return f"""
action bench_msgs/Work{number} {{
  goal {{ distance : float64 }}
}}
function work_{number} : abstraction {{
  action "cmd/work_{number}" : bench_msgs/Work{number}
}}
statemachine Machine{number} {{
  var tries : int32 = 0
  initial Step0
{states}
  final End
}}
member Robot{number} {{
  behavior Machine{number}
}}
"""


def following(step: int) -> str:
    """The state after a step."""
    return f"Step{step + 1}" if step + 1 < STATES else "Step0"


def best_of(*actions: Callable[[], object]) -> tuple[float, ...]:
    """The shortest time of each, in seconds: the one that other programs disturbed least.

    They take turns, so that a machine that is slow for a while is slow for all of them.
    """
    times: list[list[float]] = [[] for _ in actions]
    for _ in range(RUNS):
        for action, taken in zip(actions, times, strict=True):
            gc.collect()
            start = process_time()
            action()
            taken.append(process_time() - start)
    return tuple(map(min, times))


def checked(result: compiler.Result) -> None:
    """Stop where the model was not valid: its time would mean nothing."""
    if result.report.has_errors:
        sys.exit("\n".join(found.message for found in result.report))


def measure(machines: int, textx: Any, folder: Path) -> tuple[float, ...]:
    """Seconds of bare textX, parse, check and build for a model."""
    text = model(machines)
    file = folder / "bench.swarm"
    file.write_text(text, encoding="utf-8")
    source = Source("bench.swarm", text)
    request = [Request("scxml")]
    return best_of(
        lambda: textx.model_from_str(text),
        lambda: parse(source, Diagnostics()),
        lambda: checked(compiler.check([file])),
        lambda: checked(compiler.build([file], request, folder / "out")),
    )


def main() -> None:
    """Print a table: thousands of lines a second, and how many times as fast as bare textX."""
    print(
        f"Python {platform.python_version()}, {platform.machine()}, best of {RUNS} runs, CPU time"
    )
    print(f"{'lines':>7}  {'textX':>7}  {'parse':>15}  {'check':>15}  {'build scxml':>15}")
    gc.disable()  # as swarmc does
    textx = metamodel()  # made once a run, whatever the size of the model
    with TemporaryDirectory() as folder:
        for machines in SIZES:
            bare, *phases = measure(machines, textx, Path(folder))
            lines = model(machines).count("\n")
            cells = "  ".join(f"{lines / time / 1000:6.1f} k {bare / time:6.2f}" for time in phases)
            print(f"{lines:7}  {lines / bare / 1000:5.1f} k  {cells}")


if __name__ == "__main__":
    main()
