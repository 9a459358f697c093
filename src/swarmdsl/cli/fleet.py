"""`swarmc fleet`."""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

import click

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.cli import options, served_page
from swarmdsl.cli.exit_code import ERRORS, OK

if TYPE_CHECKING:
    from swarmdsl.execution.simulate.run.prepare import Prepared
    from swarmdsl.ide.fleet.watch import Watch
_LOOPBACK = "127.0.0.1"
_TOKEN = re.compile(r"[A-Za-z0-9._~-]+")
"""Characters that need no quotes in an address or a cookie."""


@click.command(epilog="Example: swarmc fleet examples/search_and_rescue --follow ros2:/sar --open")
@options.files
@click.option("--swarm", metavar="NAME", help="Watch this swarm.")
@click.option(
    "--follow",
    "sources",
    metavar="SOURCE",
    multiple=True,
    help="Robots to watch: `ros2:NAME` for a namespace or a node of ROS 2, may be repeated; a "
    "trace of JSON lines while it is written, `-` for standard input; or a recording, the folder "
    "of a bag of ROS 2 in MCAP or SQLite.  [default: ros2:, all nodes]",
)
@click.option(
    "--terminal", is_flag=True, help="Show the robots in this terminal, and serve no page."
)
@click.option(
    "--port",
    type=options.Integer(0, 65535),
    default=0,
    metavar="PORT",
    help="Port of the page; 0 takes a free one.  [default: 0]",
)
@click.option(
    "--host",
    default=_LOOPBACK,
    metavar="ADDRESS",
    help="Address of this computer on which the page is served; others than that of the loopback "
    "interface need `--token`.  [default: 127.0.0.1]",
)
@click.option(
    "--token",
    metavar="TEXT",
    envvar="SWARMC_FLEET_TOKEN",
    help="Answer only those who have this token.  [env: SWARMC_FLEET_TOKEN]",
)
@click.option("--open", "opens", is_flag=True, help="Open the page in the browser.")
@options.debug
def fleet(
    paths: tuple[Path, ...],
    swarm: str | None,
    sources: tuple[str, ...],
    terminal: bool,
    port: int,
    host: str,
    token: str | None,
    opens: bool,
) -> int:
    """See and steer the robots of a swarm.

    A FOLDER means all .swarm files below it. Without arguments: the sources of swarm.toml, or the
    current folder. The page shows who is there, states, alarms and verdicts until Ctrl-C, and has
    a button for each `swarm operator event` of the model.
    """
    from swarmdsl.base.forced_end import forced_end
    from swarmdsl.execution.simulate.run.prepare import Request
    from swarmdsl.ide.preview.ros2 import PREFIX, UnavailableError

    names = [each.removeprefix(PREFIX) for each in sources or (PREFIX,) if each.startswith(PREFIX)]
    others = [each for each in sources if not each.startswith(PREFIX)]
    if len(others) > 1 or (others and names):
        raise click.UsageError("`--follow` takes one trace or recording, or nodes of ROS 2")
    if "" in others:
        raise click.UsageError("`--follow` names nothing: give `ros2:NAME`, a file, `-` or a bag")
    if token is not None and _TOKEN.fullmatch(token) is None:
        raise click.UsageError("a token has letters, digits, and `-`, `.`, `_` or `~`")
    if terminal and (opens or port or host != _LOOPBACK):
        raise click.UsageError("`--terminal` serves no page: leave out its other options")
    if host not in (_LOOPBACK, "localhost") and token is None:
        raise click.UsageError("`--host` needs `--token`: others can reach the page")
    served_page.run_for_hours()
    prepared, failed = served_page.prepared_to_grow(Request(paths, swarm=swarm), Path("trace"))
    if failed:
        return ERRORS
    with ExitStack() as stack:
        stack.enter_context(forced_end())
        try:
            watch = _begun(prepared, names, others, terminal, stack)
        except UnavailableError as error:
            served_page.tell_of_ros(error)
            return ERRORS
        if watch is None:
            return ERRORS
        try:
            if terminal:
                from swarmdsl.ide.fleet.terminal import show

                show(watch, sys.stdout)
            else:
                _serve(watch, host, port, token, opens, stack)
        except KeyboardInterrupt:
            click.echo(err=True)
    return OK


def _begun(
    prepared: Prepared | None,
    names: Sequence[str],
    others: Sequence[str],
    terminal: bool,
    stack: ExitStack,
) -> Watch | None:
    """Return the watch over the robots of a source; None if it cannot be read, which is told."""
    from swarmdsl.ide.fleet.followed import follow_trace, wait_or_refuse
    from swarmdsl.ide.fleet.recorded import BagClock, UnreadableBagError, is_bag, read_bag
    from swarmdsl.ide.fleet.ros2_graph import listen_to
    from swarmdsl.ide.fleet.watch import RECORDED, Watch
    from swarmdsl.ide.preview.ros2 import spinning
    from swarmdsl.tools.player.record import record_nothing

    each = False
    if terminal:
        from swarmdsl.ide.fleet.terminal import has_screen

        each = not has_screen(sys.stdout)
    tell = served_page.tell
    subject = prepared.subject if prepared is not None else None
    source = others[0] if others else "ROS 2"
    recording = record_nothing(prepared, source)
    if not others:
        watch = Watch(source, subject, recording, tell, tells_each=each)
        stack.enter_context(spinning("fleet", names, listen_to(names, watch)))
    elif is_bag(source):
        clock = BagClock()
        watch = Watch(source, subject, recording, tell, clock, RECORDED, each)
        try:
            read_bag(source, watch, clock)
        except UnreadableBagError as error:
            failed = Diagnostics()
            failed.report("unreadable-bag", path=source, reason=str(error), help=error.hint)
            tell(failed)
            return None
        watch.turn("ended")
    else:
        watch = Watch(source, subject, recording, tell, tells_each=each)
        if not wait_or_refuse(source, watch, tell):
            return None
        if watch.waiting:
            click.echo(watch.waiting, err=True)
        follow_trace(source, watch, tell)
    return watch


def _serve(
    watch: Watch, host: str, port: int, token: str | None, opens: bool, stack: ExitStack
) -> None:
    """Serve the page until the user ends it."""
    from swarmdsl.ide.fleet.serving import serving

    page = serving(watch, host, port, token)
    served_page.opened(page, f"{host}, port {port}", opens, stack)
    served_page.wait_for_interrupt()
