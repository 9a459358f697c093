"""Changes of a text that mend what a diagnostic is about, where its way out is one."""

from __future__ import annotations

import re

from swarmdsl.dataclass import dataclass
from swarmdsl.diagnostics import Diagnostic
from swarmdsl.source import Span

_MEANT = re.compile(r"did you mean `([^`]+)`\?")
_IMPORT = re.compile(r"add `(import [^`]+)`")
_DECLARATION = re.compile(r"declare it: `([^`]+)`")
_VARIABLE = re.compile(r"declare it in `(\w+)`: `([^`]+)`")
_NAME = re.compile(r"[\w./]+")
# After the `{` of a declaration: a value, a comment or nothing, or something else.
_LINE = re.compile(r"\n[ \t]*(?:(?P<value>(?:param|var|in)\b[^\n]*)|(?P<other>(?!//)\S[^\n]*))?")
_HEAD = re.compile(r"^(?:package|import)\b[^\n]*\n", re.MULTILINE)


@dataclass(frozen=True)
class Fix:
    """What to do, in words, and the text to put in the place of a span."""

    title: str
    span: Span
    text: str


def fix(found: Diagnostic) -> Fix | None:
    """The change that a diagnostic proposes; None where a person has to decide."""
    if found.primary is None or found.help is None:
        return None
    span = found.primary.span.absolute
    if (meant := _MEANT.fullmatch(found.help)) and _NAME.fullmatch(span.text):
        return Fix(f"Change to `{meant[1]}`", span, meant[1])
    text = span.source.text
    heads = list(_HEAD.finditer(text))
    below = heads[-1].end() if heads else 0
    if added := _IMPORT.fullmatch(found.help):
        return Fix(f"Add `{added[1]}`", Span(span.source, below, below), f"{added[1]}\n")
    if declared := _DECLARATION.match(found.help):
        gap = "\n" if heads else ""
        line = f"{gap}{declared[1]}\n"
        return Fix(f"Declare `{declared[1]}`", Span(span.source, below, below), line)
    if (variable := _VARIABLE.fullmatch(found.help)) and (at := _inside(variable[1], text)):
        rest = "" if text.startswith("\n", at) else "\n "
        line = f"\n  {variable[2]}{rest}"
        return Fix(f"Declare `{variable[2]}`", Span(span.source, at, at), line)
    return None


def _inside(owner: str, text: str) -> int | None:
    """Where the next value of a state machine or of a fitness goes: below those that it has."""
    head = re.search(
        rf"^(?!\s*//)[^\n]*\b(?:statemachine|fitness)\s+{owner}\s*\{{", text, re.MULTILINE
    )
    if head is None:
        return None
    at = head.end()
    for line in _LINE.finditer(text, at):
        if line["value"]:
            at = line.end()
        elif line["other"]:
            break
    return at
