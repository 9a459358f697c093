"""Store of runs: one SQLite file, safe when a process is killed, readable while it is written."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

from swarmdsl import __version__
from swarmdsl.base.read_files import exists
from swarmdsl.base.records import dataclass
from swarmdsl.execution.experiments.failures import StoppedError
from swarmdsl.execution.experiments.task import Candidate, Row, Task, canonical, row_of

FILE = "runs.sqlite"
_FORMAT = 1
_TABLES = """
create table if not exists runs (
  model     text not null,
  scenario  text not null,
  text      text not null,
  candidate text not null,
  seed      integer not null,
  fitness   real,
  failure   text,
  row       text not null,
  seconds   real not null,
  worker    text not null,
  version   text not null,
  primary key (model, text, candidate, seed, scenario)
) without rowid;
"""
_T = TypeVar("_T")


@dataclass(frozen=True)
class Key:
    """Identity of runs without their seeds: digests of the model and of the scenario's text."""

    model: str
    scenario: str
    text: str
    candidate: Candidate


class Stored(NamedTuple):
    """A run as it is kept."""

    model: str
    scenario: str
    candidate: str
    seed: int
    row: str
    seconds: float
    worker: str
    version: str


class Store:
    """Runs in a file. Methods raise StoppedError where the file does not serve."""

    def __init__(self, path: Path, *, is_new: bool = True) -> None:
        self.path = path
        if is_new and exists(path):
            help_ = "add `--resume` to go on with them, or name another folder"
            raise StoppedError("runs-there", help_, path=path)
        if not is_new and not exists(path):
            help_ = "leave `--resume` out to begin"
            raise StoppedError("no-store", help_, path=path, reason="there is no such file")
        self._database = self._try(lambda: self._open(path))

    def __enter__(self) -> Store:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Close the file."""
        # All is written; what cannot be closed now is repaired when it is next opened.
        self._try(self._database.close)

    def rows(self, task: Task, key: Key) -> dict[int, Row]:
        """Return the rows of a task that are there, by seed."""
        if not task.seeds:
            return {}
        given = (key.model, key.text, key.candidate.text, min(task.seeds), max(task.seeds))
        found = self._try(
            lambda: self._database.execute(
                "select seed, row, seconds from runs where model = ? and text = ? "
                "and candidate = ? and seed between ? and ?",
                given,
            ).fetchall()
        )
        wanted = frozenset(task.seeds)
        rows = (
            row_of(task, _parsed(text), seconds) for seed, text, seconds in found if seed in wanted
        )
        return {row.seed: row for row in rows}

    def add(self, key: Key, rows: Sequence[Row], worker: str) -> None:
        """Keep rows, in one transaction."""
        given = [
            (
                *(key.model, key.scenario, key.text, key.candidate.text, row.seed, row.fitness),
                *(row.failure, canonical(row.as_data()), row.seconds, worker, __version__),
            )
            for row in rows
        ]
        self._try(lambda: self._add(given))

    def all(self) -> Iterator[Stored]:
        """Yield all runs, in the order of their identities."""
        found = self._try(
            lambda: self._database.execute(
                "select model, scenario, candidate, seed, row, seconds, worker, version from runs "
                "order by model, text, scenario, candidate, seed"
            )
        )
        yield from map(Stored._make, found)

    def _add(self, rows: Iterable[Sequence[Any]]) -> None:
        with self._database:
            self._database.executemany(
                f"insert or replace into runs values ({', '.join('?' * 11)})", rows
            )

    def _open(self, path: Path) -> sqlite3.Connection:
        path.parent.mkdir(parents=True, exist_ok=True)
        database = sqlite3.connect(path, timeout=30)
        (found,) = database.execute("pragma user_version").fetchone()
        if found not in (0, _FORMAT):
            database.close()
            help_ = "use the version of swarmdsl that wrote it"
            reason = f"its format is {found}, not {_FORMAT}"
            raise StoppedError("no-store", help_, path=path, reason=reason)
        database.execute("pragma journal_mode = wal")
        # A power failure may lose the last runs, but never the file.
        database.execute("pragma synchronous = normal")
        database.executescript(_TABLES)
        database.execute(f"pragma user_version = {_FORMAT}")
        return database

    def _try(self, action: Callable[[], _T]) -> _T:
        try:
            return action()
        except (sqlite3.Error, OSError) as error:
            reason = str(getattr(error, "strerror", None) or error)
            help_ = "what was kept before is safe: make room, and go on with `--resume`"
            raise StoppedError("no-store", help_, path=self.path, reason=reason) from error


def _parsed(text: str) -> Any:
    import json

    return json.loads(text)
