"""`swarmc import`."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Literal

import click

from swarmdsl.cli import options

_FILE = click.Path(path_type=Path)
_files = click.argument("paths", metavar="FILE...", nargs=-1, required=True, type=_FILE)
_output = click.option(
    "-o", "--output", "out", metavar="OUT.swarm", type=_FILE, help="Write there, not to stdout."
)
_force = click.option("--force", is_flag=True, help="Overwrite the output file.")


@click.group("import", epilog="Example: swarmc import scxml search.xml --adf uav.json -o uav.swarm")
@options.debug
def import_() -> None:
    """Make models of SCXML and ADF files.

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
@_force
@options.diagnostics_format
@options.debug
def scxml(
    paths: tuple[Path, ...],
    described: tuple[Path, ...],
    out: Path | None,
    force: bool,
    format_: str,
) -> int:
    """State machines: SCXML as the CPSwarm tools wrote and write it, or that of W3C."""
    return _run("scxml", paths, described, out, force, format_)


@import_.command(epilog="Example: swarmc import adf uav.json -o uav.swarm")
@_files
@_output
@_force
@options.diagnostics_format
@options.debug
def adf(paths: tuple[Path, ...], out: Path | None, force: bool, format_: str) -> int:
    """Functions: Abstraction Description Files of all generations."""
    return _run("adf", paths, (), out, force, format_)


def _run(
    kind: Literal["scxml", "adf"],
    paths: Sequence[Path],
    described: Sequence[Path],
    out: Path | None,
    force: bool,
    format_: str,
) -> int:
    from swarmdsl.cli.outcome import exit_code
    from swarmdsl.importing.command import run
    from swarmdsl.render import render, summary

    imported = run(kind, paths, described, out, force=force)
    render(imported.report, format_, sys.stderr)
    if imported.text is not None and out is None:
        click.echo(imported.text, nl=False)
    click.echo(summary(imported.report, imported.files), err=True)
    return exit_code(imported.report)
