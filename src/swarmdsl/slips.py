"""What is likely meant by text that the language does not have: what to put in its place."""

from __future__ import annotations

import re

from swarmdsl.comments import starts_line
from swarmdsl.suggest import closest
from swarmdsl.syntax_advice import strange_character

# How like a keyword a word must be to be taken for it.
_SLIP = 0.82
# What is written, where these could stand (anywhere, if none), and what is meant by it.
_VALUE = frozenset({"PREFIX", "ROOT", "PRIMARY", "IDENT"})
_INSTEAD: tuple[tuple[str, frozenset[str], str], ...] = (
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
    (":", frozenset({"`->`"}), "->"),
    (":", frozenset({"`=`"}), "="),
    ("!", _VALUE, "not "),
)


# The same for what has many forms; the place is anywhere in it.
_PATTERNS: tuple[tuple[str, frozenset[str], str], ...] = (
    (r"(?<=\w)::(?=\w)", frozenset(), "/"),
    (r"(?<![=!<>:])=(?=[ \t]*[A-Za-z]\w*/)", frozenset({"`:`"}), ":"),
    (r"(?<![\w.])(\d+)\.(?![\d.])", frozenset(), r"\1.0"),
    (r"(?<=[\w*])-(?=[\w*])", frozenset({"`..`"}), ".."),
    (r"(?<=import )[ \t]*([\w./-]+\.swarm)\b", frozenset(), r'"\1"'),
    (r"(?<![\w.])(\d+(?:\.\d+)?)(?![\w.])", frozenset({"LENGTH"}), r"\1 m"),
    (r'"([A-Za-z_]\w*)"', frozenset({"IDENT"}), r"\1"),
    (r"(?<![\w.])(\d+)_(\d+)(?![\w.])", frozenset(), r"\1\2"),
    (r"(?<= on )[ \t]*([/~]?\w+(?:/\w+)*)(?![\w/\"])", frozenset({"QUOTED"}), r'"\1"'),
    (r"\((?![ \t]*\d+[ \t]*\))([^()\n]*)\)(?=[ \t]*(?:/|->))", frozenset({"`[`"}), r"[\1]"),
    (r"\((\d+(?:[ \t]*\.\.[ \t]*[\d*]+)?|\*)\)(?![ \t]*->)", frozenset({"`[`"}), r"[\1]"),
)
# Words of other languages, and how that is said in this one.
_FOREIGN = {
    "if": "a guard stands in square brackets: `on event [x < 3] -> Target`",
    "when": "a transition begins with `on`, and a guard stands in square brackets",
    "goto": "write `->` before the target",
    "then": "write `->` before the target",
    "transition": "a transition is written `on event [guard] / effect -> Target`, in its source",
    "from": 'an import is written `import "file.swarm"` or `import package.*`',
    "include": 'an import is written `import "file.swarm"`',
    "using": "an import is written `import package.*`",
    "class": "what a robot is made of is a `member`, its parts are `sensor`, `actuator`, ...",
    "robot": "a kind of robot is a `member`",
    "node": "a part of a robot is a `sensor`, `actuator`, `controller` or `virtual` component",
    "fsm": "a state machine begins with `statemachine`",
    "machine": "a state machine begins with `statemachine`",
    "topic": 'a topic belongs to an event or a port: `event Low : pkg/Type on "topic"`',
    "<": "this is not XML: a state is written `state Name { on event -> Target }`",
    "?": "there is no conditional value: use two transitions with guards",
    "$": "a name has ASCII letters, digits and `_`, and starts with no digit",
}


_ANYWHERE = ("if", "goto", "then", "?", "$")


def foreign(expected: set[str], text: str, at: int) -> str | None:
    """How to say here what the word at an offset says in other languages; None if unknown."""
    begins = starts_line(text, at)
    if text[at] == "{" and "`(`" in expected:
        return "arguments stand in parentheses"
    if text[at] == "=" and "`:`" in expected:
        return "a type stands before the value: `name : type = value`"
    if text[:at].rstrip().endswith(","):
        return "delete the `,` before it"
    if number := re.compile(r"\d+(?:_\d+)+\b").match(text, at):
        return f"write `{number[0].replace('_', '')}`"
    if re.compile(r"0[xXbB]").match(text, at):
        return "numbers are decimal"
    if begins and "`state`" in expected and re.compile(r"[A-Za-z_]\w*\s*\{").match(text, at):
        return "a state begins with `state`"
    if begins and re.compile(r"[A-Za-z_]\w*[ \t]*-+>").match(text, at):
        if "`on`" in expected:
            return "a transition begins with `on`"
        return "a transition stands in its source state: `on event -> Target`"
    found = re.compile(r"#?[ \t]*([A-Za-z]+)|\S").match(text, at)
    if found is None:
        return None
    word = found[1] if found[1] and (found[0][0] != "#" or found[1] == "include") else found[0]
    return _FOREIGN.get(word) if begins or word in _ANYWHERE else None


def replacement(expected: frozenset[str], text: str, at: int) -> tuple[int, int, str] | None:
    """What to put in place of which piece of `text`, where a parser stops; None if unknown."""
    for wrong, words, right in _INSTEAD:
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
        keyword = closest(word[0], literals, _SLIP)
        if keyword and keyword != word[0]:
            return at, word.end(), keyword
    return None


# Characters that word processors, web pages and other keyboards have for plain ones.
_LIKE = {
    "\u2018": '"', "\u2019": '"', "\u201c": '"', "\u201d": '"', "\u201e": '"',
    "\u2010": "-", "\u2011": "-", "\u2012": "-", "\u2013": "-", "\u2014": "-", "\u2212": "-",
    "\u2190": "<-", "\u2192": "->", "\u27f6": "->", "\u21d2": "=>",
    "\u2264": "<=", "\u2265": ">=", "\u2260": "!=", "\u00d7": "x", "\u00b7": "*",
    "\u2026": "..", "\uff1a": ":", "\uff1b": " ", "\uff0c": ",", "\uff08": "(", "\uff09": ")",
}  # fmt: skip


def likeness(character: str) -> str | None:
    """What a character that the language does not have is likely to stand for.

    This is a space for other kinds of space, nothing for what nobody can see, and None for a
    character that is like none.
    """
    if character.isspace():
        return " "
    return _LIKE.get(character, "" if strange_character(character) else None)
