"""The smallest change to a statement that makes the parser accept it.

This is not what the writer meant, but what keeps most of what was written: first one token is
put in, left out or replaced, then another, and at last the rest of the statement is left out.
What is tried is put between the headers of the blocks around it, so that the size of the file
does not matter.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from swarmdsl.brackets import Repair
from swarmdsl.draft import Draft
from swarmdsl.slips import replacement
from swarmdsl.statements import Statement
from swarmdsl.syntax_advice import keywords
from swarmdsl.syntax_errors import TOKEN, Failure

_PLACEHOLDERS = {
    "IDENT": "_",
    "QNAME": "_",
    "WORD": "_",
    "INTERFACE": "_",
    "TYPENAME": "_",
    "LIBRARY": "_",
    "QUOTED": '""',
    "INTEGER": "0",
    "BOUND": "1",
    "LENGTH": "1 m",
    "QUANTITY": "0",
}
_SYMBOLS = ("`:`", "`->`", "`=`", "`=>`", "`..`", "`)`", "`]`", "`(`", "`[`", "`,`", "`/`", "`.`")
# Of several keywords that would do, the one that says least.
_KEYWORDS = ("`state`", "`swarm`", "`in`", "`on`", "`of`", "`x`")
_STEPS = 4
_MOST_PLACEHOLDERS = 6


@dataclass(frozen=True, slots=True)
class Mended:
    """A statement that can be read again; `whole` if nothing of its meaning was left open."""

    draft: Draft
    whole: bool


def mend(
    draft: Draft, statement: Statement, parse: Callable[[str], Failure | None]
) -> Mended | None:
    """Repair the header of a statement; None if nothing helps, or nothing of it is wrong alone."""
    text = draft.text
    before = "".join(text[start:end] + "\n" for start, end in statement.around)
    block = "{ }" if text[statement.header : statement.end] else ""
    after = f" {block}\n" + "}" * len(statement.around)

    def attempt(header: Draft) -> Failure | None:
        failure = parse(before + header.text + after)
        if failure is None:
            return None
        return Failure(failure.at - len(before), failure.expected)

    header = draft.piece(statement.start, statement.header)
    failure = attempt(header)
    if failure is None or failure.at < 0:
        return None
    mended = _edited(header, failure, attempt) or _cut(header, failure, attempt)
    if mended is None:
        return None
    return Mended(
        Draft(
            text[: statement.start] + mended.draft.text + text[statement.header :],
            [
                *draft.origins[: statement.start],
                *mended.draft.origins[:-1],
                *draft.origins[statement.header :],
            ],
        ),
        mended.whole,
    )


def _edited(
    header: Draft, failure: Failure, attempt: Callable[[Draft], Failure | None]
) -> Mended | None:
    """Change a few tokens, each time the one the parser stops at."""
    whole = True
    for _ in range(_STEPS):
        furthest: tuple[int, Draft, Failure, bool] | None = None
        for repair, sure in _candidates(header.text, failure):
            changed = header.repaired(repair)
            result = attempt(changed)
            if result is None:
                return Mended(changed, whole and sure)
            gained = len(header.text) - len(changed.text) + result.at - failure.at
            if result.at > repair.start + len(repair.text) and (
                furthest is None or gained > furthest[0]
            ):
                furthest = gained, changed, result, sure
        if furthest is None or furthest[0] <= 0:
            return None
        _, header, failure, sure = furthest
        whole = whole and sure
    return None


def _cut(
    header: Draft, failure: Failure, attempt: Callable[[Draft], Failure | None]
) -> Mended | None:
    """Leave out the rest of a header, and put placeholders for what it has to have."""
    header = header.blanked(min(failure.at, len(header.text)), len(header.text))
    for _ in range(_MOST_PLACEHOLDERS):
        result = attempt(header)
        if result is None:
            return Mended(header, whole=False)
        at = len(header.text.rstrip())
        tried = (header.repaired(Repair(at, at, f" {word}")) for word in _missing(result))
        better = []
        for changed in tried:
            after = attempt(changed)
            if after is None:
                return Mended(changed, whole=False)
            better.append((after.at - len(changed.text), changed))
        if not better:
            return None
        header = max(better, key=lambda one: one[0])[1]
    return None


def _missing(failure: Failure) -> list[str]:
    """What could be put where the parser stops, what says least first."""
    expected = failure.expected
    symbols = [word.strip("`") for word in _SYMBOLS if word in expected]
    places = [text for terminal, text in _PLACEHOLDERS.items() if terminal in expected]
    words = [word for word in _KEYWORDS if word in expected]
    words += sorted(word for word in expected if re.fullmatch(r"`[a-z]+`", word))
    return list(dict.fromkeys([*symbols, *places, *(word.strip("`") for word in words)]))


def _candidates(text: str, failure: Failure) -> Iterator[tuple[Repair, bool]]:
    """Changes at the token that the parser stops at, and whether they leave nothing open."""
    end = len(text.rstrip())
    at = min(failure.at, end)
    found = TOKEN.match(text, at) if at < end else None
    gap = len(text[:at].rstrip())
    if found is not None:
        if meant := replacement(failure.expected, text, at):
            yield Repair(*meant), "_" not in meant[2]
        if found[0] in keywords() and failure.expected & {"IDENT", "QNAME", "TYPENAME"}:
            yield Repair(at, found.end(), "_" * len(found[0])), False
        if not found[0][0].isalnum():
            yield Repair(at, found.end(), " " * len(found[0])), found[0] in ";,"
    for word in _missing(failure):
        symbol = f"`{word}`" in _SYMBOLS
        yield Repair(gap, gap, f" {word} "), symbol
    if "`{`" in failure.expected and at == end:
        yield Repair(gap, gap, " { }"), False
    if found is not None:
        for word in _missing(failure)[:4]:
            yield Repair(at, found.end(), word), False
        yield Repair(at, found.end(), " " * len(found[0])), False
