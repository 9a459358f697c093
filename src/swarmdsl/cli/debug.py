"""`swarmc debug`."""

from __future__ import annotations

import click

from swarmdsl.cli import options
from swarmdsl.cli.lsp import accepted


@click.command(epilog="Example: swarmc debug --tcp 5008")
@click.option("--stdio", is_flag=True, help="Use standard input and output (the default).")
@click.option(
    "--tcp",
    "port",
    type=options.Integer(1, 65535),
    metavar="PORT",
    help="Accept one editor on this port of the loopback interface.",
)
@options.debug
def debug(stdio: bool, port: int | None) -> int:
    """Run the debug adapter, which simulates under the control of an editor.

    The editor says what to run: see the handbook.
    """
    if stdio and port is not None:
        raise click.UsageError("`--stdio` and `--tcp` conflict")
    from swarmdsl.ide.debugger.start import serve
    from swarmdsl.ide.server.start import standard_streams

    if port is None:
        return serve(*standard_streams())
    with accepted(port) as connection:
        return serve(connection.makefile("rb"), connection.makefile("wb"))
