"""`swarmc debug`."""

from __future__ import annotations

import click

from swarmdsl.cli import options
from swarmdsl.cli.lsp import accepted


@click.command(epilog="Example: swarmc debug --tcp 5008")
@options.connection
@options.debug
def debug(port: int | None) -> int:
    """Run the debug adapter, which simulates under the control of an editor.

    The editor says what to run: see the handbook.
    """
    from swarmdsl.ide.debugger.start import serve
    from swarmdsl.ide.server.start import standard_streams

    if port is None:
        return serve(*standard_streams())
    with accepted(port) as connection:
        return serve(connection.makefile("rb"), connection.makefile("wb"))
