"""`swarmc lsp`."""

from __future__ import annotations

import os
import socket

import click

from swarmdsl.cli import options

_LOOPBACK = "127.0.0.1"


@click.command(epilog="Example: swarmc lsp --tcp 5007")
@options.connection
@options.debug
def lsp(port: int | None) -> int:
    """Run the language server."""
    from swarmdsl.ide.server.start import serve, serve_on_standard_streams

    if port is None:
        return serve_on_standard_streams()
    with accepted(port) as connection:
        return serve(connection.makefile("rb"), connection.makefile("wb"))


def accepted(port: int) -> socket.socket:
    """Accept the first connection; others are refused."""
    with socket.socket() as listener:
        if os.name == "posix":
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listener.bind((_LOOPBACK, port))
        except OSError as error:
            raise click.ClickException(f"port {port}: {error.strerror}") from error
        listener.listen(1)
        return listener.accept()[0]
