"""The command line: `swarmc`, one module a command.

What was asked for goes to stdout, all about the run to stderr. Whatever a command needs
is imported when it runs, and the command itself when it is named or `--help` lists it, so
that `swarmc --version` is quick.
"""

from __future__ import annotations

import atexit
import errno
import gc
import os
import signal
import sys
from collections.abc import Sequence
from importlib import import_module
from io import TextIOWrapper
from keyword import iskeyword
from typing import NoReturn

import click

from swarmdsl import __version__
from swarmdsl.cli import options
from swarmdsl.cli.outcome import ERRORS, INTERNAL, INTERRUPTED, OK, TERMINATED

# The names of the commands are those of their modules, and of the functions in them; a keyword of
# Python has a `_` there.
COMMANDS = ("build", "check", "explain", "fmt", "import", "simulate", "targets", "test")


class _Commands(click.Group):
    """The commands, each imported when it is asked for."""

    def list_commands(self, _context: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, _context: click.Context, name: str) -> click.Command | None:
        if name not in COMMANDS:
            return None
        called = f"{name}_" if iskeyword(name) else name
        command = getattr(import_module(f"{__name__}.{called}"), called)
        assert isinstance(command, click.Command)
        return command


@click.command(
    cls=_Commands,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog="Example: swarmc build examples/search_and_rescue --target smach -o out",
)
@click.version_option(__version__, prog_name="swarmc")
@options.debug
def cli() -> None:
    """Compile swarms of robots: .swarm models to exchange formats and ROS packages."""


def main() -> None:
    """Run `swarmc` in its own process."""
    for stream in (sys.stdout, sys.stderr):
        # A name of a file or of a model may have what the terminal's encoding lacks.
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    if hasattr(signal, "SIGPIPE"):
        # `swarmc targets | head -1` ends quietly, as other programs do.
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    # As an exception, so that files that are being written are cleaned up.
    signal.signal(signal.SIGTERM, lambda _signal, _frame: sys.exit(TERMINATED))
    # What a compiler makes is needed until it is done: looking for garbage costs a tenth of
    # its time. A server must turn it on.
    gc.disable()
    _leave(run(sys.argv[1:]))


def _leave(code: int) -> NoReturn:
    """End the process at once: to give back its memory piece by piece takes as long as to link."""
    atexit._run_exitfuncs()
    try:
        sys.stdout.flush()
        sys.stderr.flush()
    except (OSError, ValueError):  # the interpreter says what is wrong
        sys.exit(code)
    os._exit(code)


def run(arguments: Sequence[str]) -> int:
    """Run a command line; return the exit code."""
    try:
        code = cli.main(list(arguments), prog_name="swarmc", standalone_mode=False)
        sys.stdout.flush()
    except click.ClickException as error:
        error.show()
        return error.exit_code
    except (click.Abort, KeyboardInterrupt):
        return INTERRUPTED
    except Exception as error:
        if isinstance(error, OSError) and error.errno in _STDOUT_FAULTS:
            _close_stdout()
            click.echo(f"swarmc: cannot write the output: {error.strerror}", err=True)
            return ERRORS
        import logging

        logging.getLogger(__name__).debug("internal error", exc_info=True)
        click.echo(f"swarmc: internal error: {type(error).__name__}: {error}", err=True)
        click.echo("this is a bug in swarmc; `--debug` shows where", err=True)
        return INTERNAL
    return int(code or OK)


# All other input and output of swarmc turns its errors into diagnostics.
_STDOUT_FAULTS = frozenset({errno.ENOSPC, errno.EIO, errno.EBADF})


def _close_stdout() -> None:
    """Spare the interpreter a second attempt to write what cannot be written."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
