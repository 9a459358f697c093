"""Locks of folders, by a file in them too, as on Windows."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.execution.experiments import store
from swarmdsl.execution.experiments.failures import StoppedError
from swarmdsl.execution.experiments.store import Store
from swarmdsl.output.lock import FILE, lock_file, lock_now


def by_file(folder: Path) -> int | None:
    # As `msvcrt.locking`, which raises OSError without a class of its own.
    def lock(handle: int) -> None:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise OSError(36, "Resource deadlock avoided") from None

    return lock_file(folder, lock)


@pytest.mark.parametrize("lock", [lock_now, by_file])
def test_a_folder_is_locked_until_it_is_released(
    lock: Callable[[Path], int | None], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    held = lock(tmp_path)
    assert held is not None
    with pytest.raises(BlockingIOError):
        lock(tmp_path)
    os.close(held)
    assert lock(tmp_path / "none") is None

    monkeypatch.setattr(store, "lock_now", lock)
    with Store(tmp_path / "runs.sqlite"):
        with pytest.raises(StoppedError) as stopped:
            Store(tmp_path / "runs.sqlite", is_new=False)
        assert stopped.value.fields["reason"] == "another search or experiment writes there"
    with Store(tmp_path / "runs.sqlite", is_new=False):
        pass
    assert (tmp_path / FILE).exists() == (lock is by_file)
