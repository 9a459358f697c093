"""The command line: `swarmc`, one module a command.

What was asked for goes to stdout, all about the run to stderr. Whatever a command needs
is imported when it runs, and the command itself when it is named or `--help` lists it, so
that a small check is quick.
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
from typing import NoReturn

from swarmdsl.cli.exit_code import ERRORS, INTERNAL, INTERRUPTED, TERMINATED

# The names of the commands are those of their modules, and of the functions in them; a keyword of
# Python has a `_` there.
COMMANDS = (
    "add",
    "build",
    "check",
    "codegen",
    "completion",
    "diagram",
    "diff",
    "doc",
    "doctor",
    "explain",
    "fmt",
    "import",
    "lsp",
    "merge",
    "new",
    "preview",
    "rename",
    "simulate",
    "targets",
    "test",
    "trace",
)
# Those whose options are plain data: a command line in the plainest form is read without Click.
PLAIN = ("build", "check")
# As editors start the server.
_SERVER = (["lsp"], ["lsp", "--stdio"])


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
        code = _run_plainly(arguments)
        if code is None:
            from swarmdsl.cli import commands

            code = commands.run(arguments)
        sys.stdout.flush()
    except KeyboardInterrupt:
        sys.stderr.write("\n")
        return INTERRUPTED
    except Exception as error:
        if isinstance(error, OSError) and error.errno in _STDOUT_FAULTS:
            _close_stdout()
            sys.stderr.write(f"swarmc: cannot write the output: {error.strerror}\n")
            return ERRORS
        import logging

        logging.getLogger(__name__).debug("internal error", exc_info=True)
        sys.stderr.write(f"swarmc: internal error: {type(error).__name__}: {error}\n")
        sys.stderr.write("this is a bug in swarmc; `--debug` shows where\n")
        return INTERNAL
    return code


def _run_plainly(arguments: Sequence[str]) -> int | None:
    """Run a command that needs no Click; None where it is needed, for help or for complaints."""
    if list(arguments) in _SERVER:
        from swarmdsl.ide.server.start import serve_on_standard_streams

        return serve_on_standard_streams()
    if not arguments or arguments[0] not in PLAIN:
        return None
    from swarmdsl.base.usage_error import UsageError
    from swarmdsl.cli.parameters import read

    name, *words = arguments
    module = import_module(f"{__name__}.{name}")
    values = read(module.OPTIONS, words)
    if values is None:
        return None
    try:
        code: int = getattr(module, name)(**values)
    except UsageError:  # nothing was done; Click complains, and tells the usage
        return None
    return code


# All other input and output of swarmc turns its errors into diagnostics.
_STDOUT_FAULTS = frozenset({errno.ENOSPC, errno.EIO, errno.EBADF})


def _close_stdout() -> None:
    """Spare the interpreter a second attempt to write what cannot be written."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
