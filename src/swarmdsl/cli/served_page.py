"""Pages that commands serve until the user ends them."""

from __future__ import annotations

import gc
import signal
import sys
import time
from contextlib import AbstractContextManager, ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

import click

from swarmdsl.base import interrupts
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.diagnostics.render import render

if TYPE_CHECKING:
    from swarmdsl.execution.simulate.run.prepare import Prepared, Request
    from swarmdsl.ide.preview.ros2 import UnavailableError

_NAP = 0.2
"""Seconds between two looks for an interrupt."""


def tell(report: Diagnostics) -> None:
    """Print diagnostics while a page is served."""
    render(report, "text", sys.stderr)


def tell_of_ros(error: UnavailableError) -> None:
    """Print the reason for which nodes of ROS 2 cannot be followed."""
    report = Diagnostics()
    report.report("ros2-unavailable", reason=str(error), help=error.hint)
    tell(report)


def run_for_hours() -> None:
    """Prepare the process for a run that lasts."""
    gc.enable()
    if hasattr(signal, "SIGPIPE"):
        # A page may be closed while it is written to; others stay.
        signal.signal(signal.SIGPIPE, signal.SIG_IGN)


def prepared_to_grow(request: Request, trace: Path) -> tuple[Prepared | None, bool]:
    """Return what a trace is played with, and True if the model has errors, which are told."""
    from swarmdsl.tools.player.command import prepare_traces

    report = Diagnostics()
    prepared = prepare_traces(request, [trace], report)
    tell(report)
    return prepared, report.has_errors


def opened(
    page: AbstractContextManager[str], place: str, opens: bool, stack: ExitStack, say: bool = True
) -> str:
    """Serve a page, and return its address; raises ClickException if the place is taken."""
    try:
        address = stack.enter_context(page)
    except OSError as error:
        raise click.ClickException(f"{place}: {error.strerror}") from error
    if say:
        click.echo(address)
    if opens:
        click.launch(address)
    return address


def wait_for_interrupt() -> None:
    """Wait until the user interrupts."""
    while True:
        time.sleep(_NAP)
        interrupts.raise_lost()
