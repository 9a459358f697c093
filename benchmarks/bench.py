"""Measures the phases of the compiler on models of growing size, against bare textX."""

from __future__ import annotations

import platform
import sys
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

from swarmdsl import compiler
from swarmdsl.diagnostics import Diagnostics
from swarmdsl.emit import Request
from swarmdsl.parse import parse
from swarmdsl.source import Source
from swarmdsl.textx_entry import metamodel

SIZES = (10, 30, 100)
"""Numbers of state machines, each with 10 states."""

STATES = 10
RUNS = 3


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


def best_of(action: Callable[[], object]) -> float:
    """The shortest time of some runs, in seconds: the one that other programs disturbed least."""
    times = []
    for _ in range(RUNS):
        start = perf_counter()
        action()
        times.append(perf_counter() - start)
    return min(times)


def checked(result: compiler.Result) -> None:
    """Stop where the model was not valid: its time would mean nothing."""
    if result.report.has_errors:
        sys.exit("\n".join(found.message for found in result.report))


def measure(machines: int, folder: Path) -> tuple[float, ...]:
    """Seconds of bare textX, parse, check and build for a model."""
    text = model(machines)
    file = folder / "bench.swarm"
    file.write_text(text, encoding="utf-8")
    source = Source("bench.swarm", text)
    request = [Request("scxml")]
    return (
        best_of(lambda: metamodel().model_from_str(text)),
        best_of(lambda: parse(source, Diagnostics())),
        best_of(lambda: checked(compiler.check([file]))),
        best_of(lambda: checked(compiler.build([file], request, folder / "out"))),
    )


def main() -> None:
    """Print a table: seconds, and how many times as long as bare textX."""
    print(f"Python {platform.python_version()}, {platform.machine()}, best of {RUNS} runs")
    print(f"{'lines':>7}  {'textX':>8}  {'parse':>15}  {'check':>15}  {'build scxml':>15}")
    metamodel()  # made once a run, whatever the size of the model
    with TemporaryDirectory() as folder:
        for machines in SIZES:
            bare, *phases = measure(machines, Path(folder))
            lines = model(machines).count("\n")
            cells = "  ".join(f"{time:7.3f} s {time / bare:5.2f}" for time in phases)
            print(f"{lines:7}  {bare:6.3f} s  {cells}")


if __name__ == "__main__":
    main()
