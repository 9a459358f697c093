"""Arguments and options shared by commands, for Click."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import reduce
from pathlib import Path
from typing import Any, TypeVar

import click

from swarmdsl.base.read_files import is_folder
from swarmdsl.cli.parameters import FORMAT, LEVELS, Option
from swarmdsl.cli.suggestions import Choice


class _Place(click.Path):
    """Path of a file or folder. An empty path is an error, not the current folder."""

    def convert(
        self, value: Any, param: click.Parameter | None, context: click.Context | None
    ) -> Any:
        if value == "":
            self.fail("the path is empty", param, context)
        return super().convert(value, param, context)


PLACE = _Place(path_type=Path)


class Number(click.FloatRange):
    """Number in a range; NaN is in none, though it compares as neither less nor greater."""

    def convert(
        self, value: Any, param: click.Parameter | None, context: click.Context | None
    ) -> Any:
        """Return the number as Click does."""
        number = super().convert(value, param, context)
        if math.isnan(number):
            self.fail(f"{value!r} is not a number", param, context)
        return number


_Decorated = TypeVar("_Decorated", bound=Callable[..., Any])


def option(about: Option) -> Callable[[_Decorated], _Decorated]:
    """Return a decorator that adds an option described as plain data."""
    types = {None: None, str: None, Path: PLACE}
    return click.option(
        *about.flags,
        about.parameter,
        is_flag=about.kind is None,
        type=Choice(about.choices) if about.choices else types[about.kind],
        metavar=about.metavar,
        multiple=about.repeated,
        default=about.default,
        show_default=bool(about.choices),
        help=about.help,
    )


files = click.argument("paths", metavar="[FILE|FOLDER]...", nargs=-1, type=PLACE)
diagnostics_format = option(FORMAT)


# Suffixes of formats that cannot be written.
_PICTURES = frozenset(
    (".bmp", ".eps", ".gif", ".jpeg", ".jpg", ".pdf", ".png", ".ps", ".tif", ".tiff", ".webp")
)


def check_picture(path: Path, option: str, suffix: str, others: Mapping[str, str]) -> None:
    """Raise BadParameter for a file whose suffix is that of another format.

    `suffix` is that of the written format; `others` maps suffixes to the options that select
    their formats.
    """
    named = path.suffix.lower()
    if is_folder(path) or named == suffix or named not in {*others, *_PICTURES}:
        return
    way = f"name a file that ends with `{suffix}`"
    if named in others:
        way += f", or add `{others[named]}`"
    elif others:
        also = (f"with `{other}` `{each}`" for each, other in others.items())
        way += f" ({', '.join(also)})"
    reason = f"`{path}` has the suffix of another format: `{named}` is not written"
    raise click.BadParameter(f"{reason}; {way}", param_hint=f"'{option}'")


def levels(function: _Decorated) -> _Decorated:
    """Add the options for levels of warnings."""
    return reduce(lambda inner, about: option(about)(inner), reversed(LEVELS), function)


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
