"""Fleet in a trace of lines while it is written."""

from __future__ import annotations

import threading
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import OddFileError
from swarmdsl.ide.fleet.watch import Tell, Watch
from swarmdsl.ide.preview.trace_file import Turn, read_growing
from swarmdsl.project.read_source import report_unreadable


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
        report = Diagnostics()
        report_unreadable(Path(name), error, None, report, "a trace")
        tell(report)
