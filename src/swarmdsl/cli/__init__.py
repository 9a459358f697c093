"""The command line: `swarmc`, one module a command.

Results go to stdout, everything about the run to stderr. A command is imported when it is named
or listed by `--help`, and its dependencies when it runs, so that a small check is quick.
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

from swarmdsl.base import interrupts
from swarmdsl.cli.command_names import COMMANDS, PLAIN
from swarmdsl.cli.exit_code import ERRORS, INTERNAL, INTERRUPTED, TERMINATED

__all__ = ["COMMANDS", "PLAIN", "main", "run"]

# Arguments with which editors start the server and the debug adapter.
_SERVER = (["lsp"], ["lsp", "--stdio"])
_DEBUGGER = (["debug"], ["debug", "--stdio"])


def main() -> None:
    """Run `swarmc` in its own process."""
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:  # closed by the caller; no other file takes its place
            nowhere = os.open(os.devnull, os.O_WRONLY)
            setattr(sys, name, os.fdopen(nowhere, "w", encoding="utf-8"))
    for stream in (sys.stdout, sys.stderr):
        # Names may have characters that the terminal's encoding lacks.
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    if hasattr(signal, "SIGPIPE"):
        # `swarmc targets | head -1` ends quietly, as other programs do.
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    # As exceptions, so that temporary files are removed.
    interrupts.install(signal.SIGTERM, SystemExit(TERMINATED))
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:  # not ignored, as in `nohup`
        interrupts.install(signal.SIGINT, KeyboardInterrupt())
    # A compiler keeps its data until it ends: garbage collection costs a tenth of the time.
    # Commands that run for long turn it on.
    gc.disable()
    _leave(run(sys.argv[1:]))


def _leave(code: int) -> NoReturn:
    """End the process at once: freeing all memory takes as long as resolving names."""
    atexit._run_exitfuncs()
    try:
        sys.stdout.flush()
        sys.stderr.flush()
    except (OSError, ValueError):  # the interpreter reports it
        sys.exit(code)
    os._exit(code)


def run(arguments: Sequence[str]) -> int:
    """Run a command line; return the exit code."""
    try:
        try:
            code = _run_plainly(arguments)
            if code is None:
                from swarmdsl.cli import commands

                code = commands.run(arguments)
            sys.stdout.flush()
        except Exception:
            interrupts.raise_lost()  # an import may fail with another error then
            raise
    except KeyboardInterrupt:
        sys.stderr.write("\n")
        return INTERRUPTED
    except Exception as error:
        if isinstance(error, OSError) and error.errno in _STDOUT_FAULTS and not error.filename:
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
    """Run a command without Click; None where Click is needed, for help or for errors."""
    if list(arguments) in _SERVER:
        from swarmdsl.ide.server.start import serve_on_standard_streams

        return serve_on_standard_streams()
    if list(arguments) in _DEBUGGER:
        from swarmdsl.ide.debugger.start import serve
        from swarmdsl.ide.server.start import standard_streams

        return serve(*standard_streams())
    if not arguments or arguments[0] not in PLAIN:
        return None
    from swarmdsl.base.errors import UsageError
    from swarmdsl.cli.parameters import read

    name, *words = arguments
    module = import_module(f"{__name__}.{name}")
    values = read(module.OPTIONS, words)
    if values is None:
        return None
    try:
        code: int = getattr(module, name)(**values)
    except UsageError:  # nothing was done; Click reports it with the usage
        return None
    return code


# Errors of all other input and output are diagnostics.
_STDOUT_FAULTS = frozenset({errno.ENOSPC, errno.EIO, errno.EBADF, errno.EFBIG, errno.EDQUOT})


def _close_stdout() -> None:
    """Keep the interpreter from writing to stdout again when it exits."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
