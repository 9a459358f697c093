"""Run cases in this process: `python -m tests.fuzz.worker KIND SEED FIRST COUNT`.

A line of JSON is printed for each case that fails, and one about all at the end. The number of the
case at work goes to standard error, because the process ends when a case hangs in the interpreter
or needs more memory than a case may have.
"""

from __future__ import annotations

import faulthandler
import io
import json
import os
import resource
import shutil
import signal
import sys
import tempfile
import time
from pathlib import Path
from types import FrameType

from swarmdsl.cli import run
from swarmdsl.cli.exit_code import INTERNAL

from .cases import case

HANG = 30
MEMORY = 2**30


class HangError(BaseException):
    """Raised in a case that takes too long; a command catches no such error."""


def _stop(_number: int, _frame: FrameType | None) -> None:
    raise HangError


def ran(words: list[str]) -> tuple[int | str, str]:
    """Run a command line; return the exit code, or what happened, and the output."""
    streams = sys.stdout, sys.stderr, sys.stdin
    said = io.BytesIO()
    with Path(os.devnull).open(encoding="utf-8") as nothing:
        output = io.TextIOWrapper(said, encoding="utf-8", errors="backslashreplace")
        sys.stdout = sys.stderr = output
        sys.stdin = nothing
        result: int | str
        try:
            result = run(words)
        except HangError:
            result = "hang"
        except SystemExit as error:
            result = error.code if error.code is not None else 0
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            output.flush()
            sys.stdout, sys.stderr, sys.stdin = streams
    return result, said.getvalue().decode("utf-8", "replace")


def main(kind: str, seed: int, first: int, count: int) -> None:
    """Run cases, each in a new folder."""
    resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, MEMORY))
    signal.signal(signal.SIGALRM, _stop)
    slowest, codes = 0.0, dict.fromkeys(("0", "1", "2"), 0)
    here = Path.cwd()
    for number in range(first, first + count):
        sys.stderr.write(f"{number}\n")
        sys.stderr.flush()
        with tempfile.TemporaryDirectory(prefix="swarmdsl-fuzz-") as top:
            # Below others, which `..` leads to.
            folder = Path(top, "a", "b", "c")
            folder.mkdir(parents=True)
            chosen = case(kind, seed, number)
            os.chdir(folder)
            chosen.lay_out(folder)
            faulthandler.dump_traceback_later(2 * HANG, exit=True)
            signal.setitimer(signal.ITIMER_REAL, HANG)
            began = time.perf_counter()
            result, said = ran(chosen.words)
            taken = time.perf_counter() - began
            faulthandler.cancel_dump_traceback_later()
            os.chdir(here)
            slowest = max(slowest, taken)
            if result in (INTERNAL, "hang"):
                told = {"number": number, "words": chosen.words, "result": result, "said": said}
                sys.stdout.write(f"{json.dumps(told)}\n")
                sys.stdout.flush()
            codes[str(result)] = codes.get(str(result), 0) + 1
            shutil.rmtree(folder, ignore_errors=True)
    figures = {"cases": count, "slowest": slowest, "memory": _peak(), "codes": codes}
    sys.stdout.write(f"{json.dumps(figures)}\n")


def _peak() -> int:
    """Read the peak of resident memory in bytes (proc(5): VmHWM).

    ``ru_maxrss`` would begin with the memory of the process that started this one.
    """
    for line in Path("/proc/self/status").read_text(encoding="ascii").splitlines():
        if line.startswith("VmHWM:"):
            return int(line.split()[1]) * 1024
    raise RuntimeError("/proc/self/status has no VmHWM")


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:]))
