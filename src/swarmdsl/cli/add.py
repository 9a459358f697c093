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
_doc = click.option("--doc", metavar="TEXT", default="", help="Its documentation.")
_file = click.option(
    "--file",
    "file",
    metavar="FILE",
    type=_FILE,
    help="The file to add it to.  [default: where it fits best]",
)
_param = click.option(
    "--param",
    "params",
    metavar="NAME:TYPE[=VALUE]",
    multiple=True,
    help="A param; may be repeated.",
)
_in = click.option(
    "--in",
    "incoming",
    metavar="NAME:TYPE[@TOPIC]",
    multiple=True,
    help="An input port; may be repeated.",
)
_out = click.option(
    "--out",
    "outgoing",
    metavar="NAME:TYPE[@TOPIC]",
    multiple=True,
    help="An output port; may be repeated.",
)
_inout = click.option(
    "--inout",
    "both",
    metavar="NAME:TYPE[@TOPIC]",
    multiple=True,
    help="A port for both directions; may be repeated.",
)
_extends = click.option(
    "--extends", metavar="NAME", default="", help="The declaration that it inherits from."
)
_behavior = click.option(
    "--behavior",
    metavar="MACHINE",
    default="",
    help="The state machine that it runs; added if it does not exist.",
)


def _common(command: Callable[..., Any]) -> Callable[..., Any]:
    for each in (
        options.debug,
        options.diagnostics_format,
        click.option("--dry-run", is_flag=True, help="Show the changes; write nothing."),
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
    """Add an element to a model, where it belongs in its files.

    Everything else stays as it is, byte for byte. An element that would be an error is
    reported, and not added.
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
    help="Its kind.",
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
    help="An operation that others can call; may be repeated.",
)
@_behavior
@click.option("--to", metavar="MEMBER[.PART]", default="", help="Make it a part of this member.")
@_doc
@_file
@_common
def component(**given: Any) -> int:
    """Add a sensor, actuator, controller or virtual component."""
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
    help="A part; may be repeated.",
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
@click.option("--to", metavar="SWARM[=NUMBER]", default="", help="Make it a role of this swarm.")
@_doc
@_file
@_common
def member(**given: Any) -> int:
    """Add a type of robot."""
    return _run("member", given)


@add.command(epilog="Example: swarmc add function land --service cmd/land:std_srvs/Empty")
@_name
@click.option(
    "--category",
    type=Choice(("abstraction", "swarm")),
    default="abstraction",
    show_default=True,
    help="Subject of the function: the robot, or the swarm.",
)
@click.option("--action", metavar="SERVER:TYPE", help="The action that calls it.")
@click.option("--service", metavar="SERVER:TYPE", help="The service that calls it.")
@click.option(
    "--in",
    "incoming",
    metavar="TOPIC:TYPE",
    multiple=True,
    help="A topic that it subscribes to; may be repeated.",
)
@click.option(
    "--out",
    "outgoing",
    metavar="TOPIC:TYPE",
    multiple=True,
    help="A topic that it publishes on; may be repeated.",
)
@_param
@_doc
@_file
@_common
def function(**given: Any) -> int:
    """Add a function: something that a robot can do."""
    return _run("function", given)


@add.command(
    epilog="Example: swarmc add event TargetFound cpswarm_msgs/TargetPositionEvent --swarm"
)
@_name
@click.argument("type_", metavar="TYPE")
@click.option("--swarm", is_flag=True, help="An event between members of the swarm.")
@click.option("--operator", is_flag=True, help="An event that a person may send to the swarm.")
@click.option("--on", "topic", metavar="TOPIC", default="", help="Its topic.")
@_doc
@_file
@_common
def event(**given: Any) -> int:
    """Add an event that state machines react to."""
    return _run("event", given)


@add.command(epilog="Example: swarmc add swarm Fleet --member Uav=3 --member base:Rover")
@_name
@click.option(
    "--member",
    "members",
    metavar="[ROLE:]MEMBER[=NUMBER]",
    multiple=True,
    required=True,
    help="A member with its multiplicity: `Uav`, `scout:Uav=2..4`; may be repeated.",
)
@click.option("--environment", metavar="NAME", default="", help="Its environment.")
@click.option("--fitness", metavar="NAME", default="", help="Its fitness.")
@_doc
@_file
@_common
def swarm(**given: Any) -> int:
    """Add a swarm: robots that work together."""
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
    help="Its activity: `land`, `climb(height = 2.0)`.",
)
@click.option(
    "--runs", metavar="MACHINE[(...)]", default="", help="The state machine that it reuses."
)
@click.option(
    "--on",
    "transitions",
    metavar='"TRIGGER -> STATE"',
    multiple=True,
    help="A transition: `MissionAbort -> Home`, `succeeded, aborted -> Done`.",
)
@click.option(
    "--after",
    "delays",
    metavar='"DELAY -> STATE"',
    multiple=True,
    help="A transition after a delay: `5 s -> Idle`.",
)
@click.option(
    "--from",
    "ways_in",
    metavar='"STATE: TRIGGER"',
    multiple=True,
    help="A transition to it: `Idle: MissionStart`, `Busy: after 5 s`.",
)
@click.option("--final", is_flag=True, help="Make it a final state.")
@_doc
@_common
def state(**given: Any) -> int:
    """Add a state to a state machine, a region or another state."""
    return _run("state", given)


def _run(kind: str, given: dict[str, Any]) -> int:
    from swarmdsl.base.diagnostics.render import render
    from swarmdsl.base.errors import UsageError
    from swarmdsl.cli.exit_code import exit_code
    from swarmdsl.tools.refactor.add import add as added
    from swarmdsl.tools.refactor.new_elements import CREATORS

    try:
        places = CREATORS[kind](given)
    except UsageError as error:
        raise click.UsageError(str(error)) from error
    done = added(given["paths"], places, given_file=given.get("file"), dry_run=given["dry_run"])
    render(done.report, given["format_"], sys.stderr)
    for layout in done.layouts:
        click.echo(layout.diff() if given["dry_run"] else layout.name, nl=not given["dry_run"])
    if done.report.has_errors:
        click.echo("nothing was added", err=True)
    return exit_code(done.report)
