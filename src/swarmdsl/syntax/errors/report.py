"""Report a syntax error: from the expected terminals to a message with a hint."""

from __future__ import annotations

import re
from collections.abc import Iterable

from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.errors.delayed import find_delayed_error
from swarmdsl.syntax.errors.foreign_statements import foreign_statement_hint
from swarmdsl.syntax.errors.foreign_tokens import foreign_token_hint
from swarmdsl.syntax.errors.hints import strange_character, token_hint
from swarmdsl.syntax.errors.property_hints import fact_hint, property_hint
from swarmdsl.syntax.errors.slips import find_keyword, find_unit
from swarmdsl.syntax.parser.keywords import FIRST, RESERVED
from swarmdsl.syntax.parser.patched_text import PatchedText

# Terminals of the grammar in messages.
TERMINALS = {
    "IDENT": "a name",
    "QNAME": "a name",
    "WORD": "a name",
    "PORTWORD": "a name",
    "INTERFACE": "the name of an interface",
    "TYPENAME": "a type",
    "QUOTED": "a string in double quotes",
    "ARRAY": "`[`",
    "STRINGBOUND": "`<=`",
    "LIBRARY": "the name of a package",
    "INTEGER": "a whole number",
    "MINUS": "`-`",
    "BOUND": "a number or `*`",
    "UNIT": "a unit",
    "LENGTH": "a length such as `10 m`",
    "QUANTITY": "a value",
    "PREFIX": "a value",
    "ROOT": "a value",
    "PRIMARY": "a value",
    "INDEX": "a number",
    "NOCOLON": "another fact",
    "PROBABILITY": "a probability such as `0.9`",
    "BEFOREDOT": "`.`",
    "DOTTED": "`.`",
    "BEFOREINDEX": "an index",
    "LATER": "`after`",
    "EOF": "the end of the file",
}
# A phrase for several keywords, where all of them are expected; the first that fits.
_GROUPS = {
    "a declaration": FIRST["Declaration"] | FIRST["Optimization"],
    "a trigger": FIRST["Trigger"],
    "an effect": FIRST["Effect"],
    "an item of a state": FIRST["StateItem"],
    "an item of a state machine": FIRST["MachineItem"],
    "an item of a region": FIRST["RegionItem"],
    "an item of a member": FIRST["MemberItem"],
}
_OPERANDS = {
    "a name",
    "a string in double quotes",
    "`true`",
    "`false`",
    "`event`",
    "`self`",
    "`in`",
    "`neighbors`",
    "`(`",
}
# Left out of a message next to a phrase that covers them.
_IMPLIED = {
    "a trigger": {"a name"},
    "an effect": {"a value", *_OPERANDS},
    "a declaration": {"the end of the file", "`package`", "`import`"},
    "an item of a member": {"a name"},
    "a value": _OPERANDS,
}
# Left out of a message when something more specific is expected.
_OPERATORS = {
    *("and", "or", "==", "!=", "<=", ">=", "<", ">", "+", "*", "/", "%", ".", "not", "-"),
    "an index",
}
# Continuations of a statement that could end here.
_CONTINUATIONS = {
    f"`{word}`" for word in ("[", ",", "->", "/", "(", "{", "=", "on", "gives", "extends", "in")
}
# Continuations of the line above.
_LINE_CONTINUATIONS = {
    f"`{word}`" for word in (",", "->", "/", "(", "{", "=", "on", "gives", "extends", "..", "in")
}
_COLON = re.compile(r"[ \t]*:")
_MAX_SHOWN = 8

TOKEN = re.compile(
    r'"(?:[^"\\\n]|\\[^\n])*"|[^\W\d]\w*|\d[\w.]*|-*->|=+>|[-+*/:=!<>]=|\+\+|--|&&|\|\||::|<<|>>|\.\.|\S'
)


@dataclass(frozen=True, slots=True)
class Failure:
    """Farthest offset that any alternative reached, and the terminals expected there.

    `expected` are names of terminals of the grammar, and keywords and symbols in backquotes.
    """

    at: int
    expected: frozenset[str]


