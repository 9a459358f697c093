"""Arguments and options that several commands have."""

from __future__ import annotations

from pathlib import Path

import click

from swarmdsl.render import FORMATS

files = click.argument(
    "paths", metavar="[FILE|FOLDER]...", nargs=-1, type=click.Path(path_type=Path)
)
diagnostics_format = click.option(
    "--format",
    "format_",
    type=click.Choice(FORMATS),
    default=FORMATS[0],
    show_default=True,
    help="How diagnostics are printed.",
)
watch = click.option(
    "--watch", is_flag=True, help="Run again whenever a file of the model changes, until Ctrl-C."
)
allow = click.option(
    "--allow", multiple=True, metavar="NAME", help="Silence a warning; may be repeated."
)
warn = click.option(
    "--warn",
    multiple=True,
    metavar="NAME",
    help="Report a warning that is silent unless asked for, or that swarm.toml silences or denies. "
    "May be repeated.",
)
deny = click.option(
    "--deny",
    multiple=True,
    metavar="NAME",
    help="Take a warning for an error; `warnings` stands for all. May be repeated.",
)


def _show_debug(_context: click.Context, _param: click.Parameter, debug: bool) -> None:
    if debug:
        import logging

        logging.basicConfig(format="%(message)s")
        logging.getLogger("swarmdsl").setLevel(logging.DEBUG)


debug = click.option(
    "--debug",
    is_flag=True,
    expose_value=False,
    is_eager=True,
    callback=_show_debug,
    help="Show tracebacks.",
)
