"""Read third-party JSON as plain data and report errors at their location."""

from __future__ import annotations

import json
import re
from typing import Any, NoReturn

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source, Span

MAX_DEPTH = 100
"""Maximum nesting of objects and lists."""

_MAX_SHOWN = 40


class _InvalidConstant(Exception):  # noqa: N818 - it only ends the parser
    """Constant that Python's `json` accepts but JSON (RFC 8259) does not."""


class JsonContent:
    """Typed access to the objects of a file, and locations in it."""

    def __init__(self, source: Source, report: Diagnostics) -> None:
        self.source = source
        self.report = report

    def at(self, word: str) -> Span:
        """Location of the first occurrence of a string, without quotes."""
        text = json.dumps(word, ensure_ascii=False)
        start = self.source.text.find(text)
        if start < 0:
            return Span(self.source, 0, min(1, len(self.source.text)))
        return Span(self.source, start + 1, start + len(text) - 1)

    def inside(self, holder: dict[str, Any], key: str) -> dict[str, Any]:
        """Object under a key; anything else is reported and read as an empty object."""
        value = holder.get(key)
        if value and not isinstance(value, dict):
            self._left_out(key, value, "it is not an object")
        return value if isinstance(value, dict) else {}

    def objects(self, holder: dict[str, Any], key: str) -> list[dict[str, Any]]:
        """Objects in the list under a key; other items are reported."""
        items = holder.get(key)
        if items and not isinstance(items, list):
            self._left_out(key, items, "it is not a list")
        if not isinstance(items, list):
            return []
        for item in items:
            if not isinstance(item, dict):
                self._left_out(key, item, "it is not an object")
        return [item for item in items if isinstance(item, dict)]

    def _left_out(self, key: str, value: object, reason: str) -> None:
        text = json.dumps(value, ensure_ascii=False)
        text = text if len(text) <= _MAX_SHOWN else f"{text[:_MAX_SHOWN]}..."
        what = f"`{text}` in `{key}`"
        self.report.report("left-out", self.at(key), what=what, reason=reason)


def read_json(source: Source, report: Diagnostics) -> Any:
    """Parse a file; report an error and return None if it is invalid.

    If an object has a key twice, the last value counts, with a warning.
    """
    text = source.text
    twice: list[str] = []

    def fields(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        made = dict(pairs)
        if len(made) < len(pairs):
            keys = [key for key, _ in pairs]
            twice.extend(key for key in made if keys.count(key) > 1)
        return made

    def refuse(reason: str, start: int = 0, length: int = 1) -> None:
        start = min(start, len(text))
        place = Span(source, start, min(start + length, len(text)))
        is_xml = text.lstrip().startswith("<")
        help_ = "it looks like XML: use `swarmc import scxml`" if is_xml else None
        report.report("not-json", place, reason=reason, help=help_)

    try:
        content = json.loads(text, object_pairs_hook=fields, parse_constant=_refuse)
    except json.JSONDecodeError as error:
        refuse(error.msg[:1].lower() + error.msg[1:], error.pos)
        return None
    except RecursionError:
        refuse(f"it is nested deeper than {MAX_DEPTH} levels")
        return None
    except _InvalidConstant as error:
        word = str(error)
        refuse(f"`{word}` is not a JSON number", max(text.find(word), 0), len(word))
        return None
    except ValueError:
        # Python limits the digits of an integer.
        refuse("a number has too many digits")
        return None
    if _is_deep(content):
        refuse(f"it is nested deeper than {MAX_DEPTH} levels")
        return None
    for key in dict.fromkeys(twice):
        places = [*re.finditer(rf"{re.escape(json.dumps(key, ensure_ascii=False))}\s*:", text)]
        place = Span(source, *places[-1].span()) if places else Span(source, 0, 1)
        what, reason = (
            f"the first value of `{key}`",
            "an object has this key twice, and the last value counts",
        )
        report.report("left-out", place, what=what, reason=reason)
    return content


def _refuse(word: str) -> NoReturn:
    raise _InvalidConstant(word)


def _is_deep(content: Any) -> bool:
    level = [content]
    for _ in range(MAX_DEPTH):
        inside: list[Any] = []
        for each in level:
            if isinstance(each, dict):
                inside += each.values()
            elif isinstance(each, list):
                inside += each
        level = inside
    return bool(level)