def report_syntax_error(
    failure: Failure, source: Source, patched: PatchedText, report: Diagnostics
) -> int:
    """Report a syntax error in `patched`, a segment of the source; return its offset there.

    This is the first unexpected token, or the token after which something is missing.
    """
    at, text = failure.at, patched.text
    words = _words(failure.expected)
    found = TOKEN.match(text, at)
    before = _token_before(text, at)
    wants_name = "a name" in words
    new_line = before is not None and "\n" in text[before.end() : at]
    if before and before[0] == ":" and wants_name:
        words = words - {"a name"} | {"a type"}
    inside = before is not None and before[0] not in "{};" and not new_line
    complete = found is not None and inside and _may_begin_anew(words)
    anew = found is not None and new_line and _may_begin_anew(words)
    # An unexpected `[` is not expected: it begins a malformed array.
    expected = _grouped(words - {f"`{text[at : at + 1]}`"}, complete=complete, anew=anew)

    def place(token: re.Match[str]) -> Span:
        start = patched.origins[token.start()]
        return Span(source, start, max(start, patched.origins[token.end()]))

    if before and (late := find_delayed_error(text, at, before.start())):
        start, end, message, help_ = late
        span = Span(source, patched.origins[start], patched.origins[end])
        report.report("syntax-error", span, message=message, help=help_)
        return start
    if found and (strange := strange_character(text[at])):
        report.report(
            "syntax-error",
            Span(source, place(found).start, place(found).start + 1),
            message=f"unexpected character {strange}",
            help="write a plain space" if text[at].isspace() else "delete it",
        )
    elif (
        found
        and wants_name
        and found[0] in RESERVED
        and (not new_line or _COLON.match(text, found.end()))
    ):
        report.report(
            "keyword-as-name",
            place(found),
            word=found[0],
            help=foreign_statement_hint(words, text, at)
            or Advice(f"choose another name, for example `{found[0]}_`", "propose", f"{found[0]}_"),
        )
    elif before and (found is None or (new_line and not _may_begin_anew(words))):
        # The error is where something is missing, not on the next line.
        message = f"expected {_either(expected)} after `{before[0]}`"
        end = before.end()
        help_ = foreign_statement_hint(words, text, end) or fact_hint(words, text, end)
        span = place(before)
        number = _token_before(text, before.start())
        # The parser took a unit for the name of a role or field.
        if help_ is None and number is not None and (slip := find_unit(number, before)):
            start, end, message, help_ = slip
            span = Span(source, patched.origins[start], patched.origins[end])
        report.report("syntax-error", span, message=message, help=help_)
        return before.start()
    else:
        what = f"`{found[0]}`" if found else "the end of the file"
        end = len(source.text)
        span = place(found) if found else Span(source, end, end)
        message = f"expected {_either(expected)}, found {what}"
        slip = find_unit(before, found) if before and found else None
        help_ = _hint(words, before, found) if found and slip is None else None
        if before and found and slip is None and help_ is None:
            slip = find_keyword(words, before, found)
        if slip is not None:
            start, end, message, help_ = slip
            span = Span(source, patched.origins[start], patched.origins[end])
        report.report("syntax-error", span, message=message, help=help_)
    return min(at, len(text))


def _hint(words: set[str], before: re.Match[str] | None, found: re.Match[str]) -> str | None:
    at, text = found.start(), found.string
    return (
        foreign_statement_hint(words, text, at)
        or property_hint(words, text, at)
        or foreign_token_hint(words, text, at)
        or token_hint(words, before, found)
    )


def _may_begin_anew(words: set[str]) -> bool:
    """Return True if a statement may begin here: then the next line is at fault itself."""
    return "`}`" in words or "the end of the file" in words


def _words(expected: Iterable[str]) -> set[str]:
    """Return phrases for terminals; keywords stay in backquotes.

    A separator of statements is left out: a line break does the same.
    """
    return {TERMINALS.get(terminal, terminal) for terminal in expected} - {"`;`"}


def _grouped(words: set[str], *, complete: bool, anew: bool) -> list[str]:
    """Summarize expected words, with the most general ones last.

    If the statement before is `complete` and on the same line, words that could begin another one
    become "the end of the line". If a line begins `anew`, it does not continue the one above.
    """
    general = []
    for phrase, members in _GROUPS.items():
        group = {f"`{word}`" for word in members}
        if group <= words:
            words = words - group
            general.append(phrase)
    for phrase in (*general, "a value"):
        if phrase in words or phrase in general:
            words = words - _IMPLIED.get(phrase, set())
    if "`=`" in words:
        words = words - {"`(`"}  # a call has no value to assign
    if anew and general:
        words = words - _LINE_CONTINUATIONS
        if not {"an item of a state", "`else`"} & {*general, *words}:
            words = words - {"`[`"}  # no guard begins here
    if complete:
        words = words & _CONTINUATIONS
        general = ["the end of the line"]
    specific = {word for word in words if word.strip("`") not in _OPERATORS}
    shown = (specific or words) if not general else specific
    return [*sorted(shown, key=lambda word: (not word.startswith("`"), word)), *general]


def _either(expected: list[str]) -> str:
    if not expected:
        return "something else"
    if len(expected) > _MAX_SHOWN:
        return ", ".join([*expected[: _MAX_SHOWN - 1], "..."])
    return " or ".join(filter(None, (", ".join(expected[:-1]), expected[-1])))


def _token_before(text: str, at: int) -> re.Match[str] | None:
    """Find the last token before an offset, without comments."""
    code = re.sub(r"//[^\n]*|/\*(?:[^*]|\*(?!/))*\*/", lambda c: " " * len(c[0]), text[:at])
    tokens = list(TOKEN.finditer(code, max(code.rstrip().rfind("\n"), 0)))
    return tokens[-1] if tokens else None
