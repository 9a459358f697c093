"""Completion of keywords and names.

The parser gives the tokens that can follow the text before the cursor. A placeholder name at the
cursor shows, by the node that contains it, which names fit. Both work in incomplete text.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from swarmdsl.analysis.node_kinds import kind_name
from swarmdsl.analysis.resolve.scopes import FileScope, Scopes
from swarmdsl.analysis.types import BUILT_INS
from swarmdsl.base.records import dataclass
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.references import owners
from swarmdsl.ide.server.candidates import Candidates
from swarmdsl.ide.server.fields import facts_of, fields_of, is_placeholder_name, slots
from swarmdsl.ide.server.identity import is_own, own_fields
from swarmdsl.ide.server.outcomes import unhandled_outcomes
from swarmdsl.ide.server.space_words import words_at
from swarmdsl.ide.server.speculative_parse import (
    ARGUMENT,
    COMMENT_OR_STRING,
    NAME,
    PLACEHOLDER,
    closing_brackets,
    declaration_at,
    parse_with_placeholder,
)
from swarmdsl.ide.server.type_names import type_names
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    NEIGHBORS,
    Assignment,
    Component,
    FieldUse,
    Member,
    NameUse,
    Node,
    ResultMapping,
    TopLevel,
    TypeRef,
    nodes_of,
)
from swarmdsl.syntax.parser import generated
from swarmdsl.syntax.parser.failure_finder import mismatch
from swarmdsl.syntax.recovery.statements import statement_at

_WORD = re.compile(r"\w*")
# Integer part of a number before its decimal point.
_NUMBER = re.compile(r"(?<![\w.])\d\w*\.\Z")
# Never in the text of a model, so the parser must stop there.
_STOP = "\0"
_NAMES = ("IDENT", "WORD")
_OUTCOMES = ("succeeded", "aborted", "preempted")


@dataclass(frozen=True)
class Completion:
    """Word that fits at the cursor.

    `node` is its declaration, None for a keyword and for a built-in function.

    `text` is a snippet with fields (`${1:name}`) if the word alone is not enough.
    """

    word: str
    detail: str
    node: Node | None = None
    text: str | None = None


def completions(workspace: Workspace, file: File, offset: int) -> list[Completion]:
    """Return the completions at an offset; they replace the word around it."""
    text = file.source.text
    start, end = word_at(text, offset)
    _, first, last = workspace.fragment_span(file, start)
    last = max(last, end)
    head, tail = text[first:start], text[end:last]
    if _in_comment_or_string(head) or _NUMBER.search(head):
        return []
    expected, named = _expected(head)
    around = declaration_at(file, start)
    keywords = [word for word in _keywords(expected) if word.isalpha()]
    if any(owner.span.absolute.end <= first for owner in owners(file)):
        keywords = [word for word in keywords if word not in ("package", "import")]
    if any(word in _OUTCOMES for word in keywords):
        left = unhandled_outcomes(around, start)
        keywords = [word for word in keywords if word not in _OUTCOMES or word in left]
    found = [Completion(word, "keyword") for word in keywords]
    if named:
        scope = Scopes(workspace.project)[file]
        place = _NameCompletion(workspace, file, (head, tail), scope, around, start)
        found += place.names()
    return list({each.word: each for each in found}.values())


def word_at(text: str, offset: int) -> tuple[int, int]:
    """Return start and end of the word around an offset."""
    start = offset
    while start and (text[start - 1].isalnum() or text[start - 1] == "_"):
        start -= 1
    found = _WORD.match(text, offset)
    return start, found.end() if found is not None else offset


def _in_comment_or_string(head: str) -> bool:
    """Return True if `head` ends inside a comment or a string."""
    found = list(COMMENT_OR_STRING.finditer(head))
    if not found or found[-1].end() < len(head):
        return False
    last = found[-1]
    closed = last[0].endswith("*/") if last[0].startswith("/*") else last[0][1:].endswith('"')
    return last[0].startswith("//") or not closed


def _expected(head: str) -> tuple[frozenset[tuple[str, str, str]], bool]:
    """Return the terminals that can follow a text, and True if a name can.

    If the text has errors, use the text up to the last statement. If that fails too, or ends in a
    name, a name can follow; on a new line also the start of a statement.
    """
    end = len(head.rstrip())
    statement = statement_at(head, max(end - 1, 0))
    around = statement.around
    if head.endswith("{", 0, end):
        around = (*around, (statement.start, statement.header + 1))
    blocks = "".join(head[start:stop] for start, stop in around)
    attempts = (head, False), (blocks + head[statement.start :], False), (blocks, True)
    for text, recovered in attempts:
        found = mismatch(generated.PROGRAM, generated.TERMINALS, generated.BLANK, text + _STOP)
        if found is not None and found.at == len(text):
            if recovered:
                return found.expected if "\n" in head[end:] else frozenset(), True
            return found.expected, any(name in _NAMES for _, name, _ in found.expected)
    return frozenset(), True


def _keywords(expected: Iterable[tuple[str, str, str]]) -> list[str]:
    return sorted(literal for _, _, literal in expected if literal)


class _NameCompletion:
    """Completion of a name in the declaration around it."""

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
        """Yield the names that fit."""
        # In parentheses, or in the braces of a part.
        inside = closing_brackets(self._around[0]).split("\n")
        blocks = isinstance(self._owner, (Component, Member)) and len(inside) > 1
        given = inside[0] == ")" or blocks
        words = (*NAME, *ARGUMENT) if given else NAME
        for owner in parse_with_placeholder(
            self._workspace, self._file, self._around, self._owner, words
        ):
            found = self._matching(owner)
            if found is not None:
                yield from found
                return

    def _matching(self, owner: TopLevel) -> Iterable[Completion] | None:
        """Return the completions of the placeholder; None if it names no existing element."""
        words = words_at(owner)
        if words is not None:
            return [Completion(word, detail, None, text) for word, detail, text in words]
        if is_placeholder_name(owner):
            given = slots(owner, self._workspace.project)
            left = given.unassigned if given is not None else []
            sign = (
                "=>"
                if any(each.field == PLACEHOLDER for each in nodes_of(owner, ResultMapping))
                else "="
            )
            return [_completion(each, f"{each.name} {sign} ${{1}}") for each in left]
        for use in nodes_of(owner, FieldUse):
            if use.name == PLACEHOLDER and is_own(use):
                return [Completion(name, f"field : {kind}") for name, kind in own_fields().items()]
            if use.name == PLACEHOLDER and (facts := facts_of(use, owner, self._workspace.project)):
                fields = fields_of(use, owner, self._workspace.project)
                told = [Completion(name, f"field : {kind}") for name, kind in facts.items()]
                return [*map(_completion, fields), *told]
        nodes = Candidates(self._workspace, self._scope, self._owner or owner, self._offset)
        for found in nodes.of(owner):
            calls = _calls() if _is_value(owner) else ()
            return [*(_completion(each) for each in found), *calls]
        for type_ in nodes_of(owner, TypeRef):
            if PLACEHOLDER in type_.name:
                known = type_names(type_, owner, self._scope)
                return [
                    _completion(each, word=word) if each is not None else Completion(word, detail)
                    for word, detail, each in known
                ]
        return None


def _is_value(owner: TopLevel) -> bool:
    """Return True if the placeholder is a value, and not what a value is assigned to."""
    assigned: list[Assignment | ResultMapping] = [
        *nodes_of(owner, Assignment),
        *nodes_of(owner, ResultMapping),
    ]
    if any(PLACEHOLDER in each.target.span.text for each in assigned):
        return False
    return any(PLACEHOLDER in use.name for use in nodes_of(owner, NameUse))


def _calls() -> Iterator[Completion]:
    """Yield the built-in functions."""
    for name, function in BUILT_INS.items():
        fields = ", ".join(f"${{{n}:{each}}}" for n, each in enumerate(function.parameters, 1))
        text = f"{name} {fields}" if name == NEIGHBORS else f"{name}({fields})"
        yield Completion(name, function.signature(name), text=text)


def _completion(node: Node, text: str | None = None, word: str = "") -> Completion:
    """Return the completion of a node, with its kind and type as detail."""
    type_ = getattr(node, "type", None)
    detail = kind_name(node)
    if isinstance(type_, TypeRef):
        detail += f" : {type_.span.text}"
    return Completion(word or str(node.name), detail, node, text)  # type: ignore[attr-defined]
