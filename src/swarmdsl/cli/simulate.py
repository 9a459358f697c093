"""`swarmc simulate`."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from swarmdsl.base.diagnostics.render import DOCUMENTS, render
from swarmdsl.cli import options, run_options
from swarmdsl.cli.exit_code import ERRORS, INTERRUPTED, OK
from swarmdsl.cli.many_runs import many_of, many_runs
from swarmdsl.cli.suggestions import Choice

if TYPE_CHECKING:
    from swarmdsl.base.diagnostics.collector import Diagnostic
    from swarmdsl.execution.simulate.run.live import Page
    from swarmdsl.ir import System

_NOT_WITH_ROS2 = (
    "machine",
    "events",
    "timeline",
    "replay",
    "stop_on_violation",
    "real_time",
    "picture",
    "play",
)


def _check_alone(many: bool) -> None:
    """Raise UsageError for an option that is not about nodes of ROS 2."""
    given = click.get_current_context().params
    for name in _NOT_WITH_ROS2:
        if given[name]:
            raise click.UsageError(f"`--ros2` and `--{name.replace('_', '-')}` conflict")
    if given["trace"] not in (None, "none"):
        raise click.UsageError("`--ros2` and `--trace` conflict: `--trace-file` has all lines")
    if many:
        raise click.UsageError("`--ros2` and `--runs` conflict")
    if given["world"] == "abstract":
        raise click.UsageError("`--ros2` and `--world abstract` conflict")


@contextmanager
def _opened(port: int, system: System | None, title: str, map_: str | None) -> Iterator[Page]:
    """Serve the page of `--live` while the context lasts."""
    from swarmdsl.ide.preview.editors import detect_editor
    from swarmdsl.ide.preview.live_run import live_page

    def tell(address: str) -> None:
        click.echo(f"open {address} in a browser: the run begins then", err=True)

    with ExitStack() as stack:
        if hasattr(signal, "SIGPIPE"):
            # A page may be closed while it is written to; the run goes on.
            stack.callback(signal.signal, signal.SIGPIPE, signal.getsignal(signal.SIGPIPE))
            signal.signal(signal.SIGPIPE, signal.SIG_IGN)
        try:
            opened = live_page(system, title, map_, port, tell, detect_editor())
            page = stack.enter_context(opened)
        except OSError as error:
            raise click.ClickException(f"port {port}: {error.strerror}") from error
        yield page


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
    help="Events from outside, as JSON lines; `-` for standard input.",
)
@click.option(
    "--scenario",
    type=click.Path(path_type=Path),
    help="Environment of the run, as TOML: outcomes of functions, events from outside, faults.",
)
@click.option(
    "--trace",
    type=Choice(("text", "json", "none")),
    help="Format of the trace.  [default: text; json in a file; none on a terminal, which shows "
    "a table]",
)
@click.option("--trace-file", type=click.Path(path_type=Path), help="Write the trace to a file.")
@click.option(
    "--timeline",
    type=click.Path(path_type=Path),
    help="Draw the states of all robots over time, as SVG.",
)
@click.option(
    "--map",
    "map_file",
    type=click.Path(path_type=Path),
    help="Draw where robots went, what they saw, and who is in reach at the end, as SVG.",
)
@click.option(
    "--animation",
    type=click.Path(path_type=Path),
    help="Draw the run in motion on its map, as SVG, or as a page of HTML that plays it.",
)
@click.option(
    "--picture",
    type=click.Path(path_type=Path),
    help="Draw the robots at the end as MuJoCo sees them, as PNG, with `--world physics`.",
)
@click.option(
    "--play",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Write a page that plays the run, or the traces of `--replay`: see `swarmc play`.",
)
@click.option(
    "--results",
    type=click.Path(path_type=Path),
    help="Write verdicts on properties, measures and fitness to a file, as JSON.",
)
@click.option(
    "--replay",
    type=click.Path(path_type=Path),
    multiple=True,
    help="Compare a recorded trace of robots, JSON lines, with the model; may be repeated.",
)
@run_options.one_seed
@run_options.until_after_events
@click.option(
    "--property",
    "properties",
    metavar="NAME",
    multiple=True,
    help="Run what this property is about, and watch only it; may be repeated.",
)
@click.option(
    "--world",
    type=Choice(("abstract", "flat", "physics")),
    help="Space of the run: none, the plane, or bodies with masses and forces.  [default: the "
    "scenario's, or flat if the model says where something is]",
)
@many_runs
@click.option("--no-properties", is_flag=True, help="Do not watch the properties of the model.")
@click.option("--stop-on-violation", is_flag=True, help="End the run when a property is violated.")
@click.option("--real-time", is_flag=True, help="Run in real time.")
@click.option(
    "--ros2",
    is_flag=True,
    help="Serve the robots of the flat world to nodes of ROS 2, which are their minds.",
)
@click.option(
    "--real-time-factor",
    type=options.Number(0, 1000, min_open=True),
    help="Speed of `--real-time`, `--live` or `--ros2`, if all keep up: 2 is twice as fast.  "
    "[default: 1]",
)
@click.option(
    "--live",
    is_flag=True,
    help="Show the map and the active states on a page in the browser while the run goes on, in "
    "real time; it begins when the page is open.",
)
@click.option(
    "--port",
    type=options.Integer(0, 65535),
    metavar="PORT",
    help="Port of `--live` on the loopback interface; 0 takes a free one.  [default: 0]",
)
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
    map_file: Path | None,
    animation: Path | None,
    picture: Path | None,
    play: Path | None,
    results: Path | None,
    replay: tuple[Path, ...],
    seed: int | None,
    until: int | None,
    properties: tuple[str, ...],
    world: str | None,
    no_properties: bool,
    stop_on_violation: bool,
    real_time: bool,
    ros2: bool,
    real_time_factor: float | None,
    live: bool,
    port: int | None,
    format_: str,
    **many_options: Any,
) -> int:
    """Simulate a swarm or a state machine, in virtual time.

    Each FILE is a model, or an SCXML document; a FOLDER means all .swarm files below it.
    Without a scenario, every function succeeds after a second. The trace goes to standard
    output, a summary to standard error.
    """
    from swarmdsl.execution.simulate.command import simulate as run_simulation
    from swarmdsl.execution.simulate.run.prepare import Request

    if machine is not None and swarm is not None:
        raise click.UsageError("`--machine` and `--swarm` conflict")
    if live and replay:
        raise click.UsageError("`--replay` and `--live` conflict")
    for name, value in (("events", events), ("trace", trace), ("trace-file", trace_file)):
        if replay and value is not None:
            raise click.UsageError(f"`--replay` and `--{name}` conflict")
    if no_properties and properties:
        raise click.UsageError("`--no-properties` and `--property` conflict")
    if no_properties and stop_on_violation:
        raise click.UsageError("`--no-properties` and `--stop-on-violation` conflict")
    if results is not None and len(replay) > 1:
        raise click.UsageError("`--results` has room for one `--replay`")
    if trace == "none" and trace_file is not None:
        raise click.UsageError("`--trace none` and `--trace-file` conflict: omit one of them")
    is_document = format_ in DOCUMENTS
    if is_document and trace in ("text", "json") and trace_file is None:
        raise click.UsageError(
            f"`--format {format_}` and `--trace {trace}` both print: write the "
            "trace to a `--trace-file`"
        )
    many = many_of(**many_options)
    if real_time_factor is not None and not (ros2 or live or real_time):
        raise click.UsageError("`--real-time-factor` needs `--real-time`, `--live` or `--ros2`")
    if port is not None and not live:
        raise click.UsageError("`--port` needs `--live`")
    if ros2:
        _check_alone(many is not None)
    if play is not None and many is not None:
        raise click.UsageError("`--play` and `--runs` conflict: a page plays one run")
    if timeline is not None:
        options.check_picture(timeline, "--timeline", ".svg", {})
        if replay:
            raise click.UsageError("`--replay` and `--timeline` conflict: `--play` writes a page")
    if map_file is not None:
        options.check_picture(map_file, "--map", ".svg", {})
    if animation is not None and animation.suffix.lower() != ".html":
        options.check_picture(animation, "--animation", ".svg", {})
    if picture is not None:
        options.check_picture(picture, "--picture", ".png", {})
    for name, value in (("map", map_file), ("animation", animation), ("picture", picture)):
        if value is not None and (replay or world == "abstract"):
            other = "--replay" if replay else "--world abstract"
            raise click.UsageError(f"`--{name}` and `{other}` conflict")
    given = Path(events) if events not in (None, "-") else None
    outputs = {
        "--trace-file": trace_file,
        "--timeline": timeline,
        "--map": map_file,
        "--animation": animation,
        "--picture": picture,
        "--play": play,
        "--results": results,
        "--histogram": many_options["histogram"],
    }
    options.check_outputs(outputs, (*paths, *replay, scenario, given))
    request = Request(
        paths,
        machine,
        swarm,
        events,
        scenario,
        "none" if is_document and trace_file is None else trace,
        trace_file,
        timeline,
        seed,
        until,
        real_time or live,
        replay,
        not no_properties,
        stop_on_violation,
        properties,
        results,
        world,
        map_file,
        animation,
        picture,
        real_time_factor or 1.0,
        partial(_opened, port or 0) if live else None,
    )
    if ros2:
        from swarmdsl.execution.ros2_world.command import serve

        simulate_: Callable[..., bool | None] = serve
    elif many is None:
        simulate_ = run_simulation
    else:
        from swarmdsl.execution.simulate.many_runs.many import simulate_many

        simulate_ = partial(simulate_many, many)
    if play is not None:
        from swarmdsl.cli.play_pages import simulate_and_play

        simulate_ = partial(simulate_and_play, play)
    if not is_document:
        succeeded = simulate_(request, lambda report: render(report, format_, sys.stderr))
    else:
        found: list[Diagnostic] = []
        succeeded = simulate_(request, found.extend)
        render(found, format_, sys.stdout)
    return INTERRUPTED if succeeded is None else OK if succeeded else ERRORS
