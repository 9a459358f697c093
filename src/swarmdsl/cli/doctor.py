"""`swarmc doctor`."""

from __future__ import annotations

import click

from swarmdsl.cli import options
from swarmdsl.cli.exit_code import ERRORS, OK
from swarmdsl.cli.suggestions import Choice


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
@options.debug
def doctor(purposes: tuple[str, ...], format_: str) -> int:
    """List the tools that are installed, and how to install the others.

    A PURPOSE is `git`, `ros1`, `ros2` or `skeleton`. With a PURPOSE, the exit code is 1 if a
    tool for it is missing.
    """
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
