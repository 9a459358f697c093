"""Measure generated ROS 2 nodes and an equivalent handwritten one."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from statistics import median
from typing import Any

import generation
import peers
from measure import Section, interleaved, process, spread

ROOT = Path(__file__).resolve().parents[1]
TESTS = ROOT / "tests" / "ros2"
FOLDER = Path(os.environ.get("SWARMDSL_ROS2", ROOT / ".ros2"))
ROUNDS = 5
BATCHES = 5
PINGS = 300
IDLE = 4.0
"""Seconds without messages to measure an idle node."""
MANY = 20
TOGETHER = 10
STATES = 1000
_SWARMC = str(Path(sys.executable).with_name("swarmc"))

MODEL = """
package bench
event Ping : std_msgs/Empty on "ping"
event Pong : std_msgs/Empty on "pong"
endless statemachine Echo {
  initial A
  state A { on Ping / send Pong -> B }
  state B { on Ping / send Pong -> A }
}
member Robot { behavior Echo }
swarm Many { robot : Robot[10] }
"""

BY_HAND = "by hand"
TELLING = "by hand, with reports"
GENERATED = "generated"


def section(folder: Path) -> Section:
    """Start nodes, let them answer, leave them idle, and measure their cost."""
    found = Section(
        "A node that answers a message with another one, on rclpy; "
        f"{ROUNDS} rounds (minimum / median / maximum). Messages are sent one after the other, "
        "through the middleware and back; a round takes the minimum of "
        f"{BATCHES} batches of {PINGS} messages. The node with reports publishes its state, each "
        "transition and, once a second, diagnostics, and logs what it does, as generated nodes do.",
        [
            "node",
            "start, CPU ms",
            "message to answer, µs",
            "message to answer, CPU µs",
            f"{IDLE:.0f} s idle, CPU ms",
            "memory, MB",
        ],
    )
    python = FOLDER / "venv" / "bin" / "python"
    if python.is_file():
        _nodes(folder, found)
    else:
        found.notes.append(
            "nodes were not measured: ROS 2 is not installed; `make test-ros2` installs it"
        )
    model = folder / "long.swarm"
    model.write_text(generation.machine(STATES), encoding="utf-8")
    out = folder / "out"

    def build() -> float:
        shutil.rmtree(out, ignore_errors=True)
        return process([_SWARMC, "build", str(model), "--target", "ros2", "--out", str(out)]).cpu

    times = interleaved({"build": build}, ROUNDS, warm_up=1)["build"]
    found.goal(
        f"`swarmc build --target ros2` of {STATES} states, minimum CPU seconds",
        min(times),
        0.5,
        "{:.2f}",
    )
    return found


def _nodes(folder: Path, found: Section) -> None:
    sys.path.insert(0, str(TESTS))
    import harness

    model = folder / "echo.swarm"
    model.write_text(MODEL, encoding="utf-8")
    build = [_SWARMC, "build", str(model), "--target", "ros2", "--out", str(folder / "src")]
    process([*build, "--option", "ros2.composed=true"])
    package = folder / "src" / "ros2" / "bench_behavior"
    ros = harness.Ros(FOLDER, [package], 19, folder)
    by_hand = [str(peers.FOLDER / "ros2_node.py"), "--ros-args"]
    commands = {
        BY_HAND: by_hand,
        TELLING: [*by_hand, "-p", "tells:=true"],
        GENERATED: ["-m", "bench_behavior.echo", "--ros-args"],
    }
    try:
        taken = interleaved(
            {name: partial(_one, ros, command) for name, command in commands.items()}, ROUNDS, 1
        )
        for name, rounds in taken.items():
            cells = [
                spread([value[index] for value in rounds], form, scale)
                for index, (_, form, scale, _) in enumerate(_COLUMNS)
            ]
            found.rows.append([name, *cells])
        for index, (what, _, _, limit) in enumerate(_COLUMNS):
            # Other load on the machine only adds to the minimum.
            least = {name: min(value[index] for value in rounds) for name, rounds in taken.items()}
            value = least[GENERATED] / least[TELLING]
            beside = f"relative to the node {TELLING}"
            found.goal(f"{what}, {beside}", value, limit, "{:.2f}")
        idle = min(value[_IDLE] for value in taken[GENERATED]) / IDLE * 100
        found.goal("a generated node when idle, % of one CPU", idle, _SHARE, "{:.2f}")
        _many(ros, commands, found)
        _together(ros, commands[GENERATED], found)
    finally:
        ros.close()


_COLUMNS = (
    ("CPU time of the start", "{:.0f}", 1e3, 1.2),
    ("time from a message to the answer", "{:.0f}", 1e6, 1.1),
    ("CPU time of an answer", "{:.0f}", 1e6, 1.1),
    ("CPU time of an idle node", "{:.1f}", 1e3, 1.5),
    ("memory", "{:.1f}", 1e-6, 1.2),
)
"""Measured quantity, its format, and the goal: factor over the handwritten node."""
_IDLE = 3
"""Column of the idle node."""
_SHARE = 2.0
"""Share of a CPU that a node may take when it is idle, in per cent."""


def _one(ros: Any, command: list[str]) -> Any:
    """Return the cost of one node in the order of _COLUMNS, in seconds and bytes."""
    with _driver(ros) as ask:
        node = ros.start(*command, "-r", "__ns:=/one", **_QUIET)
        ask(connect=["/one"])
        start = _processor(node.pid)
        ask(rounds=50)
        answers, work = zip(*(_batch(node.pid, ask) for _ in range(BATCHES)), strict=True)
        before = _processor(node.pid)
        time.sleep(IDLE)
        idle = _processor(node.pid) - before
        memory = _memory(node.pid)
        _end(node)
    return start, min(answers), min(work), idle, memory


def _batch(process_id: int, ask: Any) -> tuple[float, float]:
    """Return wall-clock and CPU seconds for a message and its answer."""
    before = _processor(process_id)
    answers = ask(rounds=PINGS)
    return median(answers), (_processor(process_id) - before) / PINGS


def _many(ros: Any, commands: dict[str, list[str]], found: Section) -> None:
    """Measure twenty nodes of each kind at once."""
    spaces = [f"/many_{number}" for number in range(MANY)]
    for name in (TELLING, GENERATED):
        with _driver(ros) as ask:
            began = time.perf_counter()
            nodes = [ros.start(*commands[name], "-r", f"__ns:={s}", **_QUIET) for s in spaces]
            start = time.perf_counter() - began + ask(connect=spaces)[0]
            answers = ask(rounds=50)
            before = [_processor(node.pid) for node in nodes]
            time.sleep(IDLE)
            idle = sum(_processor(node.pid) for node in nodes) - sum(before)
            memory = sum(_memory(node.pid) for node in nodes)
            for node in nodes:
                _end(node)
        found.notes.append(
            f"{MANY} nodes, {name}: all answer {start:.1f} s after their start, all answer a "
            f"message to all within {median(answers) * 1e3:.1f} ms; together they take "
            f"{idle / IDLE * 100:.1f} % of one CPU when idle, and {memory / 1e6:.0f} MB"
        )


def _together(ros: Any, command: list[str], found: Section) -> None:
    """Compare the memory of ten nodes in one process with that of ten processes."""
    spaces = [f"/together_{number}" for number in range(TOGETHER)]
    container = ["-m", "bench_behavior.container"]
    for space in spaces:
        container += ["--node", "echo", space, "--"]
    memory = {}
    for name, started in (
        ("one", [container]),
        ("many", [[*command, "-r", f"__ns:={space}"] for space in spaces]),
    ):
        with _driver(ros) as ask:
            nodes = [ros.start(*words, **_QUIET) for words in started]
            ask(connect=spaces)
            ask(rounds=50)
            memory[name] = sum(_memory(node.pid) for node in nodes)
            for node in nodes:
                _end(node)
    found.goal(
        f"memory of {TOGETHER} nodes in one process (option `composed`), relative to "
        f"{TOGETHER} processes with {memory['many'] / 1e6:.0f} MB",
        memory["one"] / memory["many"],
        1 / 3,
        "{:.2f}",
    )


_QUIET = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}


@contextmanager
def _driver(ros: Any) -> Iterator[Any]:
    """Start the driver process; yield a function that sends it commands."""
    driver = ros.start(
        peers.FOLDER / "ros2_driver.py", stdin=subprocess.PIPE, stdout=subprocess.PIPE
    )

    def ask(**what: Any) -> list[float]:
        driver.stdin.write(json.dumps(what) + "\n")
        driver.stdin.flush()
        answer = json.loads(driver.stdout.readline())
        assert isinstance(answer, list)
        return answer

    # The driver joins the graph before a node is started.
    ask(connect=[])
    try:
        yield ask
    finally:
        driver.stdin.close()
        driver.wait()


def _end(node: subprocess.Popen[str]) -> None:
    node.terminate()
    try:
        node.wait(10)
    except subprocess.TimeoutExpired:
        # rclpy.spin misses signals that arrive while it goes to sleep.
        node.kill()
        node.wait()


def _processor(process_id: int) -> float:
    """Return the CPU seconds of all threads of a process (schedstat of Linux)."""
    threads = Path("/proc", str(process_id), "task").glob("*/schedstat")
    return sum(int(each.read_text(encoding="ascii").split()[0]) for each in threads) / 1e9


def _memory(process_id: int) -> int:
    """Return the proportional memory of a process in bytes (proc(5), Pss)."""
    for line in Path("/proc", str(process_id), "smaps_rollup").read_text().splitlines():
        if line.startswith("Pss:"):
            return int(line.split()[1]) * 1024
    raise ValueError("no Pss")
