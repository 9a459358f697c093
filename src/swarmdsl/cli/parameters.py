"""Options of the commands that start most often, as plain data.

They become options of Click. Importing Click takes a quarter of a small check, so command lines
in plain form (`--format json`, not `--format=json`) are parsed here instead.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from swarmdsl.base.diagnostics.render import FORMATS
from swarmdsl.base.read_files import exists
from swarmdsl.base.records import dataclass


@dataclass(frozen=True)
class Option:
    """An option and the parameter that it sets; without a `kind` it is a flag.

    The default is the first of the `choices`, () for a repeated option, else None.
    """

    parameter: str
    flags: tuple[str, ...]
    help: str
    kind: type[str] | type[Path] | None = None
    metavar: str | None = None
    choices: tuple[str, ...] = ()
    repeated: bool = False

    @property
    def default(self) -> object:
        """Value of an absent option."""
        if self.kind is None:
            return False
        return () if self.repeated else self.choices[0] if self.choices else None


FORMAT = Option("format_", ("--format",), "Format of diagnostics.", kind=str, choices=FORMATS)
WATCH = Option(
    "watch",
    ("--watch",),
    "Run again whenever a file of the model changes, until Ctrl-C.",
)
LEVELS = (
    Option(
        "allow",
        ("--allow",),
        "Silence a warning; may be repeated.",
        kind=str,
        metavar="NAME",
        repeated=True,
    ),
    Option(
        "warn",
        ("--warn",),
        "Report a warning that is off by default, or that swarm.toml allows or denies; "
        "may be repeated.",
        kind=str,
        metavar="NAME",
        repeated=True,
    ),
    Option(
        "deny",
        ("--deny",),
        "Make a warning an error; `warnings` means all. May be repeated.",
        kind=str,
        metavar="NAME",
        repeated=True,
    ),
)


def read(options: Iterable[Option], words: Sequence[str]) -> dict[str, Any] | None:
    """Parse a command line to values of options and `paths`; None where Click must parse it.

    Click parses everything that is wrong, or not in plain form.
    """
    by_flag = {flag: option for option in options for flag in option.flags}
    values: dict[str, Any] = {option.parameter: option.default for option in by_flag.values()}
    paths: list[Path] = []
    left = iter(words)
    for word in left:
        option = by_flag.get(word)
        if option is None:
            if not _is_plain(word, Path):
                return None
            paths.append(Path(word))
        elif option.kind is None:
            values[option.parameter] = True
        else:
            text = next(left, "")
            if not _is_plain(text, option.kind) or (option.choices and text not in option.choices):
                return None
            value = option.kind(text)
            before = values[option.parameter]
            values[option.parameter] = (*before, value) if option.repeated else value
    return {**values, "paths": tuple(paths)}


def _is_plain(text: str, kind: type[str] | type[Path]) -> bool:
    """Return True if Click takes the text as a value too; it requires files to be readable."""
    if not text or text.startswith("-"):
        return False
    return kind is str or not exists(text) or os.access(text, os.R_OK)
