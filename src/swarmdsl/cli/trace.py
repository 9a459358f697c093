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
    help="An output folder of `swarmc build`; may be repeated. Without it: that of swarm.toml, "
    "those of this folder, `out` and `src` in it and the folders above, and those that logged "
    "files lie in.",
)
@options.diagnostics_format
@options.debug
def trace(paths: tuple[Path, ...], outs: tuple[Path, ...], format_: str) -> int:
    """Show which places in a model a log is about.

    Passes on what programs have said: tracebacks, what compilers and build tools report, logs
    of nodes. Below each line that names a generated file stands the place in the model that it
    was made for. Reads the standard input where no LOG is named.
    """
    from swarmdsl.base.diagnostics.collector import Diagnostics
    from swarmdsl.tools.trace.command import run

    report = Diagnostics()
    gc.enable()  # this can run for days
    if not sys.stdin.isatty() and not paths:
        # Who is in front of this in a pipe ends, and has the last word.
        signal.signal(signal.SIGINT, signal.SIG_IGN)
    colour = sys.stdout.isatty() or bool(os.environ.get("FORCE_COLOR"))
    run(paths, outs, sys.stdin.buffer, sys.stdout.buffer, report, colour=colour)
    render(report, format_, sys.stderr)
    return exit_code(report)
