"""The smallest change to a statement that makes the parser accept it.

This is not what the writer meant, but what keeps most of what was written: first one token is
put in, left out or replaced, then another, and at last the rest of the statement is left out.
What is tried is put between the headers of the blocks around it, so that the size of the file
does not matter.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from swarmdsl.base.records import dataclass, replace
from swarmdsl.syntax.errors.report import TOKEN, Failure
from swarmdsl.syntax.errors.substitutions import replacement
from swarmdsl.syntax.parser.keywords import RESERVED
from swarmdsl.syntax.parser.patched_text import Draft, Repair
from swarmdsl.syntax.recovery.statements import Statement

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
# A bracket that is put in may not be the one that was meant.
_OPENING = ("`(`", "`[`", "`/`", "`.`")
_SYMBOLS = ("`:`", "`->`", "`=`", "`=>`", "`..`", "`)`", "`]`", "`(`", "`[`", "`,`", "`/`", "`.`")
# Of several keywords that would do, the one that says least.
_KEYWORDS = ("`state`", "`swarm`", "`in`", "`on`", "`of`", "`x`")
_STEPS = 4
_MOST_PLACEHOLDERS = 6


@dataclass(frozen=True, slots=True)
class Mended:
    """A text in which a statement can be read again.

    `whole` if nothing of its meaning was left open, `guessed` if the keyword it begins with
    was chosen of several; `help` is how to write what was written otherwise.
    """

    draft: Draft
    whole: bool
    guessed: bool = False
    help: str | None = None


@dataclass(frozen=True, slots=True)
class _Change:
    repair: Repair
    whole: bool = False
    guessed: bool = False
    help: str | None = None


_Attempt = Callable[[Draft], Failure | None]


def mend(
    draft: Draft, statement: Statement, parse: Callable[[str], Failure | None]
) -> Mended | None:
    """Repair the header of a statement; None if nothing helps, or nothing of it is wrong alone."""
    text = draft.text
    before = "".join(text[start:end] + "\n" for start, end in statement.around)
    block = text[statement.header : statement.end]
    closers = "\n" + "}" * len(statement.around)

    def attempt(header: Draft, inside: str = " { }" if block else "") -> Failure | None:
        failure = parse(before + header.text + inside + closers)
        return failure and Failure(failure.at - len(before), failure.expected)

    header = draft.piece(statement.start, statement.header)
    failure = attempt(header)
    if failure is None or failure.at < 0:
        return None
    stop = statement.start + min(failure.at, len(header.text))
    if "`{`" in failure.expected and (indented := _indented(draft, stop)):
        return Mended(indented, whole=True, help="a block stands in `{` and `}`")
    mended = _edited(header, failure, attempt) or _cut(header, failure, attempt)
    if mended is None:
        return None
    if mended.guessed and (not block or attempt(mended.draft, block)):
        return None  # there is nothing to keep, or it is something else
    start, end = statement.start, statement.header
    repaired = Draft(
        text[:start] + mended.draft.text + text[end:],
        [*draft.origins[:start], *mended.draft.origins[:-1], *draft.origins[end:]],
    )
    return replace(mended, draft=repaired)


def _indented(draft: Draft, at: int) -> Draft | None:
    """The text with braces around the block behind `at`, where a colon may stand, as in Python."""
    text = draft.text
    line = text.rfind("\n", 0, at) + 1
    margin = len(text[line:at]) - len(text[line:at].lstrip())
    further = rf"\n[ \t]{{{margin + 1},}}\S[^\n]*"
    block = rf"(?P<colon>:?)[ \t]*(?://[^\n]*)?(?P<block>(?:{further}|\n[ \t]*(?=\n))+)"
    found = re.compile(block).match(text, at)
    if found is None or not found["block"].strip():
        return None
    end = found.start("block") + len(found["block"].rstrip())
    return draft.repaired(Repair(end, end, "\n}")).repaired(Repair(at, found.end("colon"), " {"))


def _edited(header: Draft, failure: Failure, attempt: _Attempt) -> Mended | None:
    """Change a few tokens, each time the one the parser stops at."""
    so_far = Mended(header, whole=True)
    for step in range(_STEPS):
        header = so_far.draft
        furthest: tuple[int, Mended, Failure] | None = None
        for change in _changes(header.text, failure):
            changed = header.repaired(change.repair)
            mended = Mended(
                changed,
                so_far.whole and change.whole,
                so_far.guessed or change.guessed,
                so_far.help if step else change.help,
            )
            result = attempt(changed)
            if result is None:
                return mended
            gained = len(header.text) - len(changed.text) + result.at - failure.at
            beyond = result.at > change.repair.start + len(change.repair.text)
            if beyond and gained > (furthest[0] if furthest else 0):
                furthest = gained, mended, result
        if furthest is None:
            return None
        _, so_far, failure = furthest
    return None


def _cut(header: Draft, failure: Failure, attempt: _Attempt) -> Mended | None:
    """Leave out the rest of a header, and put placeholders for what it has to have."""
    header = header.blanked(min(failure.at, len(header.text)), len(header.text))
    guessed = False
    for _ in range(_MOST_PLACEHOLDERS):
        result = attempt(header)
        if result is None:
            return Mended(header, whole=False, guessed=guessed)
        at = len(header.text.rstrip())
        tried = []
        missing = _missing(result)
        for word in missing:
            changed = header.repaired(Repair(at, at, f" {word}"))
            after = attempt(changed)
            guess = guessed or (at == 0 and word.isalpha() and len(missing) > 1)
            if after is None:
                return Mended(changed, whole=False, guessed=guess)
            tried.append((after.at - len(changed.text), changed, guess))
        if not tried:
            return None
        _, header, guessed = max(tried, key=lambda one: one[0])
    return None


def _missing(failure: Failure) -> list[str]:
    """What could be put where the parser stops, what says least first."""
    expected = failure.expected
    symbols = [word.strip("`") for word in _SYMBOLS if word in expected]
    places = [text for terminal, text in _PLACEHOLDERS.items() if terminal in expected]
    words = [word for word in _KEYWORDS if word in expected]
    words += sorted(word for word in expected if re.fullmatch(r"`[a-z]+`", word))
    return list(dict.fromkeys([*symbols, *places, *(word.strip("`") for word in words)]))


def _changes(text: str, failure: Failure) -> Iterator[_Change]:
    """Changes at the token that the parser stops at, what leaves least open first."""
    expected = failure.expected
    end = len(text.rstrip())
    at = min(failure.at, end)
    found = TOKEN.match(text, at) if at < end else None
    gap = len(text[:at].rstrip())
    if found is not None:
        if meant := replacement(expected, text, at):
            # A name that is written otherwise is another name.
            yield _Change(Repair(*meant), "_" not in meant[2], help=f"write `{meant[2].strip()}`")
        if found[0] in RESERVED and expected & {"IDENT", "QNAME", "TYPENAME"}:
            yield _Change(Repair(at, found.end(), "_" * len(found[0])))
        if not found[0][0].isalnum():
            yield _Change(Repair(at, found.end(), " " * len(found[0])), found[0] in ";,")
    missing = _missing(failure)
    # The keyword that a statement begins with says what it is.
    keyword_guess = at == 0 and sum(word.isalpha() for word in missing) > 1
    for word in missing:
        sure = f"`{word}`" in _SYMBOLS and f"`{word}`" not in _OPENING
        advice = f"write `{word}` before `{found[0]}`" if found and sure else None
        guessed = word.isalpha() and keyword_guess
        yield _Change(Repair(gap, gap, f" {word} "), sure, guessed, advice)
    if "`{`" in expected and at == end:
        yield _Change(Repair(gap, gap, " { }"))
    if found is not None:
        for word in missing:
            guessed = word.isalpha() and keyword_guess
            yield _Change(Repair(at, found.end(), word), guessed=guessed)
        yield _Change(Repair(at, found.end(), " " * len(found[0])))
