"""What can be written at a place: the keywords of the grammar, and the names that fit.

The parser says which tokens could follow the text before the place; a name that stands there on
trial says, by the node that holds it, what it would mean. Both work in text that is not finished.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from swarmdsl.analysis.node_kinds import kind_name
from swarmdsl.analysis.resolve.scopes import FileScope, Scopes
from swarmdsl.base.records import dataclass
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.references import owners
from swarmdsl.ide.server.candidates import Candidates
from swarmdsl.ide.server.fields import is_name_on_trial, slots
from swarmdsl.ide.server.outcomes import outcomes_left
from swarmdsl.ide.server.speculative_parse import (
    ARGUMENT,
    COMMENT_OR_TEXT,
    NAME,
    WORD,
    closers,
    owner_around,
    tried,
)
from swarmdsl.ide.server.type_names import type_names
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import Member, Node, ResultMapping, TopLevel, TypeRef, nodes_of
from swarmdsl.syntax.parser import generated
from swarmdsl.syntax.parser.failure_finder import mismatch
from swarmdsl.syntax.recovery.statements import statement_at

_WORD = re.compile(r"\w*")
# The part of a number before its point.
_NUMBER = re.compile(r"(?<![\w.])\d\w*\.\Z")
# No text of a model has it: there the parser must stop.
_STOP = "\0"
_NAMES = ("IDENT", "WORD")
_OUTCOMES = ("succeeded", "aborted", "preempted")


@dataclass(frozen=True)
class Completion:
    """A word that can stand at a place; `node` is what it means, None for a keyword.

    What cannot stand alone is a `text` with places to fill in, `${1:so}`.
    """

    word: str
    detail: str
    node: Node | None = None
    text: str | None = None


def completions(workspace: Workspace, file: File, offset: int) -> list[Completion]:
    """What can stand at an offset, in place of the word that begins before it."""
    text = file.source.text
    start, end = word_at(text, offset)
    _, first, last = workspace.piece(file, start)
    last = max(last, end)
    head, tail = text[first:start], text[end:last]
    if _in_comment_or_text(head) or _NUMBER.search(head):
        return []
    expected, named = _expected(head)
    around = owner_around(file, start)
    keywords = [word for word in _keywords(expected) if word.isalpha()]
    if any(owner.span.absolute.end <= first for owner in owners(file)):
        keywords = [word for word in keywords if word not in ("package", "import")]
    if any(word in _OUTCOMES for word in keywords):
        left = outcomes_left(around, start)
        keywords = [word for word in keywords if word not in _OUTCOMES or word in left]
    found = [Completion(word, "keyword") for word in keywords]
    if named:
        scope = Scopes(workspace.project)[file]
        place = _Place(workspace, file, (head, tail), scope, around, start)
        found += place.names()
    return list({each.word: each for each in found}.values())


def word_at(text: str, offset: int) -> tuple[int, int]:
    """Where the word around an offset begins and ends."""
    start = offset
    while start and (text[start - 1].isalnum() or text[start - 1] == "_"):
        start -= 1
    found = _WORD.match(text, offset)
    return start, found.end() if found is not None else offset


def _in_comment_or_text(head: str) -> bool:
    """Whether a comment or a text that begins in `head` goes on behind it."""
    found = list(COMMENT_OR_TEXT.finditer(head))
    if not found or found[-1].end() < len(head):
        return False
    last = found[-1]
    closed = last[0].endswith("*/") if last[0].startswith("/*") else last[0][1:].endswith('"')
    return last[0].startswith("//") or not closed


def _expected(head: str) -> tuple[frozenset[tuple[str, str, str]], bool]:
    """What the grammar has behind a text, and whether a name can be there.

    Where the text is wrong, it is what is behind its last statement. Where that is wrong too, or
    ends within a name, it may be a name, or on a line of its own what begins a statement.
    """
    end = len(head.rstrip())
    statement = statement_at(head, max(end - 1, 0))
    around = statement.around
    if head.endswith("{", 0, end):
        around = (*around, (statement.start, statement.header + 1))
    blocks = "".join(head[start:stop] for start, stop in around)
    ways = (head, False), (blocks + head[statement.start :], False), (blocks, True)
    for text, lost in ways:
        found = mismatch(generated.PROGRAM, generated.TERMINALS, generated.BLANK, text + _STOP)
        if found is not None and found.at == len(text):
            if lost:
                return found.expected if "\n" in head[end:] else frozenset(), True
            return found.expected, any(name in _NAMES for _, name, _ in found.expected)
    return frozenset(), True


def _keywords(expected: Iterable[tuple[str, str, str]]) -> list[str]:
    return sorted(literal for _, _, literal in expected if literal)


class _Place:
    """A place where a name is typed, in the declaration that is around it."""

    def __init__(
        self,
        workspace: Workspace,
        file: File,
        around: tuple[str, str],
        scope: FileScope,
        owner: TopLevel | None,
        offset: int,
    ) -> None:
        self._workspace = workspace
        self._file = file
        self._around = around
        self._scope = scope
        self._owner = owner
        self._offset = offset

    def names(self) -> Iterator[Completion]:
        """The names that can stand here."""
        # In parentheses, or in the braces of a part.
        inside = closers(self._around[0]).split("\n")
        given = inside[0] == ")" or (isinstance(self._owner, Member) and len(inside) > 1)
        words = (*NAME, *ARGUMENT) if given else NAME
        for owner in tried(self._workspace, self._file, self._around, self._owner, words):
            found = self._fitting(owner)
            if found is not None:
                yield from found
                return

    def _fitting(self, owner: TopLevel) -> Iterable[Completion] | None:
        """What the word on trial can be; None where it is no name of something that exists."""
        if is_name_on_trial(owner):
            given = slots(owner, self._workspace.project)
            left = given.left if given is not None else []
            sign = (
                "=>" if any(each.field == WORD for each in nodes_of(owner, ResultMapping)) else "="
            )
            return [_completion(each, f"{each.name} {sign} ${{1}}") for each in left]
        nodes = Candidates(self._workspace, self._scope, self._owner or owner, self._offset)
        for found in nodes.of(owner):
            return [_completion(each) for each in found]
        for type_ in nodes_of(owner, TypeRef):
            if WORD in type_.name:
                known = type_names(type_, owner, self._scope)
                return [
                    _completion(each, word=word) if each is not None else Completion(word, detail)
                    for word, detail, each in known
                ]
        return None


def _completion(node: Node, text: str | None = None, word: str = "") -> Completion:
    """A name, with what it is and of which type."""
    type_ = getattr(node, "type", None)
    detail = kind_name(node)
    if isinstance(type_, TypeRef):
        detail += f" : {type_.span.text}"
    return Completion(word or str(node.name), detail, node, text)  # type: ignore[attr-defined]
