"""What a parser's complaint means, in the words of the language."""

from __future__ import annotations

import re
from collections.abc import Iterable

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.errors.delayed import noticed_late
from swarmdsl.syntax.errors.foreign_statements import habit
from swarmdsl.syntax.errors.foreign_tokens import foreign
from swarmdsl.syntax.errors.hints import advice, strange_character
from swarmdsl.syntax.parser.keywords import FIRST, RESERVED
from swarmdsl.syntax.parser.patched_text import Draft

# How terminals of the grammar are called when one of them is missing.
TERMINALS = {
    "IDENT": "a name",
    "QNAME": "a name",
    "WORD": "a name",
    "INTERFACE": "the name of an interface",
    "TYPENAME": "a type",
    "QUOTED": "a text in double quotes",
    "ARRAY": "`[`",
    "STRINGBOUND": "`<=`",
    "LIBRARY": "the name of a package",
    "INTEGER": "a whole number",
    "MINUS": "`-`",
    "BOUND": "a number or `*`",
    "LENGTH": "a length such as `10 m`",
    "QUANTITY": "a value",
    "PREFIX": "a value",
    "ROOT": "a value",
    "PRIMARY": "a value",
    "EOF": "the end of the file",
}
# A phrase for several keywords, where all of them are expected; the first that fits.
_GROUPS = {
    "a declaration": FIRST["Declaration"] | FIRST["Optimization"],
    "a trigger": FIRST["Trigger"],
    "an item of a state": FIRST["StateItem"],
    "an item of a state machine": FIRST["MachineItem"],
    "an item of a region": FIRST["RegionItem"],
    "an item of a member": FIRST["MemberItem"],
}
# Left out when these are possible: they say it all.
_IMPLIED = {
    "a trigger": {"a name"},
    "a declaration": {"the end of the file", "`package`", "`import`"},
    "an item of a member": {"a name"},
    "a value": {"a name", "a text in double quotes", "`true`", "`false`", "`event`", "`(`"},
}
# Left out of a list of what is possible when something more specific is there.
_OPERATORS = {"and", "or", "==", "!=", "<=", ">=", "<", ">", "+", "*", "/", "%", ".", "not", "-"}
# What goes on behind something that could as well be complete.
_GOES_ON = {f"`{word}`" for word in ("[", ",", "->", "/", "(", "{", "=", "on", "gives", "extends")}
# The same for what belongs to the line above.
_ABOVE = {f"`{word}`" for word in (",", "->", "/", "(", "=", "on", "gives", "extends", "..")}
_COLON = re.compile(r"[ \t]*:")
_MOST_SHOWN = 8

TOKEN = re.compile(
    r'"(?:[^"\\\n]|\\[^\n])*"|[^\W\d]\w*|\d[\w.]*|-*->|=+>|[-+*/:=!<>]=|\+\+|--|&&|\|\||::|<<|>>|\.\.|\S'
)


@dataclass(frozen=True, slots=True)
class Failure:
    """Where a parser had to stop, and what could have stood there.

    `at` is the offset of the first token that does not fit, the furthest that any
    alternative came. `expected` are the names of terminals of the grammar, and keywords and
    symbols in backquotes.
    """

    at: int
    expected: frozenset[str]


def report_syntax_error(failure: Failure, source: Source, draft: Draft, report: Diagnostics) -> int:
    """Report a syntax error in `draft`, a piece of the source; return its place in the draft.

    This is the first token that does not fit, or the one behind which something is missing.
    """
    at, text = failure.at, draft.text
    words = _words(failure.expected)
    found = TOKEN.match(text, at)
    before = _token_before(text, at)
    wants_name = "a name" in words
    new_line = before is not None and "\n" in text[before.end() : at]
    if before and before[0] == ":" and wants_name:
        words = words - {"a name"} | {"a type"}
    inside = before is not None and before[0] not in "{}" and not new_line
    complete = found is not None and inside and _may_begin_anew(words)
    anew = found is not None and new_line and _may_begin_anew(words)
    # What looks like what is expected, and is not: an array whose size is none.
    expected = _grouped(words - {f"`{text[at : at + 1]}`"}, complete=complete, anew=anew)

    def place(token: re.Match[str]) -> Span:
        start = draft.origins[token.start()]
        return Span(source, start, max(start, draft.origins[token.end()]))

    if before and (late := noticed_late(text, at, before.start())):
        start, end, message, help_ = late
        span = Span(source, draft.origins[start], draft.origins[end])
        report.report("syntax-error", span, message=message, help=help_)
        return start
    if found and (strange := strange_character(text[at])):
        report.report(
            "syntax-error",
            Span(source, place(found).start, place(found).start + 1),
            message=f"the character {strange} cannot stand here",
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
            help=habit(words, text, at) or f"choose another name, `{found[0]}_` for instance",
        )
    elif before and (found is None or (new_line and not _may_begin_anew(words))):
        # The mistake is where something is missing, not at the line that follows.
        message = f"expected {_either(expected)} after `{before[0]}`"
        help_ = habit(words, text, before.end())
        report.report("syntax-error", place(before), message=message, help=help_)
        return before.start()
    else:
        what = f"`{found[0]}`" if found else "the end of the file"
        end = len(source.text)
        report.report(
            "syntax-error",
            place(found) if found else Span(source, end, end),
            message=f"expected {_either(expected)}, found {what}",
            help=habit(words, text, at) or foreign(words, text, at) or advice(words, before, found)
            if found
            else None,
        )
    return min(at, len(text))


def _may_begin_anew(words: set[str]) -> bool:
    """Whether a new statement may begin here, so that the next line is to blame itself."""
    return "`}`" in words or "the end of the file" in words


def _words(expected: Iterable[str]) -> set[str]:
    """What could have stood here: phrases, and keywords in backquotes."""
    return {TERMINALS.get(terminal, terminal) for terminal in expected}


def _grouped(words: set[str], *, complete: bool, anew: bool) -> list[str]:
    """The same in few words, the most general ones last.

    Where what stands before is `complete`, and what stands here on its line, what could begin
    behind it is called the end of the line. Where a line begins `anew`, nobody means to go on
    with what stands above it.
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
        words = words - {"`(`"}  # nothing is assigned to a call
    if anew and general:
        words = words - _ABOVE
        if not {"an item of a state", "`else`"} & {*general, *words}:
            words = words - {"`[`"}  # no guard begins here
    if complete:
        words = words & _GOES_ON
        general = ["the end of the line"]
    specific = {word for word in words if word.strip("`") not in _OPERATORS}
    shown = (specific or words) if not general else specific
    return [*sorted(shown, key=lambda word: (not word.startswith("`"), word)), *general]


def _either(expected: list[str]) -> str:
    if not expected:
        return "something else"
    if len(expected) > _MOST_SHOWN:
        return ", ".join([*expected[: _MOST_SHOWN - 1], "..."])
    return " or ".join(filter(None, (", ".join(expected[:-1]), expected[-1])))


def _token_before(text: str, at: int) -> re.Match[str] | None:
    """The last token before an offset, comments left out."""
    code = re.sub(r"//[^\n]*|/\*(?:[^*]|\*(?!/))*\*/", lambda c: " " * len(c[0]), text[:at])
    tokens = list(TOKEN.finditer(code, max(code.rstrip().rfind("\n"), 0)))
    return tokens[-1] if tokens else None
