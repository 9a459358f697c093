"""`swarmc preview`."""

from __future__ import annotations

import os
import sys
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

import click

from swarmdsl.base.records import replace
from swarmdsl.cli import options

if TYPE_CHECKING:
    from swarmdsl.ide.preview.editors import Editor


def _editor(_context: click.Context, _param: click.Parameter, text: str | None) -> Editor | None:
    """Return the editor of the command line, else an installed one."""
    from swarmdsl.ide.preview.editors import TemplateError, detect_editor, editor

    try:
        return editor(text) if text is not None else detect_editor()
    except TemplateError as error:
        raise click.BadParameter(str(error)) from error


@click.command(epilog="Example: swarmc preview examples/search_and_rescue --port 5008")
@options.files
@click.option(
    "--port",
    type=options.Integer(0, 65535),
    default=0,
    metavar="PORT",
    help="Port of the loopback interface; 0 takes a free one.  [default: 0]",
)
@click.option("--open", "opens", is_flag=True, help="Open the page in the browser.")
@click.option(
    "--follow",
    "traces",
    metavar="TRACE",
    multiple=True,
    help="Highlight the active states of this trace of JSON lines while it is written; `-` for "
    "standard input, `ros2:NAME` for a running node or a namespace. May be repeated.",
)
@click.option(
    "--editor",
    metavar="COMMAND",
    callback=_editor,
    help="Command that opens a clicked element, like `code --goto {file}:{line}:{column}`, or an "
    "address, like `vscode://file{file}:{line}:{column}`.  [default: VS Code, VSCodium, Cursor or "
    "Windsurf, if it is on the PATH]",
)
@options.debug
def preview(
    paths: tuple[Path, ...],
    port: int,
    opens: bool,
    traces: tuple[str, ...],
    editor: Editor | None,
) -> int:
    """Show live diagrams of a model in a browser.

    A FOLDER means all .swarm files below it. Without arguments: the sources of swarm.toml, or
    the current folder. The page follows each change of a file until Ctrl-C; while the model
    has errors, it keeps the last diagrams. It also simulates the model, step by step.
    `--follow` shows the states of robots, of a simulation in real time or of others.
    """
    from swarmdsl.base.diagnostics.collector import Diagnostics
    from swarmdsl.base.forced_end import forced_end
    from swarmdsl.cli import served_page
    from swarmdsl.cli.exit_code import briefly
    from swarmdsl.cli.watch import Concluded, watch_files
    from swarmdsl.driver.config.command_line import run_settings
    from swarmdsl.driver.config.settings import Settings
    from swarmdsl.driver.pipeline import Result
    from swarmdsl.ide.preview.live_trace import follow
    from swarmdsl.ide.preview.pictures import Pictures, pictures
    from swarmdsl.ide.preview.ros2 import PREFIX, UnavailableError, listening
    from swarmdsl.ide.preview.serving import Snapshot, serving
    from swarmdsl.ide.preview.simulation import Simulation

    served_page.run_for_hours()
    snapshot = Snapshot()
    simulation = Simulation(snapshot)

    def read_settings(report: Diagnostics) -> Settings:
        # Absolute paths, so that places open in an editor.
        found = run_settings(paths, {}, report)
        whole = (Path(os.path.abspath(path)) for path in found.sources)  # noqa: PTH100 - keeps links
        return replace(found, sources=tuple(whole))

    def show(result: Result, settings: Settings) -> Concluded:
        def say() -> str:
            said = briefly(result, "text", sys.stdout)
            made = pictures(result)
            simulation.model_changed()
            if isinstance(made, Pictures):
                snapshot.tell(made, simulation.offers(made, settings.sources, settings.folder))
            else:
                snapshot.tell(made)
            return f"{said}; {address}"

        return Concluded(len(result.report) > 0, say)

    nodes = [each.removeprefix(PREFIX) for each in traces if each.startswith(PREFIX)]
    with ExitStack() as stack:
        stack.enter_context(forced_end())
        try:
            stack.enter_context(listening(nodes, snapshot, served_page.tell))
        except UnavailableError as error:
            served_page.tell_of_ros(error)
            return 1
        stack.callback(simulation.close)
        page = serving(snapshot, port, editor, simulation.act)
        address = served_page.opened(page, f"port {port}", opens, stack, say=False)
        follow([each for each in traces if not each.startswith(PREFIX)], snapshot, served_page.tell)
        return watch_files(paths, read_settings, show)
