"""What a parser's complaint means, in the words of the language."""

from __future__ import annotations

import re
from functools import cache
from typing import Any

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.resources import grammar
from swarmdsl.source import Source, Span

# How terminals of the grammar are called when one of them is missing.
_WORDS = {
    "IDENT": "a name",
    "QNAME": "a name",
    "WORD": "a name",
    "INTERFACE": "the name of an interface",
    "TYPENAME": "a type",
    "QUOTED": 'text in `"`',
    "ARRAY": "`[`",
    "MINUS": "`-`",
    "BOUND": "a number or `*`",
    "LENGTH": "a length such as `10 m`",
    "QUANTITY": "a value",
    "PREFIX": "a value",
    "ROOT": "a value",
    "PRIMARY": "a value",
    "EOF": "the end of the file",
}
_DECLARATIONS = {
    f"`{word}`"
    for word in (
        *(
            "struct",
            "enum",
            "type",
            "const",
            "message",
            "service",
            "action",
            "swarm",
            "event",
            "function",
        ),
        *("sensor", "actuator", "controller", "virtual", "member"),
        *("endless", "statemachine", "environment", "fitness", "optimize"),
    )
}
# Left out of a list of what is possible when something more specific is there.
_OPERATORS = {"and", "or", "==", "!=", "<=", ">=", "<", ">", "+", "*", "/", "%", ".", "not", "-"}
_MOST_SHOWN = 8

_TOKEN = re.compile(r'"(?:[^"\\\n]|\\[^\n])*"|[A-Za-z_]\w*|\d[\w.]*|->|=>|[=!<>]=|\.\.|\S')


def report_syntax_error(
    error: Any, source: Source, offset: int, text: str, report: Diagnostics
) -> int:
    """Report a textX syntax error in `text`, which stands at `offset`; return its place.

    The place is an offset in the source, that of the first token that does not fit.
    """
    at = error.__cause__.position
    expected = _expected(error.expected_rules)
    found = _TOKEN.match(text, at)
    span = Span(source, offset + at, offset + (found.end() if found else at))
    before = _token_before(text, at)
    wants_name = "a name" in expected
    if found and wants_name and found[0] in keywords() and not _new_line(text, at, before):
        report.report(
            "keyword-as-name",
            span,
            word=found[0],
            help=f"choose another name, `{found[0]}_` for instance",
        )
    elif before and (
        found is None or (_new_line(text, at, before) and not _may_begin_anew(expected))
    ):
        # The mistake is where something is missing, not at the line that follows.
        place = Span(source, offset + before.start(), offset + before.end())
        report.report(
            "syntax-error", place, message=f"expected {_either(expected)} after `{before[0]}`"
        )
        return place.start
    else:
        what = f"`{found[0]}`" if found else "the end of the file"
        report.report("syntax-error", span, message=f"expected {_either(expected)}, found {what}")
    return span.start


@cache
def keywords() -> frozenset[str]:
    """The reserved words, as `grammar/lexical.tx` lists them."""
    text = (grammar() / "lexical.tx").read_text(encoding="utf-8")
    found = re.search(r"^IDENT: /\(\?!\(\?:([a-z|]+)\)", text, re.MULTILINE)
    assert found is not None
    return frozenset(found[1].split("|"))


def _may_begin_anew(expected: list[str]) -> bool:
    """Whether a new statement may begin here, so that the next line is to blame itself."""
    return "`}`" in expected or "the end of the file" in expected


def _expected(rules: list[Any]) -> list[str]:
    """What could have stood here, each once, phrases before keywords."""
    words: dict[str, None] = {}
    for rule in rules:
        name, literal = rule.rule_name, getattr(rule, "to_match", "")
        if name in _WORDS:
            words.setdefault(_WORDS[name])
        elif name != "Comment":
            words.setdefault(f"`{literal}`")
    if words.keys() >= _DECLARATIONS:
        words = {"a declaration": None} | {w: None for w in words if w not in _DECLARATIONS}
    specific = [word for word in words if word.strip("`") not in _OPERATORS]
    return sorted(specific or words, key=lambda word: word.startswith("`"))


def _either(expected: list[str]) -> str:
    if not expected:
        return "something else"
    shown = expected if len(expected) <= _MOST_SHOWN else [*expected[: _MOST_SHOWN - 1], "..."]
    if len(shown) == 1:
        return shown[0]
    return f"{', '.join(shown[:-1])} or {shown[-1]}" if shown[-1] != "..." else ", ".join(shown)


def _token_before(text: str, at: int) -> re.Match[str] | None:
    """The last token before an offset, comments left out."""
    code = re.sub(r"//[^\n]*|/\*(?:[^*]|\*(?!/))*\*/", lambda c: " " * len(c[0]), text[:at])
    tokens = list(_TOKEN.finditer(code, max(code.rstrip().rfind("\n"), 0)))
    return tokens[-1] if tokens else None


def _new_line(text: str, at: int, before: re.Match[str] | None) -> bool:
    return before is not None and "\n" in text[before.end() : at]
