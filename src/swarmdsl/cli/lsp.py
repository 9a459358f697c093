"""`swarmc lsp`."""

from __future__ import annotations

import gc
import os
import signal

import click

from swarmdsl.cli import options
from swarmdsl.cli.outcome import OK

_LOOPBACK = "127.0.0.1"


@click.command(epilog="Example: swarmc lsp --tcp 5007")
@click.option("--stdio", is_flag=True, help="Talk on standard input and output, as by default.")
@click.option(
    "--tcp",
    "port",
    type=click.IntRange(1, 65535),
    metavar="PORT",
    help="Wait for one editor on this port of the loopback interface.",
)
@options.debug
def lsp(stdio: bool, port: int | None) -> int:
    """Serve editors: the Language Server Protocol."""
    if stdio and port is not None:
        raise click.UsageError("`--stdio` and `--tcp` exclude each other")
    from swarmdsl.server.protocol import make_server

    gc.enable()  # a server runs for days
    if hasattr(signal, "SIGPIPE"):
        # An editor that is gone is noticed where something is written.
        signal.signal(signal.SIGPIPE, signal.SIG_IGN)
    server = make_server()
    if port is None:
        # Files of its own, which it closes when its editor is gone.
        server.start_io(os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb"))
    else:
        try:
            server.start_tcp(_LOOPBACK, port)
        except OSError as error:
            raise click.ClickException(f"port {port}: {error.strerror}") from error
    return OK
