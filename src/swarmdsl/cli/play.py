"""`swarmc play`."""

from __future__ import annotations

import sys
from collections.abc import Collection
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

import click
from click.core import ParameterSource

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.diagnostics.render import DOCUMENTS, render
from swarmdsl.cli import options, run_options
from swarmdsl.cli.exit_code import ERRORS, INTERRUPTED, OK

if TYPE_CHECKING:
    from swarmdsl.base.diagnostics.collector import Diagnostic
    from swarmdsl.execution.simulate.run.prepare import Request


@click.command(
    epilog="Example: swarmc play examples/search_and_rescue "
    "--scenario examples/search_and_rescue/mission.toml -o mission.html"
)
@options.files
@click.option("--machine", metavar="NAME", help="Play this state machine alone.")
@click.option("--swarm", metavar="NAME", help="Play this swarm.")
@click.option(
    "--trace",
    "traces",
    type=click.Path(path_type=Path),
    multiple=True,
    help="Play a recorded trace of robots or of a simulation, JSON lines, instead of a new run; "
    "may be repeated.",
)
@click.option(
    "--counterexample",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Play a run that `swarmc verify -o` has written.",
)
@click.option(
    "--compare",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Compare with the trace of another run, JSON lines, from the first difference on.",
)
@click.option(
    "--follow",
    metavar="TRACE",
    help="Serve the page of this trace of JSON lines while it is written, instead of a file; `-` "
    "for standard input.",
)
@click.option(
    "--port",
    type=options.Integer(0, 65535),
    default=0,
    metavar="PORT",
    help="Port of `--follow` on the loopback interface; 0 takes a free one.  [default: 0]",
)
@click.option("--open", "opens", is_flag=True, help="Open the page of `--follow` in the browser.")
@click.option(
    "--scenario",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Environment of the run, as for `swarmc simulate`.",
)
@click.option(
    "--events",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Events from outside, as JSON lines.",
)
@run_options.one_seed
@run_options.until_after_events
@click.option(
    "-o",
    "--output",
    "out",
    metavar="FILE",
    type=click.Path(path_type=Path),
    default=Path("run.html"),
    show_default=True,
    help="The page.",
)
@options.diagnostics_format
@options.debug
def play(
    paths: tuple[Path, ...],
    machine: str | None,
    swarm: str | None,
    traces: tuple[Path, ...],
    counterexample: Path | None,
    compare: Path | None,
    follow: str | None,
    port: int,
    opens: bool,
    scenario: Path | None,
    events: Path | None,
    seed: int | None,
    until: int | None,
    out: Path,
    format_: str,
) -> int:
    """Write a page that plays a run.

    Each FILE is a model, or an SCXML document; a FOLDER means all .swarm files below it. The page
    is one file that needs no network: lanes of all members, step by step forwards and back. It
    shows a new simulation, or recorded traces; what is wrong with these is told in it. With
    `--follow`, it grows with a trace until Ctrl-C.
    """
    from swarmdsl.execution.simulate.run import prepare
    from swarmdsl.tools.player.command import play_run, play_traces, read_other

    if machine is not None and swarm is not None:
        raise click.UsageError("`--machine` and `--swarm` conflict")
    recorded = (*traces, *((counterexample,) if counterexample is not None else ()))
    for name, value in (("events", events), ("seed", seed), ("until", until)):
        if recorded and value is not None:
            given = "--trace" if traces else "--counterexample"
            raise click.UsageError(f"`{given}` and `--{name}` conflict")
    if follow is not None:
        _check_alone(("port", "follow", "opens", "paths", "machine", "swarm", "scenario"))
        request = prepare.Request(paths, machine=machine, swarm=swarm, scenario=scenario)
        return _follow(request, follow, port, opens)
    for name, is_given in (("port", port), ("open", opens)):
        if is_given:
            raise click.UsageError(f"`--{name}` needs `--follow`")
    options.check_outputs({"-o": out}, (*paths, *recorded, compare, scenario, events))
    found: list[Diagnostic] = []

    def tell(report: Diagnostics) -> None:
        if format_ in DOCUMENTS:
            found.extend(report)
        else:
            render(report, format_, sys.stderr)

    request = prepare.Request(
        paths,
        machine=machine,
        swarm=swarm,
        events=str(events) if events is not None else None,
        scenario=scenario,
        seed=seed,
        until=until,
    )
    other = read_other(request, compare, tell) if compare is not None else None
    if recorded:
        played = play_traces(request, recorded, out, tell, other)
    else:
        played = play_run(request, out, tell, other)
    unread = compare is not None and other is None
    if format_ in DOCUMENTS:
        render(found, format_, sys.stdout)
    if played.written is not None:
        click.echo(played.written.as_posix(), err=True)
    return (
        INTERRUPTED
        if played.succeeded is None
        else OK
        if played.succeeded and not unread
        else ERRORS
    )


def _check_alone(taken: Collection[str]) -> None:
    """Raise UsageError if there are options that say something else than to follow a trace."""
    context = click.get_current_context()
    for each in context.command.params:
        name = each.name or ""
        is_given = context.get_parameter_source(name) is ParameterSource.COMMANDLINE
        if is_given and name not in (*taken, "debug"):
            raise click.UsageError(f"`--follow` and `{each.opts[0]}` conflict")


def _follow(request: Request, trace: str, port: int, opens: bool) -> int:
    """Serve the page of a trace until the user ends it."""
    from swarmdsl.base.forced_end import forced_end
    from swarmdsl.cli import served_page
    from swarmdsl.ide.preview.live_player import playing

    served_page.run_for_hours()
    prepared, failed = served_page.prepared_to_grow(request, Path(trace))
    if failed:
        return ERRORS
    with ExitStack() as stack:
        stack.enter_context(forced_end())
        page = playing(prepared, trace, port, served_page.tell)
        served_page.opened(page, f"port {port}", opens, stack)
        try:
            served_page.wait_for_interrupt()
        except KeyboardInterrupt:
            click.echo(err=True)
    return OK
