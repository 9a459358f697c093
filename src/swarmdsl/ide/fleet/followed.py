"""Fleet in a trace of lines while it is written."""

from __future__ import annotations

import threading
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import OddFileError, open_file
from swarmdsl.ide.fleet.watch import Tell, Watch
from swarmdsl.ide.preview.trace_file import STDIN, Turn, read_growing
from swarmdsl.project.read_source import report_unreadable


def wait_or_refuse(name: str, watch: Watch, tell: Tell) -> bool:
    """Return False if a trace can never be read, which is told; let a missing one be waited for."""
    if name == STDIN:
        return True
    try:
        open_file(Path(name)).close()
    except FileNotFoundError:
        watch.waiting = (
            f"waiting for `{name}`: there is no such file (nodes of ROS 2 are named `ros2:NAME`)"
        )
    except OSError as error:
        _refuse(name, error, tell)
        return False
    return True


def follow_trace(name: str, watch: Watch, tell: Tell) -> None:
    """Add what comes to a watch in a background thread, to the end of the trace or forever."""
    threading.Thread(target=_read, args=(name, watch, tell), daemon=True).start()


def _read(name: str, watch: Watch, tell: Tell) -> None:
    try:
        for chunk in read_growing(name):
            if chunk is Turn.BEGUN:
                watch.begin_again()
            elif isinstance(chunk, Turn):
                watch.turn(chunk.value)
            elif chunk:
                watch.read(chunk)
    except OddFileError as error:
        _refuse(name, error, tell)


def _refuse(name: str, error: OSError, tell: Tell) -> None:
    report = Diagnostics()
    report_unreadable(Path(name), error, None, report, "a trace")
    tell(report)
