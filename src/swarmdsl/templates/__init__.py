"""Jinja templates, compiled once; to fill them in again takes no Jinja.

Jinja takes longer to import than a model to check. What it compiles a template to is plain
Python that asks little of its run time, and that little is in `swarmdsl.templates.plain`. What
a template wants beyond it, Jinja itself does, and it tells what is wrong with one.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from swarmdsl.source_map import MappedText, Placed, mapped
from swarmdsl.templates import kept
from swarmdsl.templates.plain import FILTERS, PRINTED, Code, Plain

if TYPE_CHECKING:
    from jinja2 import Environment


class Templates:
    """The templates in a folder: what is undefined is an error, blocks leave no lines behind.

    In them, `at(origin)` marks a line as coming from a place in the model. Filters are
    functions of a value, by their names.
    """

    def __init__(self, folder: Path, **filters: Callable[..., Any]) -> None:
        self._folder = folder
        self._filters = {**FILTERS, **filters}
        self._plain = Plain(self._code, self._filters)

    def fill(self, name: str, /, **values: object) -> MappedText:
        """What a template prints, with the places that its lines come from.

        Raises what Jinja does.
        """
        printed: list[Placed] = []
        try:
            text = self._plain.render(name, {**values, PRINTED: printed})
        except Exception:
            printed.clear()
            text = self._jinja.get_template(name).render({**values, PRINTED: printed})
        return mapped(text, printed)

    def _code(self, name: str) -> Code:
        path = self._folder / name
        text = path.read_text(encoding="utf-8")
        stamp = kept.stamp(text, *self._filters)
        code = kept.load(path, stamp)
        if code is None:
            from swarmdsl.templates.jinja import plain_code

            code = plain_code(self._jinja, name, path)
            kept.save(path, stamp, code)
        return code

    @cached_property
    def _jinja(self) -> Environment:
        from swarmdsl.templates.jinja import environment

        return environment(self._folder, self._filters)
