"""Jinja itself: compiles templates, and fills in those that are not plain."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined, pass_context
from jinja2.runtime import Context

from swarmdsl.source_map import Placed, at, marked
from swarmdsl.templates.plain import PRINTED, Code


def environment(folder: Path, filters: Mapping[str, Callable[..., Any]]) -> Environment:
    """The templates in a folder."""
    made = Environment(
        loader=FileSystemLoader(folder),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        finalize=_finalize,
    )
    made.globals["at"] = at
    made.filters |= filters
    return made


def plain_code(made: Environment, name: str, path: Path) -> Code:
    """A template as code that takes the names of the run time as they are in its globals.

    Raises TemplateError, OSError, and ValueError where this Jinja compiles to something else.
    """
    source = made.compile(path.read_text(encoding="utf-8"), name, str(path), raw=True)
    first, _, rest = source.partition("\n")
    if not first.startswith("from jinja2.runtime import "):
        raise ValueError(first)
    return compile(rest, str(path), "exec")


@pass_context
def _finalize(context: Context, value: object) -> object:
    if not isinstance(value, Placed):
        return value
    printed: list[Placed] = context[PRINTED]
    return marked(value, printed)
