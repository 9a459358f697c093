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
    help="Write there, not to stdout; a model that is there is updated.",
)
_dry_run = click.option(
    "--dry-run", is_flag=True, help="Show what would change, write nothing; exit with 1 if it does."
)
_force = click.option(
    "--force", is_flag=True, help="Replace state machines and computed values in the model too."
)


@click.group(
    "import",
    cls=Group,
    epilog="Example: swarmc import scxml search.xml --adf uav.json -o uav.swarm",
)
@options.debug
def import_() -> None:
    """Make models of SCXML, ADF and AMF files and of ROS packages.

    What is wrong with a file is repaired where possible; each repair, and all that a model
    cannot say, is a warning.
    """


@import_.command(epilog="Example: swarmc import scxml search.xml --adf uav.json -o uav.swarm")
@_files
@click.option(
    "--adf",
    "described",
    multiple=True,
    metavar="FILE",
    type=_FILE,
    help="Describes the functions that are called; may be repeated.",
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
    """State machines: SCXML as the CPSwarm tools wrote and write it, or that of W3C."""
    return _run("scxml", paths, described, out, dry_run, force, format_)


@import_.command(epilog="Example: swarmc import adf uav.json -o uav.swarm")
@_files
@_output
@_dry_run
@_force
@options.diagnostics_format
@options.debug
def adf(paths: tuple[Path, ...], out: Path | None, dry_run: bool, force: bool, format_: str) -> int:
    """Functions: Abstraction Description Files of all generations."""
    return _run("adf", paths, (), out, dry_run, force, format_)


@import_.command(epilog="Example: swarmc import amf coverage.json -o uav.swarm")
@_files
@_output
@_dry_run
@_force
@options.diagnostics_format
@options.debug
def amf(paths: tuple[Path, ...], out: Path | None, dry_run: bool, force: bool, format_: str) -> int:
    """Behaviours of the swarm library: Algorithm Modelling Files."""
    return _run("amf", paths, (), out, dry_run, force, format_)


@import_.command(epilog="Example: swarmc import ros ~/catkin_ws/src -o uav.swarm")
@click.argument("paths", metavar="FOLDER...", nargs=-1, required=True, type=_FILE)
@_output
@_dry_run
@_force
@options.diagnostics_format
@options.debug
def ros(paths: tuple[Path, ...], out: Path | None, dry_run: bool, force: bool, format_: str) -> int:
    """Interfaces and parameters of ROS 1 and ROS 2: packages, or folders with several."""
    return _run("ros", paths, (), out, dry_run, force, format_)


def _run(
    kind: Format,
    paths: Sequence[Path],
    described: Sequence[Path],
    out: Path | None,
    dry_run: bool,
    force: bool,
    format_: str,
) -> int:
    from swarmdsl.base.diagnostics.render import render, summary
    from swarmdsl.cli.exit_code import ERRORS, exit_code
    from swarmdsl.importing.command import run

    if dry_run and out is None:
        raise click.UsageError("--dry-run shows what would become of a file: name it with -o")
    imported = run(kind, paths, described, out, force=force, dry_run=dry_run)
    render(imported.report, format_, sys.stderr)
    if imported.text is not None and out is None:
        click.echo(imported.text, nl=False)
    elif dry_run or not imported.is_new:
        for layout in imported.layouts:
            click.echo(layout.diff(), nl=False)
    click.echo(summary(imported.report, imported.files), err=True)
    if not imported.report.has_errors and not dry_run and out is not None:
        if imported.is_new:
            click.echo(f"{out} is written", err=True)
        elif not imported.layouts:
            click.echo(f"{out} is up to date", err=True)
    changes = dry_run and any(layout.changed for layout in imported.layouts)
    return exit_code(imported.report) or (ERRORS if changes else 0)
