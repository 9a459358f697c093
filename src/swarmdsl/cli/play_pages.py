"""Pages of runs that other commands write: `--play`."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import redirect_stderr
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING

import click

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.diagnostics.render import render
from swarmdsl.base.records import replace

if TYPE_CHECKING:
    from swarmdsl.execution.simulate.run.prepare import Request
    from swarmdsl.execution.testing.verdict import Verdict
    from swarmdsl.execution.verify.command import Request as VerifyRequest

Tell = Callable[[Diagnostics], None]


def simulate_and_play(out: Path, request: Request, tell: Tell) -> bool | None:
    """Simulate a run or replay traces, and write the page that plays them."""
    from swarmdsl.execution.simulate.command import simulate as run_simulation
    from swarmdsl.tools.player.command import play_traces, recorded

    if request.replay:
        succeeded = run_simulation(request, tell)
        # What is wrong with the traces has been told.
        played = play_traces(request, request.replay, out, lambda report: None)
        succeeded = succeeded and played.written is not None
    else:
        played = recorded(
            lambda keep, recorder: run_simulation(replace(request, recorder=recorder), keep),
            out,
            tell,
        )
        succeeded = played.succeeded
    if played.written is not None:
        click.echo(played.written.as_posix(), err=True)
    return succeeded


def play_counterexample(
    request: VerifyRequest, shown: Sequence[tuple[str, str]], out: Path
) -> bool:
    """Write the page of a run, of a property if there is one; return False if that fails."""
    from swarmdsl.execution.simulate.run import prepare
    from swarmdsl.tools.player.command import play_lines

    if not shown:
        return True
    # Runs to other findings come first, and have names such as `stuck-Wait`.
    name, trace = min(shown, key=lambda each: "-" in each[0])
    of = prepare.Request(request.paths, request.machine, request.swarm, only=request.properties)
    played = play_lines(of, name, trace, out, lambda each: render(each, "text", sys.stderr))
    if played.written is None:
        return False
    click.echo(f"{name}: {played.written.as_posix()}", err=True)
    return True


def play_runs(runs: Sequence[tuple[Request, Path]], report: Diagnostics) -> Iterator[Path]:
    """Write the pages of simulations whose results are known; yield those that are written."""
    from swarmdsl.tools.player.command import play_run

    for request, out in runs:
        told = Diagnostics()
        with redirect_stderr(StringIO()):  # a summary
            played = play_run(request, out, told.include)
        report.include(each for each in told if each.name == "cannot-write")
        if played.written is not None:
            yield out


def play_verdict(verdict: Verdict, out: Path) -> None:
    """Write the page of a test, whose failure has been told."""
    from swarmdsl.tools.player.command import play_test

    report = Diagnostics()
    played = play_test(verdict, out, report.include)
    if played.written is not None:
        click.echo(f"{verdict.case.name}: {played.written.as_posix()}", err=True)
        return
    render([each for each in report if each.name == "cannot-write"], "text", sys.stderr)
