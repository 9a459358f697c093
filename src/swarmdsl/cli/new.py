"""`swarmc new`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from swarmdsl.cli import options
from swarmdsl.cli.exit_code import exit_code
from swarmdsl.cli.suggestions import Choice
from swarmdsl.tools.scaffold.libraries import LIBRARIES

if TYPE_CHECKING:
    from swarmdsl.tools.scaffold.plan import Plan


class _Target(Choice):
    """A target of projects."""

    def convert(
        self, value: Any, param: click.Parameter | None, context: click.Context | None
    ) -> Any:
        from swarmdsl.codegen.registry import ROS_1, similar_target

        if value in ROS_1:
            self.fail(f"there is no target `{value}`: {similar_target(value)}", param, context)
        return super().convert(value, param, context)


@click.command(epilog="Example: swarmc new rescue --robots turtlebot4")
@click.argument("name", required=False)
@click.option(
    "--folder",
    metavar="FOLDER",
    type=click.Path(path_type=Path),
    help="The folder of the project.  [default: its name]",
)
@click.option("--description", metavar="TEXT", default="", help="Purpose of the project.")
@click.option("--swarm", metavar="NAME", default="", help="Name of the swarm.")
@click.option(
    "--robots",
    "library",
    type=Choice(tuple(LIBRARIES)),
    help="Three robots of this library, instead of types of your own.",
)
@click.option(
    "--member",
    "members",
    metavar="NAME[=NUMBER]",
    multiple=True,
    help="A type of robot and its multiplicity: 3, 1..5, 2..*; may be repeated.  "
    "[default: Robot=3]",
)
@click.option(
    "--sensor",
    metavar="NAME",
    default="Camera",
    show_default=True,
    help="Sensor of the robots.",
)
@click.option(
    "--controller",
    metavar="NAME",
    default="Pilot",
    show_default=True,
    help="Controller of the robots.",
)
@click.option(
    "--actuator",
    metavar="NAME",
    default="Wheels",
    show_default=True,
    help="Actuator of the robots.",
)
@click.option(
    "-t",
    "--target",
    "targets",
    type=_Target(("ros2", "smach")),
    multiple=True,
    help="The target: `smach` for ROS 1 or `ros2` for ROS 2.  [default: ros2]",
)
@click.option("-i", "--interactive", is_flag=True, help="Ask for all of these.")
@click.option("--dry-run", is_flag=True, help="List the files; write nothing.")
@options.diagnostics_format
@options.debug
def new(
    name: str | None,
    folder: Path | None,
    description: str,
    swarm: str,
    library: str | None,
    members: tuple[str, ...],
    sensor: str,
    controller: str,
    actuator: str,
    targets: tuple[str, ...],
    interactive: bool,
    dry_run: bool,
    format_: str,
) -> int:
    """Create a project: a swarm of robots with a sensor, a controller and an actuator.

    It has a behaviour, an environment, a fitness, tests and a scenario, and can be checked,
    simulated, tested and built as it is. With `--robots`, the robots are those of a library, and
    a person can start and abort their mission. Without NAME, a terminal asks for it. A folder
    that is not empty is left alone.
    """
    from swarmdsl.base.diagnostics.render import render
    from swarmdsl.tools.scaffold.new import create
    from swarmdsl.tools.scaffold.plan import Plan, Robots

    if len(set(targets)) > 1:
        way = "build for the other with `swarmc build --target`, to another folder"
        raise click.UsageError(f"a project is for ROS 2 (ros2) or ROS 1 (smach): {way}")
    if library:
        _refuse_types_of_robots()
    robots = [Robots(*each.split("=", 1)) for each in members]
    plan = Plan(
        name or "",
        description,
        swarm,
        tuple(robots) or (Robots("Robot"),),
        sensor,
        controller,
        actuator,
        targets[0] if targets else "ros2",
        library or "",
    )
    if interactive or name is None:
        if not (sys.stdin.isatty() and sys.stderr.isatty()):
            raise click.UsageError("NAME is missing")
        plan = _asked(plan, folder)
    created = create(plan, folder or Path(plan.name), dry_run=dry_run)
    render(created.report, format_, sys.stderr)
    for path in created.written:
        click.echo(path.as_posix())
    if created.written and not dry_run:
        click.echo(f"\nNext: cd {created.folder.as_posix()}, and see README.md", err=True)
    return exit_code(created.report)


def _refuse_types_of_robots() -> None:
    """Refuse options that are about robots which are not those of a library."""
    context = click.get_current_context()
    given = click.core.ParameterSource.COMMANDLINE
    for name in ("members", "sensor", "controller", "actuator"):
        if context.get_parameter_source(name) is given:
            option = f"--{name.removesuffix('s')}"
            raise click.UsageError(f"`--robots` has its own robots and parts, without `{option}`")
    if context.params["targets"] not in ((), ("ros2",)):
        raise click.UsageError("`--robots` is for ROS 2: leave `--target` out")


def _asked(plan: Plan, folder: Path | None) -> Plan:
    from rich.console import Console

    from swarmdsl.tools.scaffold.wizard import ask

    try:
        return ask(plan, Console(stderr=True), folder)
    except EOFError:
        raise click.Abort from None
