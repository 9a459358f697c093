"""Python source text: calls laid out as a formatter would, literals, model text in comments."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from swarmdsl.dataclass import dataclass
from swarmdsl.source import Span
from swarmdsl.source_map import Placed

WIDTH = 100
_STEP = "    "


@dataclass(frozen=True)
class Source:
    """An expression that is Python text already."""

    text: str


@dataclass(frozen=True)
class Call:
    """A call; arguments are `Source`, `Call`, or plain values written as literals."""

    function: str
    arguments: tuple[object, ...] = ()
    keywords: tuple[tuple[str, object], ...] = ()


def layout(
    value: object, indent: int = 0, before: str = "", after: str = "", width: int = WIDTH
) -> str:
    """The value as an expression, broken over lines where it does not fit in one.

    `indent` is the depth of the line it stands in, `before` and `after` what else is in it.
    """
    flat = one_line(value)
    room = width - len(before) - len(after)
    if len(flat) <= room or isinstance(value, Source):
        return f"{before}{flat}{after}"
    opening, items, closing = _parts(value)
    if not items:
        return f"{before}{flat}{after}"
    inner = _STEP * (indent + 1)
    together = ", ".join(prefix + one_line(item) for prefix, item in items)
    if isinstance(value, Call) and len(inner) + len(together) <= width:
        lines = [inner + together]
    else:
        lines = [layout(item, indent + 1, inner + prefix, ",", width) for prefix, item in items]
    return "\n".join([f"{before}{opening}", *lines, f"{_STEP * indent}{closing}{after}"])


def one_line(value: object) -> str:
    """The value as an expression on one line."""
    if isinstance(value, Source):
        return value.text
    if isinstance(value, (Call, Mapping, list, tuple)):
        opening, items, closing = _parts(value)
        inside = ", ".join(prefix + one_line(item) for prefix, item in items)
        comma = "," if isinstance(value, tuple) and len(items) == 1 else ""
        return f"{opening}{inside}{comma}{closing}"
    return repr(value)


def _parts(value: object) -> tuple[str, list[tuple[str, object]], str]:
    """What opens it, its items with what stands before each, what closes it."""
    match value:
        case Call(function=function, arguments=arguments, keywords=keywords):
            items = [("", argument) for argument in arguments]
            return f"{function}(", items + [(f"{name}=", item) for name, item in keywords], ")"
        case Mapping():
            return "{", [(f"{key!r}: ", item) for key, item in value.items()], "}"
        case tuple():
            return "(", [("", item) for item in value], ")"
        case Sequence() if not isinstance(value, str):
            return "[", [("", item) for item in value], "]"
    return repr(value), [], ""


def comment_lines(text: str) -> list[str]:
    """Text of the model as lines for comments."""
    return [line.rstrip() for line in text.strip().splitlines()]


def comments(origin: Span | None, doc: str = "") -> tuple[str, ...]:
    """Where something stands in the model and what is said of it there, a comment a line."""
    where = (Placed(place(origin), origin, holds=True),) if origin is not None else ()
    return (*where, *comment_lines(doc))


def docstring(text: str) -> str:
    """Text of the model as it can stand between triple quotes."""
    safe = text.strip().replace("\\", "\\\\").replace('"', '\\"')
    return "\n".join(line.rstrip() for line in safe.splitlines())


def place(origin: Span | None) -> str:
    """`file:line` of a place in the model, the file by its last name."""
    if origin is None:
        return ""
    return f"{file_name(origin)}:{origin.line}"


def file_name(origin: Span) -> str:
    """The last name of the file a place is in, on one line."""
    name = origin.source.name.replace("\\", "/").rsplit("/", 1)[-1]
    return " ".join(name.split())
