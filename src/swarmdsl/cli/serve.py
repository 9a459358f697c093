"""`swarmc serve`."""

from __future__ import annotations

import os
import re
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from swarmdsl.base.diagnostics.render import render
from swarmdsl.base.read_files import lines_of
from swarmdsl.cli import options, run_options
from swarmdsl.cli.engine_options import check_processes, processes
from swarmdsl.cli.exit_code import ERRORS, OK

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from swarmdsl.base.diagnostics.collector import Diagnostics
    from swarmdsl.execution.experiments.search.evaluation import Together
    from swarmdsl.execution.experiments.serving.command import Answers
    from swarmdsl.execution.experiments.serving.xmpp import Account

_MOST_SEEDS = 100_000
_CHUNK = 1 << 16
_PASSWORD = "SWARMDSL_XMPP_PASSWORD"
_ADDRESS = re.compile(r"[^@:/\s]+@[^@:/\s]+(:[0-9]{1,5})?")


@click.command(
    epilog="Example: swarmc serve examples/storage --scenario examples/storage/shift.toml --seeds 5"
)
@options.files
@run_options.candidates
@click.option(
    "--seeds",
    type=options.Integer(1, _MOST_SEEDS),
    metavar="N",
    default=1,
    show_default=True,
    help="Runs of a candidate, from the seed of its message on; the answer is their mean.",
)
@click.option(
    "--xmpp",
    metavar="ACCOUNT",
    help="Take messages by XMPP, as `manager1@example.org` or with a port behind `:`; the password "
    "is in the environment: SWARMDSL_XMPP_PASSWORD.",
)
@processes
@options.debug
def serve(
    paths: tuple[Path, ...],
    swarm: str | None,
    scenarios: tuple[Path, ...],
    together: Together,
    properties: tuple[str, ...],
    seeds: int,
    until: int | None,
    world: str | None,
    limit: float | None,
    xmpp: str | None,
    jobs: int | None,
    cluster: str | None,
) -> int:
    """Run candidates for another optimizer, as a simulation manager of CPSwarm does.

    Each line of standard input is a message `RunSimulation` of CPSwarm, and is answered on
    standard output with a line `SimulationResult`, which has the fitness. It ends with its input.
    """
    from swarmdsl.execution.experiments.serving.command import Request
    from swarmdsl.execution.experiments.serving.command import serve as answer_lines

    check_processes(jobs, cluster)
    run_options.check_scenarios(scenarios)
    request = Request(
        paths,
        swarm,
        scenarios,
        together,
        properties,
        seeds,
        until,
        world,
        limit,
        jobs or 1,
        cluster,
    )
    lines: Iterable[str]
    out: Answers = sys.stdout
    if xmpp is None:
        if sys.stdin is None:
            raise click.UsageError("standard input is closed: messages come from there")
        lines = _lines()
    else:
        account = _account(xmpp)
        if account is None:
            return ERRORS
        lines, out = account.lines(), account
    return OK if answer_lines(request, lines, out, _tell) else ERRORS


def _lines() -> Iterator[str]:
    """Yield the lines of standard input as they arrive."""
    stdin: Any = sys.stdin.buffer
    for lines in lines_of(lambda: stdin.read1(_CHUNK)):
        for line in lines:
            yield line.decode("utf-8", errors="replace")


def _tell(report: Diagnostics) -> None:
    render(report, "text", sys.stderr)


def _account(address: str) -> Account | None:
    """Return the account with an address; None if there is nothing to connect with."""
    password = os.environ.get(_PASSWORD, "")
    if _ADDRESS.fullmatch(address) is None:
        message = f"`{address}` is no account like `manager1@example.org`"
        raise click.BadParameter(message, param_hint="'--xmpp'")
    if not password:
        raise click.UsageError(f"`--xmpp` needs the password in {_PASSWORD}")
    if find_spec("slixmpp") is None:
        from swarmdsl.base.diagnostics.collector import Diagnostics

        report = Diagnostics()
        help_ = "`pip install 'swarmdsl[xmpp]'` installs it; without `--xmpp` nothing is needed"
        report.report("missing-package", what="--xmpp", package="slixmpp", help=help_)
        _tell(report)
        return None
    from swarmdsl.execution.experiments.serving.xmpp import Account

    return Account(address, password)
