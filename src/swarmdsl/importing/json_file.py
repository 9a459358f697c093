"""JSON of others as plain data: what is wrong with it, or too much, is reported at its place."""

from __future__ import annotations

import json
import re
from typing import Any, NoReturn

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source, Span

DEEPEST = 100
"""How deep objects and lists may stand in each other."""

_LONGEST = 40


class _NoJson(Exception):  # noqa: N818 - it only ends the parser
    """Something that `json` takes, but JSON (RFC 8259) does not have, with the word for it."""


class Content:
    """What is in the objects of a file, whatever they should be; and where it stands."""

    def __init__(self, source: Source, report: Diagnostics) -> None:
        self.source = source
        self.report = report

    def at(self, word: str) -> Span:
        """Where a text stands in the file for the first time, without its quotes."""
        text = json.dumps(word, ensure_ascii=False)
        start = self.source.text.find(text)
        if start < 0:
            return Span(self.source, 0, min(1, len(self.source.text)))
        return Span(self.source, start + 1, start + len(text) - 1)

    def inside(self, holder: dict[str, Any], key: str) -> dict[str, Any]:
        """The object under a key; an empty one, which is reported, where something else is."""
        value = holder.get(key)
        if value and not isinstance(value, dict):
            self._left_out(key, value, "it is no object")
        return value if isinstance(value, dict) else {}

    def objects(self, holder: dict[str, Any], key: str) -> list[dict[str, Any]]:
        """The objects in the list under a key; what else there is is reported."""
        items = holder.get(key)
        if items and not isinstance(items, list):
            self._left_out(key, items, "it is no list")
        if not isinstance(items, list):
            return []
        for item in items:
            if not isinstance(item, dict):
                self._left_out(key, item, "it is no object")
        return [item for item in items if isinstance(item, dict)]

    def _left_out(self, key: str, value: object, reason: str) -> None:
        text = json.dumps(value, ensure_ascii=False)
        text = text if len(text) <= _LONGEST else f"{text[:_LONGEST]}..."
        what = f"`{text}` in `{key}`"
        self.report.report("left-out", self.at(key), what=what, reason=reason)


def read_json(source: Source, report: Diagnostics) -> Any:
    """The content of a file; None where there is none, which has been reported then.

    Of a key that an object has twice, the last value counts, with a warning.
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
        help_ = "it looks like XML: `swarmc import scxml` reads that" if is_xml else None
        report.report("not-json", place, reason=reason, help=help_)

    try:
        content = json.loads(text, object_pairs_hook=fields, parse_constant=_refuse)
    except json.JSONDecodeError as error:
        refuse(error.msg[:1].lower() + error.msg[1:], error.pos)
        return None
    except RecursionError:
        refuse(f"it is nested deeper than {DEEPEST} levels")
        return None
    except _NoJson as error:
        word = str(error)
        refuse(f"`{word}` is no number there", max(text.find(word), 0), len(word))
        return None
    except ValueError:
        # Python's own limit for the digits of a whole number.
        refuse("a number in it has too many digits")
        return None
    if _is_deep(content):
        refuse(f"it is nested deeper than {DEEPEST} levels")
        return None
    for key in dict.fromkeys(twice):
        places = [*re.finditer(rf"{re.escape(json.dumps(key, ensure_ascii=False))}\s*:", text)]
        place = Span(source, *places[-1].span()) if places else Span(source, 0, 1)
        what, reason = f"what `{key}` is first", "an object has it twice: the last counts"
        report.report("left-out", place, what=what, reason=reason)
    return content


def _refuse(word: str) -> NoReturn:
    raise _NoJson(word)


def _is_deep(content: Any) -> bool:
    level = [content]
    for _ in range(DEEPEST):
        inside: list[Any] = []
        for each in level:
            if isinstance(each, dict):
                inside += each.values()
            elif isinstance(each, list):
                inside += each
        level = inside
    return bool(level)
