"""Store of runs: one SQLite file, safe when a process is killed, readable while it is written."""

from __future__ import annotations

import json
import os
import sqlite3
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

from swarmdsl import __version__
from swarmdsl.base.read_files import exists
from swarmdsl.base.records import dataclass
from swarmdsl.execution.experiments.failures import StoppedError
from swarmdsl.execution.experiments.task import Candidate, Row, Task, canonical, row_of
from swarmdsl.output.lock import lock_now

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
_FULL = ("full", "No space", "quota", "disk I/O")
"""Words for a disk that takes no more, of SQLite and of systems."""
_T = TypeVar("_T")


@dataclass(frozen=True)
class Key:
    """Identity of runs without their seeds: digests of the model and of the scenario's text."""

    model: str
    scenario: str
    text: str
    candidate: Candidate


class Stored(NamedTuple):
    """A run as it is kept; `text` is the digest of the scenario."""

    model: str
    scenario: str
    text: str
    candidate: str
    seed: int
    row: str
    seconds: float
    worker: str
    version: str


class Store:
    """Runs in a file. Methods raise StoppedError where the file does not serve.

    One process at a time adds runs; others may read them meanwhile with `is_read_only`.
    """

    def __init__(self, path: Path, *, is_new: bool = True, is_read_only: bool = False) -> None:
        self.path = path
        self._is_read_only = is_read_only
        self._lock: int | None = None
        if not is_read_only:
            self._begin(is_new)
        elif not exists(path):
            help_ = "name the folder of `-o` of a search or an experiment"
            raise self._stopped("there is no such file", help_)
        try:
            self._database = self._try(self._open)
        except StoppedError:
            self._unlock()
            raise

    def _begin(self, is_new: bool) -> None:
        """Check that the file is there or not there, as it should, and lock its folder."""
        if is_new and exists(self.path):
            help_ = "add `--resume` to go on with them, or name another folder"
            raise StoppedError("runs-there", help_, path=self.path)
        if not is_new and not exists(self.path):
            raise self._stopped("there is no such file", "leave `--resume` out to begin")
        folder = self.path.parent
        self._try(lambda: folder.mkdir(parents=True, exist_ok=True))
        try:
            self._lock = lock_now(folder)
        except BlockingIOError:
            help_ = "wait until it ends, or name another folder with `-o`"
            reason = "another search or experiment writes there"
            raise self._stopped(reason, help_) from None

    def __enter__(self) -> Store:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Close the file."""
        # All is written; what cannot be closed now is repaired when it is next opened.
        self._try(self._database.close)
        self._unlock()

    def _unlock(self) -> None:
        if self._lock is not None:
            os.close(self._lock)
            self._lock = None

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
            row_of(task, json.loads(text), seconds)
            for seed, text, seconds in found
            if seed in wanted
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
                "select model, scenario, text, candidate, seed, row, seconds, worker, version "
                "from runs order by model, text, scenario, candidate, seed"
            )
        )
        yield from map(Stored._make, found)

    def _add(self, rows: Iterable[Sequence[Any]]) -> None:
        with self._database:
            self._database.executemany(
                f"insert or replace into runs values ({', '.join('?' * 11)})", rows
            )

    def _open(self) -> sqlite3.Connection:
        database = sqlite3.connect(self._address, timeout=30, uri=True)
        (found,) = database.execute("pragma user_version").fetchone()
        if found not in (0, _FORMAT):
            database.close()
            help_ = "use the version of swarmdsl that wrote it"
            raise self._stopped(f"its format is {found}, not {_FORMAT}", help_)
        if self._is_read_only:
            return database
        database.execute("pragma journal_mode = wal")
        # A power failure may lose the last runs, but never the file.
        database.execute("pragma synchronous = normal")
        database.executescript(_TABLES)
        database.execute(f"pragma user_version = {_FORMAT}")
        return database

    @property
    def _address(self) -> str:
        """Address of the file for SQLite."""
        address = self.path.absolute().as_uri()
        if not self._is_read_only:
            return address
        # SQLite writes beside a file that others may write, unless it knows that nobody does.
        is_still = not os.access(self.path.parent, os.W_OK) and not exists(_log(self.path))
        return f"{address}?mode=ro{'&immutable=1' if is_still else ''}"

    def _try(self, action: Callable[[], _T]) -> _T:
        try:
            return action()
        except (sqlite3.Error, OSError) as error:
            reason = str(getattr(error, "strerror", None) or error)
            help_ = "name another folder with `-o`"
            if self._is_read_only:
                help_ = "name the folder of `-o` of a search or an experiment"
            elif any(word in reason for word in _FULL):
                help_ = "what was kept before is safe: make room, and go on with `--resume`"
            raise self._stopped(reason, help_) from error

    def _stopped(self, reason: str, help_: str) -> StoppedError:
        use = "read" if self._is_read_only else "keep"
        return StoppedError("no-store", help_, use=use, path=self.path, reason=reason)


def _log(path: Path) -> Path:
    """Return the path of what was written last, before it is in the file itself."""
    return path.with_name(f"{path.name}-wal")
