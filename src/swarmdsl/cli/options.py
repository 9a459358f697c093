"""Arguments and options that several commands have, as Click reads them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

from swarmdsl.cli.parameters import FORMAT, Option

_Decorated = TypeVar("_Decorated", bound=Callable[..., Any])


def option(about: Option) -> Callable[[_Decorated], _Decorated]:
    """What adds an option that is described as plain data."""
    types = {None: None, str: None, Path: click.Path(path_type=Path)}
    return click.option(
        *about.flags,
        about.parameter,
        is_flag=about.kind is None,
        type=click.Choice(about.choices) if about.choices else types[about.kind],
        metavar=about.metavar,
        multiple=about.repeated,
        default=about.default,
        show_default=bool(about.choices),
        help=about.help,
    )


files = click.argument(
    "paths", metavar="[FILE|FOLDER]...", nargs=-1, type=click.Path(path_type=Path)
)
diagnostics_format = option(FORMAT)


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
