"""Python source text: calls laid out as by a formatter, literals, comments."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from typing import NamedTuple

from swarmdsl.base.naming import snake_case
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.codegen.source_map import TracedStr

WIDTH = 100
_STEP = "    "
# In a comment on the first two lines of a module, it names the encoding (PEP 263).
_ENCODING = re.compile("(?<=coding)[:=]")


@dataclass(frozen=True)
class Source:
    """Expression that is Python text already."""

    text: str


@dataclass(frozen=True)
class Call:
    """Call; arguments are `Source`, `Call`, or plain values written as literals."""

    function: str
    arguments: tuple[object, ...] = ()
    keywords: tuple[tuple[str, object], ...] = ()


def layout(
    value: object, indent: int = 0, before: str = "", after: str = "", width: int = WIDTH
) -> str:
    """Return the value as an expression, broken over lines if it is too long.

    `indent` is the depth of its line, `before` and `after` are the rest of the line.
    """
    return _laid_out(_written(value), indent, before, after, width)


def one_line(value: object) -> str:
    """Return the value as an expression on one line."""
    return _flat(_written(value))


class _Written(NamedTuple):
    """Expression on one line, and the parts that can have lines of their own."""

    flat: str
    opening: str
    items: Sequence[tuple[str, _Written | str]]
    """Each with its prefix."""
    closing: str
    together: str | None = None
    """All items on one line; only arguments of a call may share one."""


def _written(value: object) -> _Written | str:
    """Return an expression; one without parts is only a string."""
    if isinstance(value, (str, int, float)):
        return repr(value)
    if isinstance(value, Source):
        return value.text
    items: list[tuple[str, _Written | str]]
    if isinstance(value, Call):
        items = [("", _written(argument)) for argument in value.arguments]
        items += [(f"{name}=", _written(item)) for name, item in value.keywords]
        together = _side_by_side(items)
        opening = f"{value.function}("
        return _Written(f"{opening}{together})", opening, items, ")", together)
    if isinstance(value, tuple):
        items = [("", _written(item)) for item in value]
        comma = "," if len(items) == 1 else ""
        return _Written(f"({_side_by_side(items)}{comma})", "(", items, ")")
    if isinstance(value, list):
        items = [("", _written(item)) for item in value]
        return _Written(f"[{_side_by_side(items)}]", "[", items, "]")
    if isinstance(value, Mapping):
        items = [(f"{key!r}: ", _written(item)) for key, item in value.items()]
        return _Written(f"{{{_side_by_side(items)}}}", "{", items, "}")
    return repr(value)


def _flat(written: _Written | str) -> str:
    return written if isinstance(written, str) else written.flat


def _side_by_side(items: Sequence[tuple[str, _Written | str]]) -> str:
    return ", ".join([prefix + _flat(item) for prefix, item in items])


def _laid_out(written: _Written | str, indent: int, before: str, after: str, width: int) -> str:
    if isinstance(written, str):
        return f"{before}{written}{after}"
    if not written.items or len(before) + len(written.flat) + len(after) <= width:
        return f"{before}{written.flat}{after}"
    inner = _STEP * (indent + 1)
    together = written.together
    if together is not None and len(inner) + len(together) <= width:
        lines = [inner + together]
    else:
        lines = [
            _laid_out(item, indent + 1, inner + prefix, ",", width)
            for prefix, item in written.items
        ]
    closing = f"{_STEP * indent}{written.closing}{after}"
    return "\n".join([f"{before}{written.opening}", *lines, closing])


class Constants:
    """Constants of a module for values that have a name in the model, such as `Mode.AUTO`.

    `taken` are names that the module uses for other things.
    """

    def __init__(self, taken: Iterable[str] = ()) -> None:
        self._taken = frozenset(taken)
        self._known: dict[str, tuple[str, str]] = {}

    def name(self, name: str, text: str) -> str:
        """Return the constant for a name in the model, whose value is written as `text`."""
        known = "_".join(snake_case(part) for part in name.split(".")).upper()
        if not known.isidentifier():  # leading underscores of `_3` are lost
            known = f"VALUE_{known}"
        while known in self._taken or self._differs(known, name, text):
            known += "_"
        self._known[known] = name, text
        return known

    def lines(self) -> list[str]:
        """Return the statements, each with the name in the model."""
        return [
            f"{known} = {text}" + (f"  # {name}" if name != known else "")
            for known, (name, text) in sorted(self._known.items())
        ]

    def _differs(self, known: str, name: str, text: str) -> bool:
        return self._known.get(known, (name, text)) != (name, text)


def comment_lines(text: str) -> list[str]:
    """Return text of the model as lines for comments."""
    return [line.rstrip() for line in text.strip().splitlines()]


def comments(origin: Span | None, doc: str = "") -> tuple[str, ...]:
    """Return the origin and the documentation of an element as comment lines."""
    where = (TracedStr(source_place(origin), origin, holds=True),) if origin is not None else ()
    return (*where, *comment_lines(doc))


def docstring(text: str) -> str:
    """Return text of the model, escaped for triple quotes."""
    safe = text.strip().replace("\\", "\\\\").replace('"', '\\"')
    return "\n".join(line.rstrip() for line in safe.splitlines())


def source_place(origin: Span | None) -> str:
    """Return `file:line` of a place in the model, with the base name of the file."""
    if origin is None:
        return ""
    return f"{file_name(origin)}:{origin.line}"


def file_name(origin: Span) -> str:
    """Return the base name of the file of a place, on one line."""
    return _last_name(origin.source.name)


@cache
def _last_name(path: str) -> str:
    name = " ".join(path.replace("\\", "/").rsplit("/", 1)[-1].split())
    if not name.isprintable():
        from swarmdsl.base.diagnostics.render.printable import printable  # few names need it

        name = printable(name)
    return _ENCODING.sub("_", name)
