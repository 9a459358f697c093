"""Measure searches: processes side by side, what the engine and the store take, the start."""

from __future__ import annotations

import json
import os
import resource
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import ExitStack, contextmanager
from importlib.util import find_spec
from multiprocessing import get_context
from pathlib import Path
from statistics import median
from time import perf_counter, process_time, sleep
from typing import NamedTuple

from measure import ENVIRONMENT, Section, interleaved, spread
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.experiments.engines import Engine, cluster, local
from swarmdsl.execution.experiments.running import Runs
from swarmdsl.execution.experiments.shipment import Conditions, Shipment, pack
from swarmdsl.execution.experiments.store import Store
from swarmdsl.execution.experiments.task import Candidate, Task
from swarmdsl.execution.experiments.worker import work

ROOT = Path(__file__).resolve().parents[1]
MISSION = ROOT / "examples" / "search_and_rescue"
SCENARIO = str(MISSION / "mission.toml")
CANDIDATES, SEEDS = 200, 30
SHARE = 100
"""Candidates of the other measurements, which have several rounds."""
ROUNDS = 3
SECONDS, RATIO, OVERHEAD, FIRST = 60.0, 1.85, 5.0, 1.0
"""Goals: all candidates on two cores, two processes against one, percent, the first result."""
_LOOK = 0.005
OPTIMIZE = """
optimize SearchAndRescue {
  count of rover in 2 .. 5
  uav.altitude in 2.0 .. 51.0 step 1.0
}
"""


class Spent(NamedTuple):
    """Seconds of some runs: on the clock, of processors, inside of runs, and outside of them."""

    wall: float
    processor: float
    runs: float
    beside: float


def section(folder: Path) -> Section:
    """Run candidates of a mission in one process and in more."""
    shipment = _shipment()
    everything, some = _tasks(shipment, CANDIDATES), _tasks(shipment, SHARE)
    found = Section(
        f"Candidates of [search and rescue](../examples/search_and_rescue/README.md), each with "
        f"{SEEDS} seeds: two to five rovers and three UAVs, for 20 minutes. Seconds on the clock, "
        "of all processors together, and in percent of the time of the runs what the process that "
        "hands out tasks and keeps results takes, with its store. With several rounds, these are "
        f"minimum, median and maximum of {ROUNDS}.",
        ["engine", "candidates", "seconds", "processor seconds", "engine and store, %"],
    )
    engines: dict[str, Callable[[], Engine]] = {
        "this process": lambda: local(1),
        "2 processes": lambda: local(2),
        "2 processes, nothing done here": _pool,
    }
    with ExitStack() as stack:
        if find_spec("distributed") is not None:
            address = stack.enter_context(_dask(folder))
            engines["Dask, 2 workers"] = lambda: cluster(address)
        spent: dict[str, list[Spent]] = {name: [] for name in engines}
        interleaved(
            {name: _round(shipment, some, make, spent[name]) for name, make in engines.items()},
            ROUNDS,
        )
    for name, rounds in spent.items():
        # A scheduler and workers that are there before are no processes of this one.
        is_here = not name.startswith("Dask")
        does_runs = name in ("this process", "2 processes")
        found.rows.append(
            [
                name,
                str(SHARE),
                spread([each.wall for each in rounds], "{:.2f}"),
                spread([each.processor for each in rounds], "{:.2f}") if is_here else "",
                "" if does_runs else spread([_percent(each) for each in rounds], "{:.1f}"),
            ]
        )
    whole = _spent(shipment, everything, lambda: local(2))
    row = ["2 processes", str(CANDIDATES), f"{whole.wall:.2f}", f"{whole.processor:.2f}", ""]
    found.rows.append(row)

    one, two = spent["this process"], spent["2 processes"]
    ratios = [a.wall / b.wall for a, b in zip(one, two, strict=True)]
    found.goal("two processes, relative to one", median(ratios), RATIO, "{:.2f}", least=True)
    shared = [2 * a.processor / b.processor for a, b in zip(one, two, strict=True)]
    found.notes.append(
        "the same by their processor time, which is what two idle processors could reach: "
        f"{median(shared):.2f}"
    )
    beside = median(_percent(each) for each in spent["2 processes, nothing done here"])
    found.goal(
        "engine and store, in percent of the runs, in tasks of 100 ms",
        beside,
        OVERHEAD,
        "{:.1f}",
    )
    what = f"{CANDIDATES} candidates with {SEEDS} seeds in 2 processes, in seconds"
    found.goal(what, whole.wall, SECONDS, "{:.1f}")
    found.notes.append(
        f"half of the processor time of these, in seconds: {whole.processor / 2:.1f}"
    )
    firsts = [_first_result(folder / "model") for _ in range(ROUNDS + 1)][1:]
    found.goal(
        "seconds from the start of `swarmc optimize` to the first result",
        median(wall for wall, _ in firsts),
        FIRST,
        "{:.2f}",
    )
    processor = spread([each for _, each in firsts], "{:.2f}")
    found.notes.append(f"processor seconds of it: {processor}")
    return found


