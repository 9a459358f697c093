"""The options of the commands that start most often, as plain data.

They become options of Click. To import Click takes a quarter of a small check: what is in the
plainest form is read here, without it.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from swarmdsl.base.diagnostics.render import FORMATS
from swarmdsl.base.records import dataclass


@dataclass(frozen=True)
class Option:
    """An option: the parameter that it sets and, without a `kind`, sets to True.

    The default of one that has `choices` is the first of them; of one that may be repeated,
    nothing; else None.
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
        """The value where the option is not given."""
        if self.kind is None:
            return False
        return () if self.repeated else self.choices[0] if self.choices else None


FORMAT = Option("format_", ("--format",), "How diagnostics are printed.", kind=str, choices=FORMATS)
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
        "Report a warning that is silent unless asked for, or that swarm.toml silences or denies. "
        "May be repeated.",
        kind=str,
        metavar="NAME",
        repeated=True,
    ),
    Option(
        "deny",
        ("--deny",),
        "Take a warning for an error; `warnings` stands for all. May be repeated.",
        kind=str,
        metavar="NAME",
        repeated=True,
    ),
)


def read(options: Iterable[Option], words: Sequence[str]) -> dict[str, Any] | None:
    """The values that a command line gives options and `paths`; None where Click is to read it.

    That is so of all that is wrong, and of what is written in another than the plainest form.
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
    """Whether Click takes it for a value too: of files it wants to be able to read them."""
    if not text or text.startswith("-"):
        return False
    return kind is str or not Path(text).exists() or os.access(text, os.R_OK)
