"""`swarmc simulate`."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from swarmdsl.base.diagnostics.render import render
from swarmdsl.cli import options
from swarmdsl.cli.exit_code import ERRORS, INTERRUPTED, OK
from swarmdsl.cli.suggestions import Choice


def _duration(_context: click.Context, _param: click.Parameter, text: str | None) -> int | None:
    """A length of time with its unit, in nanoseconds."""
    from swarmdsl.execution.simulate.durations import duration

    length = duration(text) if text is not None else None
    if text is not None and length is None:
        raise click.BadParameter(f"`{text}` is no time like `90s`, `500ms` or `10min`")
    return length


@click.command(
    epilog="Example: swarmc simulate examples/search_and_rescue "
    "--scenario examples/search_and_rescue/mission.toml --timeline mission.svg"
)
@options.files
@click.option("--machine", metavar="NAME", help="Run this state machine alone.")
@click.option("--swarm", metavar="NAME", help="Run this swarm.")
@click.option(
    "--events",
    metavar="FILE",
    help="Events from outside, a line of JSON each; `-` for standard input.",
)
@click.option(
    "--scenario",
    type=click.Path(path_type=Path),
    help="What happens around the swarm, as TOML: how functions end, what is heard, what breaks.",
)
@click.option(
    "--trace",
    type=Choice(("text", "json", "none")),
    help="How it is told what happens.  [default: text; json in a file; none on a terminal, "
    "which shows a table]",
)
@click.option("--trace-file", type=click.Path(path_type=Path), help="Write that to a file.")
@click.option("--timeline", type=click.Path(path_type=Path), help="Draw who was where, as SVG.")
@click.option(
    "--replay",
    type=click.Path(path_type=Path),
    multiple=True,
    help="Hold a trace of robots, lines of JSON, against the model, and say where they left it; "
    "once for each trace.",
)
@click.option("--seed", type=int, help="Another course of chance.  [default: the scenario's, or 0]")
@click.option(
    "--until",
    metavar="DURATION",
    callback=_duration,
    help="End it after so much virtual time.  [default: the scenario's, or 10min after the last "
    "of `--events`]",
)
@click.option("--real-time", is_flag=True, help="Let time pass as slowly as it does.")
@options.diagnostics_format
@options.debug
def simulate(
    paths: tuple[Path, ...],
    machine: str | None,
    swarm: str | None,
    events: str | None,
    scenario: Path | None,
    trace: str | None,
    trace_file: Path | None,
    timeline: Path | None,
    replay: tuple[Path, ...],
    seed: int | None,
    until: int | None,
    real_time: bool,
    format_: str,
) -> int:
    """Run a swarm or a state machine without a robot, in virtual time.

    Each FILE is a model, or an SCXML document; a FOLDER stands for all .swarm files below it.
    Without a scenario, every function succeeds after a second. What happens goes to standard
    output, a summary to standard error.
    """
    from swarmdsl.execution.simulate.command import Request
    from swarmdsl.execution.simulate.command import simulate as simulate_

    if machine is not None and swarm is not None:
        raise click.UsageError("`--machine` and `--swarm` are not given together")
    for name, value in (("events", events), ("trace", trace), ("trace-file", trace_file)):
        if replay and value is not None:
            raise click.UsageError(f"`--replay` and `--{name}` are not given together")
    if timeline is not None:
        options.check_picture(timeline, "--timeline", ".svg", {})
    request = Request(
        paths,
        machine,
        swarm,
        events,
        scenario,
        trace,
        trace_file,
        timeline,
        seed,
        until,
        real_time,
        replay,
    )
    well = simulate_(request, lambda report: render(report, format_, sys.stderr))
    return INTERRUPTED if well is None else OK if well else ERRORS
