"""Quick fixes derived from the help of diagnostics."""

from __future__ import annotations

import re
from collections.abc import Iterable

from swarmdsl.base.diagnostics.collector import Diagnostic
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import Declaration, Fitness, FitnessInput, Param, StateMachine, Variable

_MEANT = re.compile(r"did you mean `([^`]+)`\?")
_IMPORT = re.compile(r"add `(import [^`]+)`")
_DECLARATION = re.compile(r"declare it: `([^`]+)`")
_VARIABLE = re.compile(r"declare it in `(\w+)`: `([^`]+)`")
_SEPARATOR = re.compile(r"begin it on a line of its own, or write `(.)` before it;.*")
_NAME = re.compile(r"[\w./]+")
# Rest of a line that has no further code.
_REST = re.compile(r"[ \t]*(?://[^\n]*)?(?=\n|\Z)")
# Between the name of a declaration and its body.
_OPENING_BRACE = re.compile(r"(?:\s|//[^\n]*|/\*.*?\*/)*\{", re.DOTALL)
_HEAD = re.compile(r"^(?:package|import)\b[^\n]*\n", re.MULTILINE)


@dataclass(frozen=True)
class QuickFix:
    """Title of a fix, and the replacement of a span."""

    title: str
    span: Span
    text: str


def quick_fix(found: Diagnostic, declarations: Iterable[Declaration]) -> QuickFix | None:
    """Return the fix that a diagnostic proposes, or None if it has no unique one.

    `declarations` are those of its file.
    """
    if found.primary is None or found.help is None:
        return None
    span = found.primary.span.absolute
    if (meant := _MEANT.fullmatch(found.help)) and _NAME.fullmatch(span.text):
        return QuickFix(f"Change to `{meant[1]}`", span, meant[1])
    text = span.source.text
    if separator := _SEPARATOR.fullmatch(found.help):
        end = len(text[: span.start].rstrip())
        return QuickFix(
            f"Insert `{separator[1]}`", Span(span.source, end, span.start), f"{separator[1]} "
        )
    heads = list(_HEAD.finditer(text))
    below = heads[-1].end() if heads else 0
    if added := _IMPORT.fullmatch(found.help):
        return QuickFix(f"Add `{added[1]}`", Span(span.source, below, below), f"{added[1]}\n")
    if declared := _DECLARATION.match(found.help):
        gap = "\n" if heads else ""
        line = f"{gap}{declared[1]}\n"
        return QuickFix(f"Declare `{declared[1]}`", Span(span.source, below, below), line)
    if variable := _VARIABLE.fullmatch(found.help):
        owner = next((each for each in declarations if each.name == variable[1]), None)
        at = _end_of_values(owner, text) if isinstance(owner, (StateMachine, Fitness)) else None
        if at is None:
            return None
        rest = "" if text.startswith("\n", at) else "\n "
        line = f"\n  {variable[2]}{rest}"
        return QuickFix(f"Declare `{variable[2]}`", Span(span.source, at, at), line)
    return None


def _end_of_values(owner: StateMachine | Fitness, text: str) -> int | None:
    """Return the offset after the last value of a declaration, or after its opening brace."""
    values = [each for each in owner.items if isinstance(each, (Param, Variable, FitnessInput))]
    if values:
        end = values[-1].span.absolute.end
    else:
        opening = _OPENING_BRACE.match(text, owner.name.span.absolute.end)
        if opening is None:
            return None
        end = opening.end()
    rest = _REST.match(text, end)
    return rest.end() if rest is not None else end
