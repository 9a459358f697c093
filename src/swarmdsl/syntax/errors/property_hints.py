"""Hints for mistakes in properties: words of temporal logic, of other languages and of people."""

from __future__ import annotations

import re
from decimal import Decimal

from swarmdsl.base.diagnostics.advice import write, write_before

_PROPERTY = re.compile(r"^[ \t]*property\b[^{}\n]*\Z", re.MULTILINE)
_ALWAYS = "write `at all times` after the fact"
_EVENTUALLY = "write `eventually` before the fact"
_LEADS = write("P leads to Q")
# The words before the unexpected token.
_BEFORE = {
    "always": _ALWAYS,
    "globally": _ALWAYS,
    "henceforth": _ALWAYS,
    "G": _ALWAYS,
    "finally": _EVENTUALLY,
    "sometime": _EVENTUALLY,
    "F": _EVENTUALLY,
    "infinitely": "write `again and again` before the fact",
    "until": "write `before P,`, or `after P until Q,`",
    "whenever": _LEADS,
    "when": _LEADS,
    "if": _LEADS,
    "exists": "write `some` before the role",
}
_ROBOTS = re.compile(r"\b(?:forall|foreach|for|every|any)\s+(?:all\s+|each\s+|every\s+)?(\w+)\Z")
# The unexpected token itself.
_IMPLIES = "write `P leads to Q`, or `not P or Q at all times` for one moment"
_TIMES = write("at most N times")
_FOUND = {
    "implies": _IMPLIES,
    "=>": _IMPLIES,
    "==>": _IMPLIES,
    "->": _IMPLIES,
    "-->": _IMPLIES,
    "exactly": _TIMES,
    "once": _TIMES,
    "twice": _TIMES,
    "until": "write `after P until Q,` before the rest of the sentence",
    "not": "write `not` before the whole fact, as in `not all robot in State`",
    **dict.fromkeys(("receives", "gets", "handles"), write("hears")),
    **dict.fromkeys(("emits", "publishes", "raises"), write("sends")),
    **dict.fromkeys(("calls", "runs", "performs"), write("starts")),
    **dict.fromkeys(("finishes", "completes", "returns"), write("ends")),
}
_OUTCOMES = {
    **dict.fromkeys(("succeeds", "achieves", "succeeded"), "succeeded"),
    **dict.fromkeys(("aborts", "fails", "aborted"), "aborted"),
    "preempted": "preempted",
}
_TOKEN = re.compile(r"[A-Za-z_]\w*|[=\-]+>|\S")
_SOON = re.compile(r"(?:in|for|by)\s+(\d[\d.]*\s*[A-Za-z]+)")
_CHANCE = re.compile(r"with\s+(?:a\s+)?(?:probability|chance)(?:\s+of)?\s+([\d.]+)")
_COMPARED = re.compile(r"[\w.]+\s*(?:[=!<>]=|[<>])\s*[\w.]+")
_EVENT = re.compile(r"\b(?:sends|hears)\s+\w+\Z")
_FIELD_OF_EVENT = re.compile(r"\b((?:sends|hears)\s+\w+)\.(\w+)\Z")
_TEST = re.compile(
    r"""(?:with|where|if|when|has|[({])[\s(\[{]*(?:event\.)?
    ([A-Za-z_][\w.]*)\s*([=!<>]?=|[<>:])\s*("[^"\n]*"|[\w.]+)""",
    re.VERBOSE,
)
_COMPARED_TO = re.compile(r"([=!<>]?=|[<>])\s*(\"[^\"\n]*\"|[\w.]+)")
_NO_EVENT = re.compile(r"\b(?:in|starts|cancels|ends)\s+[\w.]+\Z")
_IN_CONDITION = re.compile(r"\[[^\[\]]*\Z")
_COUNT = re.compile(r"\bcount\s*\([^()]*\)\Z")
_WHO = re.compile(r"\w+(?:\[\d+\])?\Z")


