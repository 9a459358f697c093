"""`swarmc preview`."""

from __future__ import annotations

import os
import sys
from contextlib import ExitStack
from pathlib import Path

import click

from swarmdsl.cli import options


@click.command(epilog="Example: swarmc preview examples/search_and_rescue --port 5008")
@options.files
@click.option(
    "--port",
    type=click.IntRange(0, 65535),
    default=0,
    metavar="PORT",
    help="Of the loopback interface; 0 takes one that is free.  [default: 0]",
)
@click.option("--open", "opens", is_flag=True, help="Open it in the browser.")
@options.debug
def preview(paths: tuple[Path, ...], port: int, opens: bool) -> int:
    """Show the diagrams of a model in a browser, as its files are now.

    A FOLDER stands for all .swarm files below it; nothing, for the sources that swarm.toml
    names, or for the current folder. The page follows each change of a file until Ctrl-C; while
    the model has errors, it shows how the diagrams were before.
    """
    from swarmdsl.cli.outcome import briefly
    from swarmdsl.cli.watch import watch_files
    from swarmdsl.compiler import Result
    from swarmdsl.preview.pictures import pictures
    from swarmdsl.preview.serving import News, serving
    from swarmdsl.project.command_line import run_settings
    from swarmdsl.project.settings import Settings

    news = News()
    # With whole paths, by which places lead into an editor.
    whole = tuple(Path(os.path.abspath(path)) for path in paths)  # noqa: PTH100 - keeps links

    def show(result: Result, _settings: Settings) -> str:
        said = briefly(result, "text", sys.stdout)
        news.tell(pictures(result))
        return f"{said}; {address}"

    with ExitStack() as stack:
        try:
            address = stack.enter_context(serving(news, port))
        except OSError as error:
            raise click.ClickException(f"port {port}: {error.strerror}") from error
        if opens:
            click.launch(address)
        return watch_files(whole, lambda report: run_settings(whole, {}, report), show)
