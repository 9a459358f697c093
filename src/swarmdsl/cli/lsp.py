"""`swarmc lsp`."""

from __future__ import annotations

import os
import signal
import socket
from typing import BinaryIO, cast

import click

from swarmdsl.cli import options

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
    from swarmdsl.server.service import serve

    if hasattr(signal, "SIGPIPE"):
        # An editor that is gone is noticed where something is written.
        signal.signal(signal.SIGPIPE, signal.SIG_IGN)
    if port is None:
        return serve(_taken(0, "rb"), _taken(1, "wb"))
    with _connected(port) as connection:
        return serve(connection.makefile("rb"), connection.makefile("wb"))


def _taken(descriptor: int, mode: str) -> BinaryIO:
    """A standard stream; what is printed by mistake does not get into it."""
    stream = os.fdopen(os.dup(descriptor), mode)
    null = os.open(os.devnull, os.O_RDWR)
    os.dup2(null, descriptor)
    os.close(null)
    return cast(BinaryIO, stream)


def _connected(port: int) -> socket.socket:
    """A connection to the first editor that asks for one; another one is refused."""
    with socket.socket() as listener:
        if os.name == "posix":
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listener.bind((_LOOPBACK, port))
        except OSError as error:
            raise click.ClickException(f"port {port}: {error.strerror}") from error
        listener.listen(1)
        return listener.accept()[0]