def _shipment() -> Shipment:
    report = Diagnostics()
    packed = pack([MISSION], None, [Path(SCENARIO)], report, Conditions(properties=()))
    assert packed is not None, [each.message for each in report]
    return packed[0]


def _tasks(shipment: Shipment, number: int) -> list[Task]:
    """Return candidates, each with its rovers and an altitude."""
    given = ({"count of rover": 2 + n % 4, "uav.altitude": 2.0 + n // 4} for n in range(number))
    seeds = tuple(range(SEEDS))
    return [Task(shipment.digest, SCENARIO, Candidate.of(each), seeds) for each in given]


def _pool() -> Engine:
    """Return an engine whose tasks all run in other processes."""
    return Engine("a pool", lambda: ProcessPoolExecutor(2, get_context("spawn")), 2)


def _round(
    shipment: Shipment, tasks: Sequence[Task], make: Callable[[], Engine], found: list[Spent]
) -> Callable[[], float]:
    def run() -> float:
        found.append(_spent(shipment, tasks, make))
        return found[-1].wall

    return run


def _spent(shipment: Shipment, tasks: Sequence[Task], make: Callable[[], Engine]) -> Spent:
    """Run tasks from the start of the engine to its end."""
    path = Path(os.environ.get("TMPDIR", "/tmp")) / f"bench-{os.getpid()}"
    start, here, children = perf_counter(), process_time(), _of_children()
    try:
        with make() as engine, Store(path / "runs.sqlite") as store:
            # It has compiled the model, as a search has.
            work(shipment.as_data(), _nothing())
            rows = Runs({shipment.digest: shipment}, engine, store).run(tasks)
    finally:
        shutil.rmtree(path, ignore_errors=True)
    wall, own = perf_counter() - start, process_time() - here
    failed = [row.failure for each in rows for row in each if row.failure is not None]
    assert not failed, failed[:1]
    inside = sum(row.seconds for each in rows for row in each)
    return Spent(wall, own + _of_children() - children, inside, own)


def _nothing() -> dict[str, object]:
    return {"scenario": SCENARIO, "candidate": {}, "seeds": [], "main": os.getpid()}


def _of_children() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _percent(spent: Spent) -> float:
    return 100 * spent.beside / spent.runs


@contextmanager
def _dask(folder: Path) -> Iterator[str]:
    """Start a scheduler and two workers; yield the address."""
    dask, file = str(Path(sys.executable).with_name("dask")), folder / "scheduler.json"
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    scheduler = ("scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--no-show")
    worker = ("worker", "--nthreads", "1", "--no-dashboard", "--no-nanny")
    started: list[subprocess.Popen[bytes]] = []
    with ExitStack() as stack:
        for words in (scheduler, worker, worker):
            command = [dask, *words, "--scheduler-file", str(file)]
            process = stack.enter_context(subprocess.Popen(command, cwd=folder, **quiet))
            stack.callback(process.kill)
            started.append(process)
        while True:
            try:
                address = str(json.loads(file.read_text())["address"])
                break
            except (FileNotFoundError, ValueError):
                assert all(each.poll() is None for each in started), file
                sleep(_LOOK)
        yield address


def _first_result(folder: Path) -> tuple[float, float]:
    """Return the wall and the processor seconds of a search up to its first result."""
    if not folder.exists():
        shutil.copytree(MISSION, folder)
        with (folder / "sar.swarm").open("a") as file:
            file.write(OPTIMIZE)
    feed = folder / "feed.jsonl"
    feed.unlink(missing_ok=True)
    command = [sys.executable, "-m", "swarmdsl", "optimize", str(folder), "--scenario"]
    command += [str(folder / "mission.toml"), "--jobs", "2", "--feed", str(feed)]
    start = perf_counter()
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL, env=ENVIRONMENT)
    try:
        while not feed.exists() or '"runs"' not in feed.read_text():
            assert process.poll() is None, command
            sleep(_LOOK)
        return perf_counter() - start, _so_far(process.pid)
    finally:
        process.terminate()
        process.wait()


def _so_far(process: int) -> float:
    """Return the processor seconds of a process that goes on."""
    words = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")
