"""Changes of a text that mend what a diagnostic is about, where its way out is one."""

from __future__ import annotations

import re

from swarmdsl.dataclass import dataclass
from swarmdsl.diagnostics import Diagnostic
from swarmdsl.source import Span

_MEANT = re.compile(r"did you mean `([^`]+)`\?")
_IMPORT = re.compile(r"add `(import [^`]+)`")
_NAME = re.compile(r"[\w./]+")
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
    if added := _IMPORT.fullmatch(found.help):
        heads = list(_HEAD.finditer(span.source.text))
        at = heads[-1].end() if heads else 0
        return Fix(f"Add `{added[1]}`", Span(span.source, at, at), f"{added[1]}\n")
    return None
