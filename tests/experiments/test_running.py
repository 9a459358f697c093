"""Runs on engines: the same rows for any number of workers, and after everything that fails."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Sequence
from concurrent.futures import BrokenExecutor
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.base.records import replace
from swarmdsl.execution.experiments import engines, worker
from swarmdsl.execution.experiments.blocks import Pace, cut
from swarmdsl.execution.experiments.engines import Engine, Inline, local
from swarmdsl.execution.experiments.failures import StoppedError
from swarmdsl.execution.experiments.running import Progress, Runs
from swarmdsl.execution.experiments.shipment import Shipment, shipment_of
from swarmdsl.execution.experiments.store import Store
from swarmdsl.execution.experiments.task import Candidate, Row, Task

from .conftest import Packed

SEEDS = tuple(range(12))


def tasks_of(shipment: Shipment, *candidates: dict[str, Any]) -> list[Task]:
    return [
        Task(shipment.digest, "scenario.toml", Candidate.of(each), SEEDS) for each in candidates
    ]


def runs_of(shipment: Shipment, store: Store, engine: Engine, **more: Any) -> Runs:
    return Runs({shipment.digest: shipment}, engine, store, **more)


def results(rows: Sequence[Sequence[Row]]) -> list[list[dict[str, Any]]]:
    return [[row.as_data() for row in each] for each in rows]


class KillOnce(Progress):
    """Kills a worker when the first rows are there."""

    def __init__(self, engine: Engine) -> None:
        self.engine = engine
        self.killed: list[int] = []

    def add(self, rows: Sequence[Row]) -> None:
        if not self.killed:
            self.killed += list(self.engine.executor._processes)[:1]  # type: ignore[attr-defined]
            os.kill(self.killed[0], signal.SIGKILL)


def test_rows_are_the_same_for_processes_one_of_which_is_killed(
    packed: Packed, tmp_path: Path
) -> None:
    shipment = packed()
    tasks = tasks_of(
        shipment,
        {"robot.patience": "3s"},
        {"count of robot": 4},
        {"scenario functions.go.aborted": 1.0},
    )
    with local(1) as engine, Store(tmp_path / "one" / "runs.sqlite") as store:
        one = runs_of(shipment, store, engine).run(tasks)
    with local(2) as engine, Store(tmp_path / "two" / "runs.sqlite") as store:
        kill = KillOnce(engine)
        runs = runs_of(shipment, store, engine, progress=kill)
        two = runs.run(tasks)
        kept = list(store.all())

    assert results(two) == results(one)
    assert [[row.seed for row in rows] for rows in one] == [list(SEEDS)] * 3
    assert kill.killed
    # What was done before and after: all runs are in the store, of several processes.
    assert len(kept) == 3 * len(SEEDS)
    assert len({each.worker for each in kept}) > 1
    # This process does not wait for the others to begin.
    assert str(os.getpid()) in {each.worker for each in kept}
    waited = [rows[0].measures["waited"] for rows in one]
    assert waited == [3.0, 8.0, 8.0]
    assert {row.measures["good"] for row in one[2]} == {0}
    assert {row.verdicts["Fine"] for row in one[2]} == {"false"}
    # The same chance for all: with one more robot, nothing changes for the first.
    assert all(row.fitness is not None for rows in one for row in rows)


@pytest.mark.skipif(not hasattr(signal, "SIGPIPE"), reason="no signal of pipes")
def test_a_pipe_of_a_lost_worker_is_an_error_and_no_signal() -> None:
    """`swarmc` ends by SIGPIPE as other programs do, but not where workers may be lost."""
    reader, writer = os.pipe()
    os.close(reader)
    before = signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    try:
        with local(1), pytest.raises(BrokenPipeError):
            os.write(writer, b"a task")
        assert signal.getsignal(signal.SIGPIPE) is signal.SIG_DFL
    finally:
        signal.signal(signal.SIGPIPE, before)
        os.close(writer)


def test_what_the_store_has_is_not_run_again(packed: Packed, tmp_path: Path) -> None:
    shipment = packed()
    path = tmp_path / "runs.sqlite"
    (task,) = tasks_of(shipment, {})
    with local(1) as engine:
        with Store(path) as store:
            first = runs_of(shipment, store, engine).run([replace(task, seeds=SEEDS[:5])])
        with Store(path, is_new=False) as store:
            runs = runs_of(shipment, store, engine)
            again = runs.run([task, task])
            # Others see what is there while it is written, and cannot write.
            with Store(path, is_read_only=True) as reader:
                assert len(list(reader.all())) == len(SEEDS)
            with pytest.raises(StoppedError, match="no-store") as stopped:
                Store(path, is_new=False)
            assert "another search" in stopped.value.fields["reason"]
            other = replace(shipment, scenarios={"scenario.toml": "until = '10 s'"})
            afresh = runs_of(other, store, engine)
            afresh.run([task])

    assert runs.ran == len(SEEDS) - 5
    assert again[0][:5] == first[0]
    assert again[0] == again[1]
    assert [row.seconds for row in again[0][:5]] == [row.seconds for row in first[0]]
    assert afresh.ran == len(SEEDS)
    with pytest.raises(StoppedError, match="runs-there"):
        Store(path)
    with pytest.raises(StoppedError, match="no-store"):
        Store(tmp_path / "none.sqlite", is_new=False)
    other_file = tmp_path / "a %20?#" / "runs.sqlite"
    other_file.parent.mkdir()
    other_file.write_text("no database, but long enough to look like one")
    for use in (True, False):
        with pytest.raises(StoppedError, match="no-store") as stopped:
            Store(other_file, is_new=False, is_read_only=use)
        assert stopped.value.fields["reason"] == "file is not a database"
        assert "folder" in (stopped.value.help or "")
    other_file.unlink()
    with Store(other_file) as store:
        assert list(store.all()) == []
    assert other_file.exists()


@pytest.mark.skipif(sys.platform == "win32", reason="no limits of files")
def test_a_full_disk_is_a_plain_word(packed: Packed, tmp_path: Path) -> None:
    import resource

    shipment, path = packed(), tmp_path / "runs.sqlite"
    tasks = tasks_of(shipment, *({"count of robot": count} for count in range(1, 7)))
    usual = resource.getrlimit(resource.RLIMIT_FSIZE)
    with local(1) as engine, Store(path) as store:
        runs_of(shipment, store, engine).run(tasks[:1])
        # No file of this process can grow further, as on a full disk.
        size = path.with_name("runs.sqlite-wal").stat().st_size
        resource.setrlimit(resource.RLIMIT_FSIZE, (size + 1000, usual[1]))
        try:
            with pytest.raises(StoppedError) as stopped:
                runs_of(shipment, store, engine).run(tasks)
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, usual)

    assert stopped.value.name == "no-store"
    assert "--resume" in (stopped.value.help or "")
    with local(1) as engine, Store(path, is_new=False) as store:
        assert len(list(store.all())) == len(SEEDS)
        runs = runs_of(shipment, store, engine)
        assert [len(rows) for rows in runs.run(tasks)] == [len(SEEDS)] * 6
    assert runs.ran == 5 * len(SEEDS)


def test_candidates_that_cannot_run_have_rows_that_say_why(packed: Packed, tmp_path: Path) -> None:
    shipment = packed()
    wrong = {"count of robot": 99}, {"nobody.patience": "3s"}, {"robot.patience": 4}
    with local(1) as engine, Store(tmp_path / "runs.sqlite") as store:
        found = runs_of(shipment, store, engine).run(tasks_of(shipment, *wrong, {}))

    assert [{row.failure for row in rows} for rows in found] == [
        {found[0][0].failure},
        {"no member called `nobody`"},
        {found[2][0].failure},
        {None},
    ]
    assert "1 to 6" in str(found[0][0].failure)
    assert "time like" in str(found[2][0].failure)
    assert {row.fitness for rows in found[:3] for row in rows} == {None}


def test_a_run_that_does_not_end_fails_alone(
    packed: Packed, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Such a model cannot be written, but for a function model of a project.
    usual = worker.Runner._outcome

    def endless(self: Any, started: Any, ending: Any) -> Any:
        while started.seed == 3:
            try:
                sum(range(1000))
            except Exception:
                continue
        if started.seed == 5:
            raise ZeroDivisionError("no time")
        return usual(self, started, ending)

    monkeypatch.setattr(worker.Runner, "_outcome", endless)
    shipment = packed()
    with local(1) as engine, Store(tmp_path / "runs.sqlite") as store:
        (rows,) = runs_of(shipment, store, engine, limit=0.2).run(tasks_of(shipment, {}))

    failures = {row.seed: row.failure for row in rows if row.failure is not None}
    assert failures == {3: "it does not end within 0.2 s", 5: "ZeroDivisionError: no time"}


def test_a_worker_of_another_version_refuses(packed: Packed, tmp_path: Path) -> None:
    shipment = replace(packed(), version="0.0.1")
    assert shipment_of(shipment.as_data()) == shipment
    with (
        local(1) as engine,
        Store(tmp_path / "runs.sqlite") as store,
        pytest.raises(StoppedError, match="worker-refuses") as stopped,
    ):
        runs_of(shipment, store, engine).run(tasks_of(shipment, {}))
    assert "not 0.0.1" in stopped.value.fields["reason"]


def test_a_computer_without_this_package_refuses(packed: Packed, tmp_path: Path) -> None:
    class Strange(Inline):
        def submit(self, fn: Any, /, *args: Any, **named: Any) -> Any:
            return super().submit(_unknown, *args)

    shipment = packed()
    with (
        Engine("strange", Strange, 1) as engine,
        Store(tmp_path / "runs.sqlite") as store,
        pytest.raises(StoppedError, match="worker-refuses") as stopped,
    ):
        runs_of(shipment, store, engine).run(tasks_of(shipment, {}))
    assert stopped.value.fields["reason"].endswith(": No module named 'swarmdsl.later'")


def _unknown(*_: Any) -> None:
    """Fail as a scheduler of Dask does that cannot read a task."""
    try:
        import_module("swarmdsl.later")
    except ImportError as error:
        raise RuntimeError("the environments are different") from error


def test_workers_that_are_always_lost_end_the_runs(packed: Packed, tmp_path: Path) -> None:
    class Losing(Inline):
        def submit(self, fn: Any, /, *args: Any, **named: Any) -> Any:
            return super().submit(_raise, *args)

    starts: list[Losing] = []

    def start() -> Losing:
        starts.append(Losing())
        return starts[-1]

    shipment = packed()
    with (
        Engine("losing", start, 1) as engine,
        Store(tmp_path / "runs.sqlite") as store,
        pytest.raises(StoppedError, match="lost-workers") as stopped,
    ):
        runs_of(shipment, store, engine).run(tasks_of(shipment, {}))

    assert stopped.value.fields["times"] == 4
    assert len(starts) == 4


def _raise(*_: Any) -> None:
    raise BrokenExecutor


@pytest.mark.parametrize(
    ("address", "reason"),
    [("localhost:8786", "no kind of engine"), ("moon://far", "no kind of engine")],
)
def test_an_engine_that_is_not_there_is_reported(address: str, reason: str) -> None:
    with pytest.raises(StoppedError, match="no-engine") as stopped:
        engines.cluster(address)
    assert reason in stopped.value.fields["reason"]


def test_blocks_take_at_least_the_time_that_makes_them_worth_it() -> None:
    pace = Pace()
    assert pace.size("a") == 2
    pace.note("a", 2, 0.02, 1)
    assert pace.size("a") == 10
    pace.note("b", 4, 4.0, 30)
    assert pace.size("b") == 30
    assert cut(range(30), 20) == (list(range(15)), list(range(15, 30)))
    assert cut(range(3), 20) == ([0, 1, 2], [])
