"""Files that are replaced together."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from swarmdsl.base.atomic_write import Staging


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="pipes with names are of POSIX")
def test_what_is_no_regular_file_is_never_replaced(tmp_path: Path) -> None:
    pipe, file = tmp_path / "pipe", tmp_path / "file"
    os.mkfifo(pipe)

    with Staging() as staging:
        staging.add(file, b"text")
        with pytest.raises(OSError, match="no regular file") as error:
            staging.add(pipe, b"text")
    assert error.value.filename == str(pipe)
    assert pipe.is_fifo()
    assert [path.name for path in tmp_path.iterdir()] == ["pipe"]
