"""Token substitutions that let the parser continue after foreign syntax."""

from __future__ import annotations

import re

from swarmdsl.base.suggest import closest
from swarmdsl.syntax.errors.hints import strange_character
from swarmdsl.syntax.errors.patterns import DELIVERY, UNIT

# Similarity from which a word is taken for a keyword.
_MIN_SIMILARITY = 0.82
_VALUE = frozenset({"PREFIX", "ROOT", "PRIMARY", "IDENT"})
# Text, terminals of which one must be expected (any, if none), and its replacement.
_SUBSTITUTIONS: tuple[tuple[str, frozenset[str], str], ...] = (
    ("-->", frozenset({"`->`"}), "->"),
    ("- >", frozenset({"`->`"}), "->"),
    ("==>", frozenset({"`->`"}), "->"),
    ("=>", frozenset({"`->`"}), "->"),
    ("->", frozenset({"`=>`"}), "=>"),
    *((update, frozenset({"`=`"}), "=") for update in (":=", "+=", "-=", "*=", "/=")),
    *((update, frozenset({"`=`"}), "= 0") for update in ("++", "--")),
    ("===", _VALUE, "=="),
    ("&&", frozenset(), "and"),
    ("||", frozenset(), "or"),
    ("<>", frozenset(), "!="),
    ("=", frozenset({"`]`"}), "=="),
    (": ->", frozenset({"`->`"}), "->"),
    (":", frozenset({"`->`"}), "->"),
    (":", frozenset({"`=`"}), "="),
    ("!", _VALUE, "not "),
)

# The same as regular expressions, which match around the error.
_PATTERNS: tuple[tuple[str, frozenset[str], str], ...] = (
    (rf"(?<=[\w\]] )({DELIVERY})(?=[ \t]*(?:$|//))", frozenset({"`{`"}), r"{ \1 }"),
    (rf"\[[ \t]*({DELIVERY})[ \t]*\]", frozenset({"`{`"}), r"{ \1 }"),
    (rf"\[[ \t]*({UNIT})[ \t]*\]", frozenset({"`in`"}), r" in \1"),
    (r"(?<=\w)::(?=\w)", frozenset(), "/"),
    (r"\bstate[ \t]+machine\b", frozenset({"`statemachine`"}), "statemachine"),
    (r"(?<![^\n])([ \t]*)(\w+\.\w+)(?=[ \t]*->)", frozenset({"`:`"}), r"\1connect \2"),
    (r"\benter(?=[ \t]+[A-Za-z_])", frozenset({"`->`"}), "->"),
    (r"(?<=\binitial )enter[ \t]+(\w+)", frozenset(), r"\1"),
    (r"(?<![=!<>:])=(?=[ \t]*[A-Za-z]\w*/)", frozenset({"`:`"}), ":"),
    (r"(?<![\w.])(\d+)\.(?![\d.])", frozenset(), r"\1.0"),
    (r"(?<=[\w*])-(?=[\w*])", frozenset({"`..`"}), ".."),
    (r"(?<=import )[ \t]*([\w./-]+\.swarm)\b", frozenset(), r'"\1"'),
    (r"(?<![\w.])(\d+(?:\.\d+)?)(?![\w.])", frozenset({"LENGTH"}), r"\1 m"),
    (r'"([A-Za-z_]\w*)"', frozenset({"IDENT"}), r"\1"),
    (r"(?<![\w.])(\d+)_(\d+)(?![\w.])", frozenset(), r"\1\2"),
    (r"(?<= on )[ \t]*([/~]?\w+(?:/\w+)*)(?![\w/\"])", frozenset({"QUOTED"}), r'"\1"'),
    (
        r"(?<!timeout)\((?![ \t]*\d+[ \t]*\))([^()\n]*)\)(?=[ \t]*(?:/|->))",
        frozenset({"`[`"}),
        r"[\1]",
    ),
    (r"\((\d+(?:[ \t]*\.\.[ \t]*[\d*]+)?|\*)\)(?![ \t]*->)", frozenset({"`[`"}), r"[\1]"),
)


def suggest_substitution(
    expected: frozenset[str], text: str, at: int
) -> tuple[int, int, str] | None:
    """Return the start and end of a range around `at` and its replacement; None if unknown."""
    for wrong, words, right in _SUBSTITUTIONS:
        starts = (at - back for back in range(min(len(wrong), at + 1)))
        start = next((each for each in starts if text.startswith(wrong, each)), None)
        if start is not None and (not words or words & expected):
            return start, start + len(wrong), right
    for pattern, words, right in _PATTERNS:
        line = text.rfind("\n", 0, at) + 1
        for found in re.compile(pattern).finditer(text, line):
            if found.start() > at:
                break
            if found.end() > at and (not words or words & expected):
                return found.start(), found.end(), found.expand(right)
    if between := re.compile(r"(?<=\w)-(?=\w)").match(text, at):
        return at, between.end(), "_"
    if quoted := re.compile(r"'([^'\"\n]*)'").match(text, at):
        return at, quoted.end(), f'"{quoted[1]}"'
    if comment := re.compile(r"#|--(?!>)").match(text, at):
        return at, comment.end(), "//"
    word = re.compile(r"[A-Za-z]+").match(text, at)
    if word and not text[word.end() : word.end() + 1].isalnum():
        literals = [one.strip("`") for one in expected if re.fullmatch(r"`[a-z]+`", one)]
        keyword = closest(word[0], literals, _MIN_SIMILARITY)
        if keyword and keyword != word[0]:
            return at, word.end(), keyword
    return None


# Typographic characters and the ASCII text that they stand for.
_EQUIVALENTS = {
    "\u2018": '"', "\u2019": '"', "\u201c": '"', "\u201d": '"', "\u201e": '"',
    "\u2010": "-", "\u2011": "-", "\u2012": "-", "\u2013": "-", "\u2014": "-", "\u2212": "-",
    "\u2190": "<-", "\u2192": "->", "\u27f6": "->", "\u21d2": "=>",
    "\u2264": "<=", "\u2265": ">=", "\u2260": "!=", "\u00d7": "x", "\u00b7": "*",
    "\u2026": "..", "\uff1a": ":", "\uff1b": " ", "\uff0c": ",", "\uff08": "(", "\uff09": ")",
}  # fmt: skip


def plain_equivalent(character: str) -> str | None:
    """Return the ASCII text that a character looks like; None for others.

    This is a space for other spaces, and the empty string for invisible characters.
    """
    if character.isspace():
        return " "
    return _EQUIVALENTS.get(character, "" if strange_character(character) else None)
