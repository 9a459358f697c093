"""Completion of keywords and names.

The parser gives the tokens that can follow the text before the cursor. A placeholder name at the
cursor shows, by the node that contains it, which names fit. Both work in incomplete text.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from swarmdsl.analysis.resolve.scopes import Scopes
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.references import owners
from swarmdsl.ide.server.candidates import Candidates
from swarmdsl.ide.server.completion_entry import BEST, KEYWORD, Completion, entry_of
from swarmdsl.ide.server.expected_value import ExpectedValue, expected_value
from swarmdsl.ide.server.fields import facts_of, fields_of, is_placeholder_name, slots
from swarmdsl.ide.server.identity import is_own, own_fields
from swarmdsl.ide.server.import_names import imports_at, missing_imports
from swarmdsl.ide.server.likely_order import by_use, keyword_rank, usual
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
from swarmdsl.ide.server.undeclared_names import undeclared_names
from swarmdsl.ide.server.unit_names import ranked_units
from swarmdsl.ide.server.value_names import function_entries, value_entries, word_rank
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    NODES,
    Assignment,
    Component,
    Constant,
    EnumType,
    FieldUse,
    Member,
    NameUse,
    Node,
    ResultMapping,
    TopLevel,
    TypeRef,
    nodes_of,
    references,
)
from swarmdsl.syntax.parser import generated
from swarmdsl.syntax.parser.failure_finder import mismatch
from swarmdsl.syntax.recovery.statements import statement_at

_WORD = re.compile(r"\w*")
# Integer part of a number before its decimal point.
_NUMBER = re.compile(r"(?<![\w.])\d\w*\.\Z")
# Number whose unit may follow.
_QUANTITY = re.compile(r"(?<![\w.])\d+(?:\.\d+)?[ \t]+\Z")
# Never in the text of a model, so the parser must stop there.
_STOP = "\0"
_NAMES = ("IDENT", "WORD")
_OUTCOMES = ("succeeded", "aborted", "preempted")


def completions(workspace: Workspace, file: File, offset: int) -> list[Completion]:
    """Return the completions at an offset, the likely ones first.

    They replace the word around the offset, unless they say what they replace.
    """
    text = file.source.text
    start, end = word_at(text, offset)
    imported = imports_at(workspace, file, start)
    if imported is not None:
        return imported
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
    unhandled: list[str] = []
    if any(word in _OUTCOMES for word in keywords):
        unhandled = unhandled_outcomes(around, start)
        keywords = [word for word in keywords if word not in _OUTCOMES or word in unhandled]
    found: list[Completion] = []
    place = _NameCompletion(workspace, file, (head, tail), around, start)
    if named:
        found += place.names()
    elif any(name == "UNIT" for _, name, _ in expected) or _QUANTITY.search(head):
        found += place.units()
    for word in sorted(keywords, key=usual):
        rank = place.word_rank(word)
        if rank is not None:
            known = keyword_rank(word, around, start, unhandled) if rank == KEYWORD else rank
            found.append(Completion(word, "keyword", rank=known))
    unique: dict[str, Completion] = {}
    for each in found:
        unique.setdefault(each.word, each)
    return sorted(unique.values(), key=lambda each: each.rank)


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
        owner: TopLevel | None,
        offset: int,
    ) -> None:
        self._workspace = workspace
        self._project = workspace.project
        self._file = file
        self._around = around
        self._scope = Scopes(workspace.project)[file]
        self._owner = owner
        self._offset = offset
        self._value: ExpectedValue | None = None

    def names(self) -> list[Completion]:
        """Return the names that fit."""
        # In parentheses, or in the braces of a part.
        inside = closing_brackets(self._around[0]).split("\n")
        blocks = isinstance(self._owner, (Component, Member)) and len(inside) > 1
        given = inside[0] == ")" or blocks
        for owner in self._parsed((*NAME, *ARGUMENT) if given else NAME):
            found = self._matching(owner)
            if found is not None:
                return list(found)
        return []

    def units(self) -> list[Completion]:
        """Return the units of the number before the cursor, or of a declaration."""
        head, tail = self._around
        number = _QUANTITY.search(head)
        found = ranked_units(None)
        if number is not None:
            around = (head[: number.start()], tail)
            place = _NameCompletion(self._workspace, self._file, around, self._owner, self._offset)
            values = (expected_value(each, self._project) for each in place._parsed(NAME))
            type_ = next((each.type for each in values if each is not None), None)
            found = ranked_units(type_) if type_ is not None else iter(())
        return [Completion(name, "unit", rank=rank) for name, rank in found]

    def word_rank(self, word: str) -> int | None:
        """Return the rank of a keyword; None if it begins a value that does not fit."""
        return word_rank(word, self._value) if self._value is not None else KEYWORD

    def _parsed(self, words: Sequence[str]) -> Iterator[TopLevel]:
        return parse_with_placeholder(self._workspace, self._file, self._around, self._owner, words)

    def _matching(self, owner: TopLevel) -> Iterable[Completion] | None:
        """Return the completions of the placeholder; None if it names no existing element."""
        words = words_at(owner)
        if words is not None:
            return [Completion(word, detail, None, text) for word, detail, text in words]
        if is_placeholder_name(owner):
            given = slots(owner, self._project)
            left = given.unassigned if given is not None else []
            sign = (
                "=>"
                if any(each.field == PLACEHOLDER for each in nodes_of(owner, ResultMapping))
                else "="
            )
            return [entry_of(each, f"{each.name} {sign} ${{1}}", rank=BEST) for each in left]
        self._value = expected_value(owner, self._project)
        for use in nodes_of(owner, FieldUse):
            if use.name == PLACEHOLDER and is_own(use):
                return [Completion(name, f"field : {kind}") for name, kind in own_fields().items()]
            if use.name == PLACEHOLDER and (facts := facts_of(use, owner, self._project)):
                fields = self._values(fields_of(use, owner, self._project))
                told = [Completion(name, f"field : {kind}") for name, kind in facts.items()]
                return [*fields, *told]
        nodes = Candidates(self._workspace, self._scope, self._owner or owner, self._offset)
        for found in nodes.of(owner):
            return self._fitting(found, owner)
        for type_ in nodes_of(owner, TypeRef):
            if PLACEHOLDER in type_.name:
                return self._types(type_, owner)
        return undeclared_names(owner, self._project)

    def _fitting(self, nodes: Iterable[Node], owner: TopLevel) -> Iterable[Completion]:
        """Return the completions of candidates for the placeholder."""
        for holder, ref in references(owner):
            if PLACEHOLDER in ref.name:
                ordered = by_use(nodes, holder, ref, owner, self._owner or owner, self._offset)
                kind = NODES.get(ref.kind)
                more = self._imports((kind,)) if kind is not None and "." not in ref.name else ()
                return [*map(entry_of, ordered), *more]
        if self._value is None:
            return map(entry_of, nodes)
        calls = function_entries(self._value) if _is_value(owner) else ()
        more = self._imports((Constant, EnumType)) if _is_value(owner) else ()
        return [*self._values(nodes), *calls, *more]

    def _values(self, nodes: Iterable[Node]) -> Iterable[Completion]:
        return (
            value_entries(nodes, self._value) if self._value is not None else map(entry_of, nodes)
        )

    def _types(self, type_: TypeRef, owner: TopLevel) -> list[Completion]:
        known, kinds = type_names(type_, owner, self._scope)
        more = self._imports(kinds) if "/" not in type_.name else ()
        return [
            *(
                entry_of(each, word=word) if each is not None else Completion(word, detail)
                for word, detail, each in known
            ),
            *more,
        ]

    def _imports(self, kinds: tuple[type[Node], ...]) -> Iterable[Completion]:
        return missing_imports(kinds, self._scope)


def _is_value(owner: TopLevel) -> bool:
    """Return True if the placeholder is a value, and not what a value is assigned to."""
    assigned: list[Assignment | ResultMapping] = [
        *nodes_of(owner, Assignment),
        *nodes_of(owner, ResultMapping),
    ]
    if any(PLACEHOLDER in each.target.span.text for each in assigned):
        return False
    return any(PLACEHOLDER in use.name for use in nodes_of(owner, NameUse))
