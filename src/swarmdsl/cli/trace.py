"""`swarmc trace`."""

from __future__ import annotations

import gc
import os
import signal
import sys
from pathlib import Path

import click

from swarmdsl.base.diagnostics.render import render
from swarmdsl.cli import options
from swarmdsl.cli.exit_code import exit_code


@click.command(epilog="Example: swarmc trace robot.log, or colcon build 2>&1 | swarmc trace")
@click.argument("paths", metavar="[LOG]...", nargs=-1, type=click.Path(path_type=Path))
@click.option(
    "--out",
    "-o",
    "outs",
    type=click.Path(path_type=Path),
    metavar="DIR",
    multiple=True,
    help="An output folder of `swarmc build`; may be repeated. Default: that of swarm.toml, this "
    "folder and those above with their `out` and `src`, and the folders of logged files.",
)
@options.diagnostics_format
@options.debug
def trace(paths: tuple[Path, ...], outs: tuple[Path, ...], format_: str) -> int:
    """Show the places in a model that a log refers to.

    Passes on the output of programs: tracebacks, compiler errors, logs of nodes. After each
    line that names a generated file comes the place in the model that it was generated from.
    Reads standard input without a LOG.
    """
    from swarmdsl.base.diagnostics.collector import Diagnostics
    from swarmdsl.tools.trace.command import run

    report = Diagnostics()
    gc.enable()  # it can run for days
    if not sys.stdin.isatty() and not paths:
        # The program before it in the pipe ends first; its last lines are still read.
        signal.signal(signal.SIGINT, signal.SIG_IGN)
    colour = sys.stdout.isatty() or bool(os.environ.get("FORCE_COLOR"))
    run(paths, outs, sys.stdin.buffer, sys.stdout.buffer, report, colour=colour)
    render(report, format_, sys.stderr)
    return exit_code(report)
