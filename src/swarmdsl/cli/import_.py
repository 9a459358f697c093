"""`swarmc import`."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from swarmdsl.cli import options
from swarmdsl.cli.suggestions import Group

if TYPE_CHECKING:
    from swarmdsl.importing.command import Format

_FILE = click.Path(path_type=Path)
_files = click.argument("paths", metavar="FILE...", nargs=-1, required=True, type=_FILE)
_output = click.option(
    "-o",
    "--output",
    "out",
    metavar="OUT.swarm",
    type=_FILE,
    help="The output, instead of stdout; an existing model is updated.",
)
_dry_run = click.option(
    "--dry-run",
    is_flag=True,
    help="Show the changes and write nothing; exit with 1 if there are any.",
)
_force = click.option(
    "--force", is_flag=True, help="Also replace state machines and computed values of the model."
)


@click.group(
    "import",
    cls=Group,
    epilog="Example: swarmc import scxml search.xml --adf uav.json -o uav.swarm",
)
@options.debug
def import_() -> None:
    """Import SCXML, ADF and AMF files and ROS packages as models.

    Faults of a file are repaired where possible. Each repair is a warning, and so is everything
    that a model cannot express.
    """


@import_.command(epilog="Example: swarmc import scxml search.xml --adf uav.json -o uav.swarm")
@_files
@click.option(
    "--adf",
    "described",
    multiple=True,
    metavar="FILE",
    type=_FILE,
    help="Description of the functions that are called; may be repeated.",
)
@_output
@_dry_run
@_force
@options.diagnostics_format
@options.debug
def scxml(
    paths: tuple[Path, ...],
    described: tuple[Path, ...],
    out: Path | None,
    dry_run: bool,
    force: bool,
    format_: str,
) -> int:
    """Import state machines: W3C SCXML, or any dialect of the CPSwarm tools."""
    return _run("scxml", paths, described, out, dry_run, force, format_)


@import_.command(epilog="Example: swarmc import adf uav.json -o uav.swarm")
@_files
@_output
@_dry_run
@_force
@options.diagnostics_format
@options.debug
def adf(paths: tuple[Path, ...], out: Path | None, dry_run: bool, force: bool, format_: str) -> int:
    """Import functions: Abstraction Description Files of all generations."""
    return _run("adf", paths, (), out, dry_run, force, format_)


@import_.command(epilog="Example: swarmc import amf coverage.json -o uav.swarm")
@_files
@_output
@_dry_run
@_force
@options.diagnostics_format
@options.debug
def amf(paths: tuple[Path, ...], out: Path | None, dry_run: bool, force: bool, format_: str) -> int:
    """Import behaviours of the swarm library: Algorithm Modelling Files."""
    return _run("amf", paths, (), out, dry_run, force, format_)


@import_.command(epilog="Example: swarmc import ros ~/catkin_ws/src -o uav.swarm")
@click.argument("paths", metavar="FOLDER...", nargs=-1, required=True, type=_FILE)
@_output
@_dry_run
@_force
@options.diagnostics_format
@options.debug
def ros(paths: tuple[Path, ...], out: Path | None, dry_run: bool, force: bool, format_: str) -> int:
    """Import ROS 1 or ROS 2 interfaces and parameters: packages, or folders of packages.

    A FOLDER can be the name of an installed package of ROS 2, whose setup file is sourced.
    """
    return _run("ros", paths, (), out, dry_run, force, format_)


@import_.command(epilog="Example: swarmc import ros2 --from-graph --namespace /uav_0 -o uav.swarm")
@click.option(
    "--from-graph",
    is_flag=True,
    required=True,
    help="Read actions, services and topics of nodes that run now.",
)
@click.option(
    "--namespace",
    metavar="NAME",
    default="/",
    show_default=True,
    help="Only what is in this namespace, with names relative to it.",
)
@click.option(
    "--quiet",
    metavar="SECONDS",
    type=click.FloatRange(0.0, 600.0),
    default=2.0,
    show_default=True,
    help="Stop when nothing new was found for so long.",
)
@_output
@_dry_run
@_force
@options.diagnostics_format
@options.debug
def ros2(
    from_graph: bool,
    namespace: str,
    quiet: float,
    out: Path | None,
    dry_run: bool,
    force: bool,
    format_: str,
) -> int:
    """Import functions and events from a running ROS 2: its servers, and topics with publishers.

    Their interfaces are read from the installed packages.
    """
    return _run("ros2", [Path(namespace)], (), out, dry_run, force, format_, quiet)


def _run(
    kind: Format,
    paths: Sequence[Path],
    described: Sequence[Path],
    out: Path | None,
    dry_run: bool,
    force: bool,
    format_: str,
    quiet: float = 0.0,
) -> int:
    from swarmdsl.base.diagnostics.render import render, summary
    from swarmdsl.base.errors import UsageError
    from swarmdsl.cli.exit_code import ERRORS, exit_code
    from swarmdsl.importing.command import run

    if dry_run and out is None:
        raise click.UsageError("--dry-run shows changes of a file: name it with -o")
    try:
        imported = run(kind, paths, described, out, force=force, dry_run=dry_run, quiet=quiet)
    except UsageError as error:
        raise click.UsageError(str(error)) from error
    render(imported.report, format_, sys.stderr)
    if imported.text is not None and out is None:
        click.echo(imported.text, nl=False)
    elif dry_run or not imported.is_new:
        for layout in imported.layouts:
            click.echo(layout.diff(), nl=False)
    found = f"{imported.files} functions and events were found"
    click.echo(found if kind == "ros2" else summary(imported.report, imported.files), err=True)
    if not imported.report.has_errors and not dry_run and out is not None:
        if imported.is_new:
            click.echo(f"{out} was written", err=True)
        elif not imported.layouts:
            click.echo(f"{out} is up to date", err=True)
    changes = dry_run and any(layout.changed for layout in imported.layouts)
    return exit_code(imported.report) or (ERRORS if changes else 0)
