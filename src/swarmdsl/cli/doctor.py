"""`swarmc doctor`."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import click

from swarmdsl.cli import options
from swarmdsl.cli.exit_code import ERRORS, OK
from swarmdsl.cli.suggestions import Choice

_QUIET = 2.0
"""Seconds without anything new after which the graph of ROS 2 is complete."""


@click.command(epilog="Example: swarmc doctor ros2")
@click.argument("purposes", metavar="[PURPOSE]...", nargs=-1)
@click.option(
    "--format",
    "format_",
    type=Choice(("text", "json")),
    default="text",
    show_default=True,
    help="Output format.",
)
@click.option(
    "--model",
    metavar="MODEL",
    type=click.Path(path_type=Path),
    help="Compare the ROS interfaces of this model with the installed packages of ROS 2.",
)
@click.option(
    "--running", is_flag=True, help="With --model: compare it with the nodes that run now, too."
)
@options.debug
def doctor(purposes: tuple[str, ...], format_: str, model: Path | None, running: bool) -> int:
    """List the tools that are installed, and how to install the others.

    A PURPOSE is `git`, `ros1`, `ros2` or `skeleton`. With a PURPOSE, the exit code is 1 if a
    tool for it is missing. With --model, it is 1 if an interface is missing or differs.
    """
    if model is not None:
        return _compare(model, running, format_)
    if running:
        raise click.UsageError("--running compares a model: name it with --model")
    from swarmdsl.base.suggest import did_you_mean
    from swarmdsl.tools import doctor as tools

    known = [purpose.name for purpose in tools.PURPOSES]
    for name in purposes:
        if name not in known:
            hint = did_you_mean(name, known) or f"there are {', '.join(known)}"
            raise click.UsageError(f"there is no purpose `{name}`: {hint}")
    found = {
        purpose: findings
        for purpose, findings in tools.find().items()
        if purpose.name in purposes or not purposes
    }
    if format_ == "json":
        click.echo(tools.as_json(found))
    else:
        if not purposes:
            for name, value in tools.environment():
                click.echo(f"{name}: {value}")
            click.echo()
        for line in tools.as_text(found):
            click.echo(line)
    missing = any(each.place is None for findings in found.values() for each in findings)
    return ERRORS if purposes and missing else OK


def _compare(model: Path, running: bool, format_: str) -> int:
    """Compare the interfaces of a model with what is installed, and with what runs."""
    from swarmdsl.base.diagnostics.render import render
    from swarmdsl.base.errors import UsageError
    from swarmdsl.driver import pipeline
    from swarmdsl.importing.ros_graph import read_graph
    from swarmdsl.tools.ros_interfaces import as_text, compare_installed, compare_running

    checked = pipeline.check([model])
    if checked.system is None:
        render(checked.report, "text", sys.stderr)
        return ERRORS
    found = {"installed": list(compare_installed(checked.system))}
    if running:
        try:
            found["running"] = list(compare_running(checked.system, read_graph(_QUIET)))
        except UsageError as error:
            raise click.UsageError(str(error)) from error
    if format_ == "json":
        data = {
            part: [{"name": each.name, "place": each.place, "fault": each.fault} for each in rows]
            for part, rows in found.items()
        }
        click.echo(json.dumps(data, indent=2))
    else:
        for part, rows in found.items():
            for line in as_text(f"{part}: interfaces of {model}", rows):
                click.echo(line)
    return ERRORS if any(each.fault for rows in found.values() for each in rows) else OK
