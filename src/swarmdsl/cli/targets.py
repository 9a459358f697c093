"""`swarmc targets`."""

from __future__ import annotations

import sys

import click

from swarmdsl.base.diagnostics.render import render
from swarmdsl.cli import options
from swarmdsl.cli.exit_code import exit_code
from swarmdsl.cli.suggestions import Choice


@click.command(epilog="Example: swarmc targets smach")
@click.argument("name", required=False)
@click.option(
    "--format",
    "format_",
    type=Choice(("text", "json")),
    default="text",
    show_default=True,
    help="Output format.",
)
@options.debug
def targets(name: str | None, format_: str) -> int:
    """List the targets, or the options and limits of one."""
    from swarmdsl.base.diagnostics.collector import Diagnostics
    from swarmdsl.codegen import target_info

    report = Diagnostics()
    found = (
        target_info.all_targets(report) if name is None else target_info.one_target(name, report)
    )
    if format_ == "json":
        click.echo(target_info.as_json(found), nl=False)
    elif name is None:
        click.echo(target_info.as_list(found), nl=False)
    else:
        click.echo("".join(map(target_info.as_page, found)), nl=False)
    render(report, "text", sys.stderr)
    return exit_code(report)
