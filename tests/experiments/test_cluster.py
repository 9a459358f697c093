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

from swarmdsl.execution.experiments.engines import cluster, local
from swarmdsl.execution.experiments.failures import StoppedError
from swarmdsl.execution.experiments.running import Progress, Runs
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


class KillWorker(Progress):
    """Kills a worker with the first rows."""

    def __init__(self, process: subprocess.Popen[bytes]) -> None:
        self.process = process
        self.rows = 0

    def add(self, rows: Sequence[Row]) -> None:
        if not self.rows:
            os.kill(self.process.pid, signal.SIGKILL)
        self.rows += len(rows)


def test_a_cluster_of_three_processes_gives_the_same_bytes(packed: Packed, tmp_path: Path) -> None:
    pytest.importorskip("distributed", reason="no distributed: pip install -e '.[dev]'")
    shipment = packed()
    tasks = [
        Task(shipment.digest, "scenario.toml", Candidate.of({"count of robot": n}), tuple(range(9)))
        for n in range(1, 7)
    ]
    with local(1) as engine, Store(tmp_path / "one" / "runs.sqlite") as store:
        one = Runs({shipment.digest: shipment}, engine, store).run(tasks)

    found = tmp_path / "scheduler.json"
    scheduler = ("scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--no-show")
    worker = ("worker", "--nthreads", "1", "--no-dashboard", "--no-nanny")
    file = ("--scheduler-file", str(found))
    with ExitStack() as stack:
        stack.enter_context(started(tmp_path, *_dask(*scheduler, *file)))
        workers = [stack.enter_context(started(tmp_path, *_dask(*worker, *file))) for _ in "ab"]
        engine = stack.enter_context(cluster(_address(found)))
        store = stack.enter_context(Store(tmp_path / "dask" / "runs.sqlite"))
        kill = KillWorker(workers[0])
        dask = Runs({shipment.digest: shipment}, engine, store, kill).run(tasks)
        assert kill.rows == 54
        ran = {each.worker for each in store.all()}

    assert [[canonical(row.as_data()) for row in rows] for rows in dask] == [
        [canonical(row.as_data()) for row in rows] for rows in one
    ]
    assert str(os.getpid()) not in ran


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
    from swarmdsl.execution.experiments import engines

    monkeypatch.setattr(engines, "_WAIT", 1)
    with cluster("tcp://127.0.0.1:9") as engine, pytest.raises(StoppedError) as stopped:
        engine.executor  # noqa: B018 - it connects
    assert stopped.value.name == "no-engine"
    assert "dask scheduler" in (stopped.value.help or "")
