"""Arguments and options shared by commands, for Click."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Mapping
from functools import reduce, wraps
from pathlib import Path
from typing import Any, TypeVar

import click

from swarmdsl.base.read_files import exists, is_folder
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
TEXT_PLACE = _Place(path_type=str)
"""A path as it was written: an id has one in it."""


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


class Integer(click.IntRange):
    """Integer in a range, with a message that tells both ends."""

    def convert(
        self, value: Any, param: click.Parameter | None, context: click.Context | None
    ) -> Any:
        """Return the integer as Click does."""
        try:
            return super().convert(value, param, context)
        except click.BadParameter:
            self.fail(f"`{value}` is not an integer from {self.min} to {self.max}", param, context)


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
    (
        ".bmp",
        ".eps",
        ".gif",
        ".jpeg",
        ".jpg",
        ".pdf",
        ".png",
        ".ps",
        ".svg",
        ".tif",
        ".tiff",
        ".webp",
    )
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


_SOURCES = (".swarm", ".swarmtest.toml", "swarm.toml")
"""Ends of the names of files that people write."""


def check_outputs(outputs: Mapping[str, Path | None], inputs: Iterable[Path | None]) -> None:
    """Raise BadParameter for an output in the place of an input, a source or another output.

    `outputs` are files by the options that name them; missing ones are None.
    """
    read = {os.path.realpath(path) for path in inputs if path is not None}
    written: dict[str, str] = {}
    for option, path in outputs.items():
        if path is None or is_folder(path):
            continue
        place = os.path.realpath(path)
        reason = ""
        if place in read:
            reason = f"`{path}` is an input of this command"
        elif place in written:
            reason = f"`{path}` is also the file of `{written[place]}`"
        elif place.endswith(_SOURCES) and exists(path):
            reason = f"`{path}` is part of a model, of its tests or of its settings"
        if reason:
            raise click.BadParameter(f"{reason}; name another file", param_hint=f"'{option}'")
        written[place] = option


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


def connection(function: Callable[[int | None], int]) -> Callable[[bool, int | None], int]:
    """Add the options for the streams of a server, which gets the port if one is given."""

    @click.option("--stdio", is_flag=True, help="Use standard input and output (the default).")
    @click.option(
        "--tcp",
        "port",
        type=Integer(1, 65535),
        metavar="PORT",
        help="Accept one editor on this port of the loopback interface.",
    )
    @wraps(function)
    def serve(stdio: bool, port: int | None) -> int:
        if stdio and port is not None:
            raise click.UsageError("`--stdio` and `--tcp` conflict")
        return function(port)

    return serve