def property_hint(expected: set[str], text: str, at: int) -> str | None:
    """Return a hint for an unexpected token in a property, None elsewhere or if there is none."""
    begun = _PROPERTY.search(text, 0, at)
    token = _TOKEN.match(text, at)
    if begun is None or token is None:
        return None
    said, found = begun[0].rstrip(), token[0]
    if found == "{" and "`:`" in expected:
        return "write `:` and one sentence"
    if " : " not in said and ":" not in said:
        return None
    last = re.search(r"\w+\Z", said)
    if robots := _ROBOTS.search(said if found == ":" else f"{said} {found}"):
        more = re.compile(r"\s*(\w+)").match(text, token.end())
        role = more[1] if robots[1] in ("all", "each", "every") and more else robots[1]
        return write(f"each {role} :")
    if re.search(r"\beventually\s+always\Z", said):
        return "name what it follows: `after P, Q at all times`"
    if last is not None and last[0] in _BEFORE and last.start() > said.index(":"):
        return _BEFORE[last[0]]
    if re.search(r"\bthen\s+eventually\Z", said):
        return _LEADS
    if about_message := _message_hint(said, found, text, at):
        return about_message
    if about_end := _outcome_hint(expected, said, text, at):
        return about_end
    if "`[`" in expected and re.search(r"\bhas\Z", said) and (test := _COMPARED.match(text, at)):
        return write(f"has [{test[0]}]")
    if "`:`" in expected and (each := re.search(r"\beach\s+\w+\Z", said)):
        return write(f"{each[0]} :") if found == "," else write_before(":", found)
    if "`until`" in expected and "`,`" in expected:
        return "end the first part with a comma: `after P, Q leads to R`"
    if soon := _SOON.match(text, at):
        return write(f"within {soon[1]}")
    if chance := _CHANCE.match(text, at):
        return write(f"at least {chance[1]}")
    if found == "%" and (number := re.search(r"[\d.]+\Z", said)):
        return write(f"{Decimal(number[0]) / 100}")
    if found == "." and re.search(r"(?:[<>=]|\bmost)\s*\d+\Z", said):
        return "write a whole number"
    if found == "." and (who := _WHO.search(said)):
        return f"write `{who[0]} in State`, or `{who[0]} has [x > 3]` for its variables"
    if found == ")" and re.search(r"\bcount\s*\(\s*\w+\Z", said):
        return write(f"{said[said.rindex('count') :]} in State)")
    if found == "least" and "`most`" in expected:
        return "write each time, as in `P then not P then P`"
    if found == "all" and "`least`" in expected:
        return "the sentence is about all times without it: leave `at all times` out"
    if found == "or" and re.search(r"\bbetween\b[^,]*\Z", said):
        return "put what is joined in parentheses"
    return _FOUND.get(found)


def _message_hint(said: str, found: str, text: str, at: int) -> str | None:
    """Return a hint for a condition after a fact that is written in another way."""
    if (event := _EVENT.search(said)) and (test := _TEST.match(text, at)):
        return write(f"{event[0]} [event.{test[1]} {_operator(test[2])} {test[3]}]")
    if (event := _FIELD_OF_EVENT.search(said)) and (test := _COMPARED_TO.match(text, at)):
        return write(f"{event[1]} [event.{event[2]} {_operator(test[1])} {test[2]}]")
    if (found == "," and _IN_CONDITION.search(said)) or (found == "[" and said.endswith("]")):
        return "join conditions with `and`, in one pair of brackets"
    if found == "[" and _NO_EVENT.search(said):
        return "only an event has a condition: write `and`, and a fact with `has [x > 3]`"
    return None


def _outcome_hint(expected: set[str], said: str, text: str, at: int) -> str | None:
    """Return a hint for an outcome that is written in another way, as in `robot aborts carry`."""
    written = re.compile(r"(\w+)(?:\s+([A-Za-z_][\w.]*))?").match(text, at)
    if written is None:
        return None
    verb, function = written[1], written[2]
    if "`ends`" in expected and verb not in _OUTCOMES:
        # It may have been taken for the name of a role.
        verb, function = said.split()[-1], verb
    if verb not in _OUTCOMES:
        return None
    if "`as`" in expected:
        return write(f"as {_OUTCOMES[verb]}")
    return write(f"ends {function} as {_OUTCOMES[verb]}") if function else None


def _operator(written: str) -> str:
    return "==" if written in ("=", ":") else written


def fact_hint(expected: set[str], text: str, at: int) -> str | None:
    """Return a hint for a property that ends after a fact or a number; None elsewhere."""
    begun = _PROPERTY.search(text, 0, at)
    if begun is None:
        return None
    if "`==`" in expected and (number := _COUNT.search(begun[0].rstrip())):
        return f"compare it, as in `{number[0]} > 1`"
    if "`leads`" not in expected:
        return None
    return "add `at all times`, or begin with `never` or `eventually`"


def word_hint(word: str) -> str | None:
    """Return a hint for a word that was taken for the name of a role; None if there is none."""
    return _BEFORE.get(word)
