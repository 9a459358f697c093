"""Jinja templates, compiled once and kept between runs."""

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
from swarmdsl.codegen.source_map import MappedText, TracedStr, at, mapped, marked

_PRINTED = "places that were printed"


class Templates:
    """The templates in a folder: what is undefined is an error, blocks leave no lines behind.

    In them, `at(origin)` marks a line as coming from a place in the model. Filters are
    functions of a value, by their names; `repr` is one.
    """

    def __init__(self, folder: Path, **filters: Callable[..., Any]) -> None:
        self._folder = folder
        self._filters = filters

    def fill(self, name: str, /, **values: object) -> MappedText:
        """What a template prints, with the places that its lines come from.

        Raises what Jinja does.
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
        made.filters |= {"repr": repr, **self._filters}
        return made


@pass_context
def _finalize(context: Context, value: object) -> object:
    if not isinstance(value, TracedStr):
        return value
    printed: list[TracedStr] = context[_PRINTED]
    return marked(value, printed)


class _Cache(FileSystemBytecodeCache):
    """Compiled templates in files, which Jinja replaces at once; nothing where that fails."""

    def get_source_checksum(self, source: str) -> str:
        # Another version may compile the same text in another way, as one without places did.
        return super().get_source_checksum(f"{__version__} with places {source}")

    def dump_bytecode(self, bucket: Bucket) -> None:
        with suppress(OSError):
            super().dump_bytecode(bucket)


def _cache() -> _Cache | None:
    """The cache of the user, None where there is none or Python is to write no bytecode."""
    if sys.dont_write_bytecode:
        return None
    given = Path(os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA") or "")
    try:
        folder = (given if given.is_absolute() else Path.home() / ".cache") / "swarmdsl"
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    except (OSError, RuntimeError):
        return None
    return _Cache(str(folder))
