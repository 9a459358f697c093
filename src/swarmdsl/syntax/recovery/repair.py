"""Find the smallest change to a statement that makes the parser accept it.

The change keeps most of the text, whatever its author meant: first one token is inserted,
deleted or replaced, then another; at last the rest of the statement is deleted. Each attempt
parses only the statement within the headers of its blocks, so its cost does not depend on the
size of the file.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from swarmdsl.base.diagnostics.advice import write, write_before
from swarmdsl.base.records import dataclass, replace
from swarmdsl.syntax.errors.report import TOKEN, Failure
from swarmdsl.syntax.errors.substitutions import suggest_substitution
from swarmdsl.syntax.parser.keywords import RESERVED
from swarmdsl.syntax.parser.patched_text import PatchedText, Repair
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
    "INDEX": "0",
    "PROBABILITY": "1",
}
# An inserted bracket may not be the intended one.
_OPENING = ("`(`", "`[`", "`/`", "`.`")
_SYMBOLS = ("`:`", "`->`", "`=`", "`=>`", "`..`", "`)`", "`]`", "`(`", "`[`", "`,`", "`/`", "`.`")
# Preferred in properties, where a name or a bracket would leave more to complete.
_PATTERNS = ("`never`", "`then`")
# Preferred among keywords, because they mean least.
_KEYWORDS = ("`state`", "`swarm`", "`in`", "`on`", "`of`", "`x`")
_MAX_EDITS = 4
_MAX_PLACEHOLDERS = 6


@dataclass(frozen=True, slots=True)
class RepairedStatement:
    """Text in which a statement can be parsed again.

    `complete` if the repair is sure, `guessed` if its first keyword was chosen among several;
    `help` is a hint how to write the statement.
    """

    patched: PatchedText
    complete: bool
    guessed: bool = False
    help: str | None = None


@dataclass(frozen=True, slots=True)
class _Change:
    repair: Repair
    complete: bool = False
    guessed: bool = False
    help: str | None = None


_Attempt = Callable[[PatchedText], Failure | None]


def repair_statement(
    patched: PatchedText, statement: Statement, parse: Callable[[str], Failure | None]
) -> RepairedStatement | None:
    """Repair the header of a statement; None if nothing helps or it is correct on its own."""
    text = patched.text
    before = "".join(text[start:end] + "\n" for start, end in statement.around)
    block = text[statement.header : statement.end]
    closers = "\n" + "}" * len(statement.around)

    def attempt(header: PatchedText, inside: str = " { }" if block else "") -> Failure | None:
        failure = parse(before + header.text + inside + closers)
        return failure and Failure(failure.at - len(before), failure.expected)

    header = patched.piece(statement.start, statement.header)
    failure = attempt(header)
    if failure is None or failure.at < 0:
        return None
    stop = statement.start + min(failure.at, len(header.text))
    if "`{`" in failure.expected and (indented := _indented(patched, stop)):
        return RepairedStatement(indented, complete=True, help="enclose a block in `{` and `}`")
    header_repair = _edit_tokens(header, failure, attempt) or _cut_rest(header, failure, attempt)
    if header_repair is None:
        return None
    if header_repair.guessed and (not block or attempt(header_repair.patched, block)):
        return None  # no block to keep, or it belongs to another keyword
    start, end = statement.start, statement.header
    repaired = PatchedText(
        text[:start] + header_repair.patched.text + text[end:],
        [*patched.origins[:start], *header_repair.patched.origins[:-1], *patched.origins[end:]],
    )
    return replace(header_repair, patched=repaired)


def _indented(patched: PatchedText, at: int) -> PatchedText | None:
    """Put braces around the indented block after `at`, as in Python; it may have a colon."""
    text = patched.text
    line = text.rfind("\n", 0, at) + 1
    margin = len(text[line:at]) - len(text[line:at].lstrip())
    further = rf"\n[ \t]{{{margin + 1},}}\S[^\n]*"
    block = rf"(?P<colon>:?)[ \t]*(?://[^\n]*)?(?P<block>(?:{further}|\n[ \t]*(?=\n))+)"
    found = re.compile(block).match(text, at)
    if found is None or not found["block"].strip():
        return None
    end = found.start("block") + len(found["block"].rstrip())
    return patched.repaired(Repair(end, end, "\n}")).repaired(Repair(at, found.end("colon"), " {"))


def _edit_tokens(
    header: PatchedText, failure: Failure, attempt: _Attempt
) -> RepairedStatement | None:
    """Change a few tokens, each time the one at which the parser stops."""
    so_far = RepairedStatement(header, complete=True)
    for step in range(_MAX_EDITS):
        header = so_far.patched
        furthest: tuple[int, RepairedStatement, Failure] | None = None
        for change in _changes(header.text, failure):
            changed = header.repaired(change.repair)
            repaired = RepairedStatement(
                changed,
                so_far.complete and change.complete,
                so_far.guessed or change.guessed,
                so_far.help if step else change.help,
            )
            result = attempt(changed)
            if result is None:
                return repaired
            gained = len(header.text) - len(changed.text) + result.at - failure.at
            beyond = result.at > change.repair.start + len(change.repair.text)
            if beyond and gained > (furthest[0] if furthest else 0):
                furthest = gained, repaired, result
        if furthest is None:
            return None
        _, so_far, failure = furthest
    return None


def _cut_rest(header: PatchedText, failure: Failure, attempt: _Attempt) -> RepairedStatement | None:
    """Delete the rest of a header, and insert placeholders for its required parts."""
    header = header.blanked(min(failure.at, len(header.text)), len(header.text))
    guessed = False
    for _ in range(_MAX_PLACEHOLDERS):
        result = attempt(header)
        if result is None:
            return RepairedStatement(header, complete=False, guessed=guessed)
        at = len(header.text.rstrip())
        tried = []
        missing = _missing(result)
        for word in missing:
            changed = header.repaired(Repair(at, at, f" {word}"))
            after = attempt(changed)
            guess = guessed or (at == 0 and word.isalpha() and len(missing) > 1)
            if after is None:
                return RepairedStatement(changed, complete=False, guessed=guess)
            tried.append((after.at - len(changed.text), changed, guess))
        if not tried:
            return None
        _, header, guessed = max(tried, key=lambda one: one[0])
    return None


def _missing(failure: Failure) -> list[str]:
    """Return texts to insert where the parser stops; those that mean least first."""
    expected = failure.expected
    symbols = [word.strip("`") for word in (*_PATTERNS, *_SYMBOLS) if word in expected]
    places = [text for terminal, text in _PLACEHOLDERS.items() if terminal in expected]
    words = [word for word in _KEYWORDS if word in expected]
    words += sorted(word for word in expected if re.fullmatch(r"`[a-z]+`", word))
    return list(dict.fromkeys([*symbols, *places, *(word.strip("`") for word in words)]))


def _changes(text: str, failure: Failure) -> Iterator[_Change]:
    """Yield changes at the token where the parser stops; the surest first."""
    expected = failure.expected
    end = len(text.rstrip())
    at = min(failure.at, end)
    found = TOKEN.match(text, at) if at < end else None
    gap = len(text[:at].rstrip())
    if found is not None:
        if meant := suggest_substitution(expected, text, at):
            # A name with another spelling is another name.
            yield _Change(Repair(*meant), "_" not in meant[2], help=write(meant[2].strip()))
        if found[0] in RESERVED and expected & {"IDENT", "QNAME", "TYPENAME"}:
            yield _Change(Repair(at, found.end(), "_" * len(found[0])))
        if not found[0][0].isalnum():
            yield _Change(Repair(at, found.end(), " " * len(found[0])), found[0] in ";,")
    missing = _missing(failure)
    # The first keyword decides which statement it is.
    keyword_guess = at == 0 and sum(word.isalpha() for word in missing) > 1
    for word in missing:
        sure = f"`{word}`" in _SYMBOLS and f"`{word}`" not in _OPENING
        hint = write_before(word, found[0]) if found and sure else None
        guessed = word.isalpha() and keyword_guess
        yield _Change(Repair(gap, gap, f" {word} "), sure, guessed, hint)
    if "`{`" in expected and at == end:
        yield _Change(Repair(gap, gap, " { }"))
    if found is not None:
        for word in missing:
            guessed = word.isalpha() and keyword_guess
            yield _Change(Repair(at, found.end(), word), guessed=guessed)
        yield _Change(Repair(at, found.end(), " " * len(found[0])))
