"""Jinja templates, compiled once and cached between runs."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from contextlib import suppress
from functools import cached_property
from pathlib import Path
from typing import Any

from jinja2 import (
    Environment,
    FileSystemBytecodeCache,
    FileSystemLoader,
    StrictUndefined,
    pass_context,
)
from jinja2.bccache import Bucket
from jinja2.runtime import Context

from swarmdsl import __version__
from swarmdsl.base.markdown import code_cell, prose
from swarmdsl.codegen.source_map import MappedText, TracedStr, at, mapped, marked

_PRINTED = "places that were printed"


class Templates:
    """Templates in a folder; undefined names are errors, blocks leave no empty lines.

    In them, `at(origin)` marks a line with an origin in the model. Filters are
    functions of a value, by their names; `repr` is one, and `prose` and `code_cell` put text of the
    model into Markdown.
    """

    def __init__(self, folder: Path, **filters: Callable[..., Any]) -> None:
        self._folder = folder
        self._filters = filters

    def fill(self, name: str, /, **values: object) -> MappedText:
        """Return the output of a template, with the origins of its lines.

        Raises the exceptions of Jinja.
        """
        printed: list[TracedStr] = []
        template = self._environment.get_template(name)
        return mapped(template.render({**values, _PRINTED: printed}), printed)

    @cached_property
    def _environment(self) -> Environment:
        made = Environment(
            loader=FileSystemLoader(self._folder),
            undefined=StrictUndefined,
            trim_blocks=True,
            lstrip_blocks=True,
            keep_trailing_newline=True,
            finalize=_finalize,
            bytecode_cache=_cache(),
        )
        made.globals["at"] = at
        made.filters |= {"repr": repr, "prose": prose, "code_cell": code_cell, **self._filters}
        return made


@pass_context
def _finalize(context: Context, value: object) -> object:
    if not isinstance(value, TracedStr):
        return value
    printed: list[TracedStr] = context[_PRINTED]
    return marked(value, printed)


class _Cache(FileSystemBytecodeCache):
    """Compiled templates in files that are replaced atomically; none if that fails."""

    def get_source_checksum(self, source: str) -> str:
        # Another version may compile the same text differently.
        return super().get_source_checksum(f"{__version__} with places {source}")

    def dump_bytecode(self, bucket: Bucket) -> None:
        with suppress(OSError):
            super().dump_bytecode(bucket)


def _cache() -> _Cache | None:
    """Return the user's cache; None if unavailable or Python writes no bytecode."""
    if sys.dont_write_bytecode:
        return None
    given = Path(os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA") or "")
    try:
        folder = (given if given.is_absolute() else Path.home() / ".cache") / "swarmdsl"
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    except (OSError, RuntimeError):
        return None
    return _Cache(str(folder))
