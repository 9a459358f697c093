"""A cluster of Dask, with a scheduler and two workers: the same bytes as one process."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest

from swarmdsl.execution.experiments import engines
from swarmdsl.execution.experiments.engines import cluster, local
from swarmdsl.execution.experiments.failures import StoppedError
from swarmdsl.execution.experiments.running import Progress, Runs
from swarmdsl.execution.experiments.shipment import Shipment
from swarmdsl.execution.experiments.store import Store
from swarmdsl.execution.experiments.task import Candidate, Row, Task, canonical

from .conftest import Packed


@contextmanager
def started(folder: Path, *words: str) -> Iterator[subprocess.Popen[bytes]]:
    """Start a program that ends with the block; what it says is in a file."""
    with (folder / "said.txt").open("ab") as said:
        process = subprocess.Popen(words, cwd=folder, stdout=said, stderr=said)
        try:
            yield process
        finally:
            process.kill()
            process.wait()


class Kill(Progress):
    """Kills a process with the first rows."""

    def __init__(self, process: subprocess.Popen[bytes]) -> None:
        self.process = process
        self.rows = 0

    def add(self, rows: Sequence[Row]) -> None:
        if not self.rows:
            os.kill(self.process.pid, signal.SIGKILL)
        self.rows += len(rows)


def test_a_cluster_of_three_processes_gives_the_same_bytes(
    packed: Packed, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("distributed", reason="no distributed: pip install -e '.[dev]'")
    shipment = packed()
    tasks, more = _tasks(shipment, range(9)), _tasks(shipment, range(9, 18))
    with local(1) as engine, Store(tmp_path / "one" / "runs.sqlite") as store:
        runs = Runs({shipment.digest: shipment}, engine, store)
        one, one_more = runs.run(tasks), runs.run(more)

    found, path = tmp_path / "scheduler.json", tmp_path / "dask" / "runs.sqlite"
    scheduler = ("scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--no-show")
    worker = ("worker", "--nthreads", "1", "--no-dashboard", "--no-nanny")
    file = ("--scheduler-file", str(found))
    with ExitStack() as stack:
        first = stack.enter_context(started(tmp_path, *_dask(*scheduler, *file)))
        workers = [stack.enter_context(started(tmp_path, *_dask(*worker, *file))) for _ in "ab"]
        engine = stack.enter_context(cluster(_address(found)))
        store = stack.enter_context(Store(path))
        kill = Kill(workers[0])
        dask = Runs({shipment.digest: shipment}, engine, store, kill).run(tasks)
        assert kill.rows == 54
        ran = {each.worker for each in store.all()}
        monkeypatch.setattr(engines, "_WAIT", 1)
        # Without a scheduler, the runs end with a plain word, and those that are done are kept.
        with pytest.raises(StoppedError) as stopped:
            Runs({shipment.digest: shipment}, engine, store, Kill(first)).run(more)
        kept = len(list(store.all()))

    with local(1) as engine, Store(path, is_new=False) as store:
        runs = Runs({shipment.digest: shipment}, engine, store)
        dask_more = runs.run(more)

    assert texts(dask) == texts(one)
    assert str(os.getpid()) not in ran
    assert (stopped.value.name, "--resume" in (stopped.value.help or "")) == ("no-engine", True)
    assert runs.ran == 108 - kept < 54
    assert texts(dask_more) == texts(one_more)


def texts(rows: Sequence[Sequence[Row]]) -> list[list[str]]:
    return [[canonical(row.as_data()) for row in each] for each in rows]


def _tasks(shipment: Shipment, seeds: range) -> list[Task]:
    return [
        Task(shipment.digest, "scenario.toml", Candidate.of({"count of robot": n}), tuple(seeds))
        for n in range(1, 7)
    ]


def _dask(*words: str) -> tuple[str, ...]:
    """Return the command `dask` of this environment."""
    return (str(Path(sys.executable).with_name("dask")), *words)


def _address(file: Path) -> str:
    """Wait for the scheduler to write its address."""
    import json
    import time

    while True:
        try:
            return str(json.loads(file.read_text())["address"])
        except (FileNotFoundError, ValueError):
            time.sleep(0.05)


def test_a_scheduler_that_does_not_answer_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed", reason="no distributed: pip install -e '.[dev]'")
    monkeypatch.setattr(engines, "_WAIT", 1)
    with cluster("tcp://127.0.0.1:9") as engine, pytest.raises(StoppedError) as stopped:
        engine.executor  # noqa: B018 - it connects
    assert stopped.value.name == "no-engine"
    assert "dask scheduler" in (stopped.value.help or "")
