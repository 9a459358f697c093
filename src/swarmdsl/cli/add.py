"""`swarmc add`."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from swarmdsl.cli import options
from swarmdsl.cli.suggestions import Choice, Group

_FILE = click.Path(path_type=Path)
_name = click.argument("name")
_doc = click.option("--doc", metavar="TEXT", default="", help="What it is: its documentation.")
_file = click.option(
    "--file",
    "file",
    metavar="FILE",
    type=_FILE,
    help="Where it goes.  [default: where it fits best]",
)
_param = click.option(
    "--param",
    "params",
    metavar="NAME:TYPE[=VALUE]",
    multiple=True,
    help="A param of it; may be repeated.",
)
_in = click.option(
    "--in",
    "incoming",
    metavar="NAME:TYPE[@TOPIC]",
    multiple=True,
    help="A port that it listens to; may be repeated.",
)
_out = click.option(
    "--out",
    "outgoing",
    metavar="NAME:TYPE[@TOPIC]",
    multiple=True,
    help="A port that it sends on; may be repeated.",
)
_inout = click.option(
    "--inout",
    "both",
    metavar="NAME:TYPE[@TOPIC]",
    multiple=True,
    help="A port for both; may be repeated.",
)
_extends = click.option("--extends", metavar="NAME", default="", help="What it has all of.")
_behavior = click.option(
    "--behavior",
    metavar="MACHINE",
    default="",
    help="The state machine that it runs; made if there is none of this name.",
)


def _common(command: Callable[..., Any]) -> Callable[..., Any]:
    for each in (
        options.debug,
        options.diagnostics_format,
        click.option("--dry-run", is_flag=True, help="Show what would change, write nothing."),
        click.option(
            "--model",
            "paths",
            metavar="FILE|FOLDER",
            type=_FILE,
            multiple=True,
            help="The model.  [default: that of swarm.toml, or the current folder]",
        ),
    ):
        command = each(command)
    return command


@click.group(
    "add",
    cls=Group,
    epilog="Example: swarmc add event BatteryLow sensor_msgs/BatteryState --on battery",
)
@options.debug
def add() -> None:
    """Add something to a model, where it belongs in its files.

    All that is there stays as it is, byte for byte. What would be a mistake is told, and
    not added.
    """


@add.command(
    epilog="Example: swarmc add component Sonar --out range:sensor_msgs/Range --to Uav.front"
)
@_name
@click.option(
    "--kind",
    type=Choice(("sensor", "actuator", "controller", "virtual")),
    default="sensor",
    show_default=True,
    help="What it is.",
)
@_extends
@_in
@_out
@_inout
@_param
@click.option(
    "--operation",
    "operations",
    metavar="NAME(in|out PARAMETER:TYPE, ...)",
    multiple=True,
    help="What others can ask it to do; may be repeated.",
)
@_behavior
@click.option(
    "--to", metavar="MEMBER[.PART]", default="", help="Make it a part of this member too."
)
@_doc
@_file
@_common
def component(**given: Any) -> int:
    """A sensor, actuator, controller or virtual component."""
    return _run("component", given)


@add.command(epilog="Example: swarmc add member Rover --part wheels:Wheels --to Rescue=1..5")
@_name
@_extends
@_behavior
@click.option(
    "--part",
    "parts",
    metavar="NAME:COMPONENT",
    multiple=True,
    help="What it is made of; may be repeated.",
)
@click.option(
    "--connect",
    "connectors",
    metavar="PART.PORT->PART.PORT",
    multiple=True,
    help="A connector between parts; may be repeated.",
)
@_in
@_out
@_inout
@_param
@click.option(
    "--to", metavar="SWARM[=NUMBER]", default="", help="Make it a role of this swarm too."
)
@_doc
@_file
@_common
def member(**given: Any) -> int:
    """A type of robot."""
    return _run("member", given)


@add.command(epilog="Example: swarmc add function land --service cmd/land:std_srvs/Empty")
@_name
@click.option(
    "--category",
    type=Choice(("abstraction", "swarm")),
    default="abstraction",
    show_default=True,
    help="What it is about: the robot, or the swarm.",
)
@click.option("--action", metavar="SERVER:TYPE", help="It is called as this action.")
@click.option("--service", metavar="SERVER:TYPE", help="It is called as this service.")
@click.option(
    "--in",
    "incoming",
    metavar="TOPIC:TYPE",
    multiple=True,
    help="A topic that it listens to; may be repeated.",
)
@click.option(
    "--out",
    "outgoing",
    metavar="TOPIC:TYPE",
    multiple=True,
    help="A topic that it sends on; may be repeated.",
)
@_param
@_doc
@_file
@_common
def function(**given: Any) -> int:
    """Something that a robot can do."""
    return _run("function", given)


@add.command(
    epilog="Example: swarmc add event TargetFound cpswarm_msgs/TargetPositionEvent --swarm"
)
@_name
@click.argument("type_", metavar="TYPE")
@click.option("--swarm", is_flag=True, help="It travels between the members of the swarm.")
@click.option("--on", "topic", metavar="TOPIC", default="", help="The topic of it.")
@_doc
@_file
@_common
def event(**given: Any) -> int:
    """Something that state machines react to."""
    return _run("event", given)


@add.command(epilog="Example: swarmc add swarm Fleet --member Uav=3 --member base:Rover")
@_name
@click.option(
    "--member",
    "members",
    metavar="[ROLE:]MEMBER[=NUMBER]",
    multiple=True,
    required=True,
    help="Robots of it, and how many: `Uav`, `scout:Uav=2..4`; may be repeated.",
)
@click.option("--environment", metavar="NAME", default="", help="Where it is.")
@click.option("--fitness", metavar="NAME", default="", help="What makes it a good one.")
@_doc
@_file
@_common
def swarm(**given: Any) -> int:
    """Robots that work together."""
    return _run("swarm", given)


@add.command(
    epilog='Example: swarmc add state Search.Wait --do land --on "succeeded, aborted -> Done"'
)
@click.argument("name", metavar="MACHINE.[STATE.]NAME")
@click.option(
    "--do",
    "activity",
    metavar="CALL",
    default="",
    help="What it does: `land`, `climb(height = 2.0)`.",
)
@click.option("--runs", metavar="MACHINE[(...)]", default="", help="The machine that it reuses.")
@click.option(
    "--on",
    "transitions",
    metavar='"TRIGGER -> STATE"',
    multiple=True,
    help="A way out of it: `MissionAbort -> Home`, `succeeded, aborted -> Done`.",
)
@click.option(
    "--after",
    "delays",
    metavar='"DELAY -> STATE"',
    multiple=True,
    help="A way out of it when time is over: `5 s -> Idle`.",
)
@click.option(
    "--from",
    "ways_in",
    metavar='"STATE: TRIGGER"',
    multiple=True,
    help="A way that leads to it: `Idle: MissionStart`, `Busy: after 5 s`.",
)
@click.option("--final", is_flag=True, help="It is an end.")
@_doc
@_common
def state(**given: Any) -> int:
    """A state of a state machine, of a region or of another state."""
    return _run("state", given)


def _run(kind: str, given: dict[str, Any]) -> int:
    from swarmdsl.base.diagnostics.render import render
    from swarmdsl.base.usage_error import UsageError
    from swarmdsl.cli.exit_code import exit_code
    from swarmdsl.tools.refactor.add import add as added
    from swarmdsl.tools.refactor.new_elements import THINGS

    try:
        places = THINGS[kind](given)
    except UsageError as error:
        raise click.UsageError(str(error)) from error
    done = added(given["paths"], places, dry_run=given["dry_run"])
    render(done.report, given["format_"], sys.stderr)
    for layout in done.layouts:
        click.echo(layout.diff() if given["dry_run"] else layout.name, nl=not given["dry_run"])
    if done.report.has_errors:
        click.echo("nothing is added", err=True)
    return exit_code(done.report)
