"""What the words of a file are, for an editor that colours them by their meaning.

A word such as `state` is a keyword at one place and a field of a message at another: colours that
are made by patterns cannot know.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import takewhile
from typing import NamedTuple

from swarmdsl import swarm_parser, syntax
from swarmdsl.ir.types import PRIMITIVES
from swarmdsl.libraries import imported_name
from swarmdsl.load import File
from swarmdsl.scopes import FileScope, Scopes
from swarmdsl.server.positions import units
from swarmdsl.source import Span
from swarmdsl.syntax import Node, TopLevel, nodes_of, references
from swarmdsl.workspace import Workspace
from swarmdsl.workspace.occurrences import occurrences, owners

# Source: LSP 3.17, "Semantic Tokens"; all of them are standard there.
TYPES = (
    *("namespace", "class", "struct", "enum", "enumMember", "type", "interface", "event"),
    *("function", "method", "variable", "parameter", "property", "label", "keyword"),
)
MODIFIERS = ("declaration", "readonly", "defaultLibrary")
_DECLARATION, _READONLY, _DEFAULT = (1 << index for index in range(len(MODIFIERS)))

_KINDS: dict[type[Node], str] = {
    syntax.StructType: "struct",
    syntax.MessageType: "struct",
    syntax.EnumType: "enum",
    syntax.EnumValue: "enumMember",
    syntax.AliasType: "type",
    syntax.ServiceType: "interface",
    syntax.ActionType: "interface",
    syntax.Constant: "variable",
    syntax.Event: "event",
    syntax.Function: "function",
    syntax.Fitness: "function",
    syntax.Operation: "method",
    syntax.Component: "class",
    syntax.Member: "class",
    syntax.StateMachine: "class",
    syntax.Swarm: "class",
    syntax.Environment: "class",
    syntax.Variable: "variable",
    syntax.Param: "parameter",
    syntax.Parameter: "parameter",
    syntax.FitnessInput: "parameter",
    syntax.Part: "property",
    syntax.Port: "property",
    syntax.Role: "property",
    syntax.Field: "property",
    syntax.State: "label",
    syntax.Parallel: "label",
    syntax.Region: "label",
    syntax.Choice: "label",
    syntax.History: "label",
    syntax.FinalState: "label",
}
_WORD = re.compile(r'[A-Za-z_]\w*|"(?:[^"\\\n]|\\[^\n])*"|//[^\n]*|/\*(?:[^*]|\*(?!/))*\*/')
_NAME = re.compile(r"[A-Za-z_]\w*")
_KEYWORDS = frozenset(
    literal for _, _, literal in swarm_parser.TERMINALS if literal.isalpha()
) | frozenset(("and", "or", "not", "true", "false"))


class Token(NamedTuple):
    """A word: where it begins, how long it is, what it is by its place in TYPES and MODIFIERS."""

    start: int
    length: int
    type: int
    modifiers: int


class Painter:
    """Finds the tokens of files; those of a declaration that has not changed are kept."""

    def __init__(self) -> None:
        self._known: dict[TopLevel, list[Token]] = {}
        self._told: dict[str, tuple[str, Sequence[int]]] = {}
        self._count = 0

    def tokens(self, workspace: Workspace, file: File, within: Span | None = None) -> list[Token]:
        """The tokens of a file, or of the declarations that are in a part of it, in their order."""
        scope = Scopes(workspace.project)[file]
        found = [*_head(file)]
        known: dict[TopLevel, list[Token]] = {}
        for owner in owners(file):
            span = owner.span.absolute
            if within is not None and (span.end < within.start or within.end < span.start):
                continue
            tokens = known[owner] = self._known.get(owner) or _of_owner(owner, scope)
            base = span.start - owner.span.start
            found += (Token(each.start + base, *each[1:]) for each in tokens) if base else tokens
        if within is None:
            self._known = known
        return sorted(found)

    def remember(self, name: str, data: Sequence[int]) -> str:
        """Keep what was told of a file; return by which name it is asked for."""
        self._count += 1
        self._told[name] = (str(self._count), data)
        return str(self._count)

    def remembered(self, name: str, result: object) -> Sequence[int] | None:
        """What was told of a file by some name, if that was the last time."""
        known, data = self._told.get(name, ("", None))
        return data if known == result else None

    def forget(self, name: str) -> None:
        """Forget what was told of a file."""
        self._told.pop(name, None)
        self._known.clear()


def encoded(tokens: Iterable[Token], file: File, encoding: str) -> list[int]:
    """Tokens as the protocol has them: five numbers each, places counted from the one before."""
    source = file.source
    text, starts = source.text, source.line_starts
    found: list[int] = []
    line = last_line = last_character = 0
    last = len(starts) - 1
    ascii_only = text.isascii() or encoding == "utf-32"
    for start, length, type_, modifiers in tokens:
        while line < last and starts[line + 1] <= start:
            line += 1
        character = start - starts[line]
        if not ascii_only:
            character = units(text[starts[line] : start], encoding)
        if line != last_line:
            last_character = 0
        found += (line - last_line, character - last_character, length, type_, modifiers)
        last_line, last_character = line, character
    return found


def changes(before: Sequence[int], now: Sequence[int]) -> list[tuple[int, int, Sequence[int]]]:
    """What to put in place of which numbers: where they begin, how many, and the new ones."""
    most = min(len(before), len(now))
    same = zip(before, now, strict=False)
    head = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], same))
    backwards = zip(reversed(before), reversed(now), strict=False)
    tail = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], backwards))
    tail = min(tail, most - head)
    if head == len(before) == len(now):
        return []
    return [(head, len(before) - tail - head, now[head : len(now) - tail])]


def _token(start: int, length: int, kind: str, modifiers: int = 0) -> Token:
    return Token(start, length, TYPES.index(kind), modifiers)


def _head(file: File) -> Iterator[Token]:
    """The package and the imports."""
    model = file.model
    nodes = [*model.imports, *([model.package] if model.package is not None else [])]
    for node in nodes:
        source, start, end = node.span.absolute
        words = [each for each in _WORD.finditer(source.text, start, end) if each[0][0] not in '"/']
        count = 1 if not isinstance(node, syntax.ImportRos) else 2
        for index, each in enumerate(words):
            last = index == len(words) - 1
            one = isinstance(node, syntax.ImportLibrary) and last and imported_name(node)
            if index < count:
                yield _token(each.start(), len(each[0]), "keyword")
            elif not one:
                yield _token(each.start(), len(each[0]), "namespace")


def _of_owner(owner: TopLevel, scope: FileScope) -> list[Token]:
    """The tokens of a declaration, at places in the source of its tree."""
    base = owner.span.absolute.start - owner.span.start
    found: dict[int, Token | None] = {}
    for span in _names(owner):
        for word in _NAME.finditer(span.source.text, span.start, span.end):
            found[word.start()] = None
    for token in _by_grammar(owner):
        found[token.start] = token
    for each in occurrences(owner, scope):
        kind = _KINDS[type(each.node)]
        modifiers = _DECLARATION if each.declares else 0
        if isinstance(each.node, (syntax.Constant, syntax.EnumValue)):
            modifiers |= _READONLY
        package, slash, _ = each.span.text.rpartition("/")
        start = each.span.start - base + len(package) + len(slash)
        found[start] = _token(start, each.span.end - base - start, kind, modifiers)
    source, start, end = owner.span
    for word in _WORD.finditer(source.text, start, end):
        if word[0] in _KEYWORDS and word.start() not in found:
            found[word.start()] = _token(word.start(), len(word[0]), "keyword")
    return [token for token in found.values() if token is not None]


def _names(owner: TopLevel) -> Iterator[Span]:
    """All that is a name, whatever it means."""
    for _, ref in references(owner):
        if ref.kind != "Outcome":
            yield ref.span
    for type_ in nodes_of(owner, syntax.TypeRef):
        source, start, _ = type_.span
        yield Span(source, start, start + len(type_.name))


def _by_grammar(owner: TopLevel) -> Iterator[Token]:
    """Names whose kind is known from where they stand."""

    def token(span: Span, kind: str, modifiers: int = 0) -> Token:
        return _token(span.start, span.end - span.start, kind, modifiers)

    for field in nodes_of(owner, syntax.FieldUse):
        yield token(field.name.span, "property")
    for argument in nodes_of(owner, syntax.Argument):
        yield token(argument.name.span, "property")
    for value in nodes_of(owner, syntax.PartValue):
        yield token(value.name.span, "parameter")
    for call in nodes_of(owner, syntax.Call):
        yield token(call.function.span, "function", _DEFAULT)
    for result in nodes_of(owner, syntax.ResultMapping):
        yield token(result.field.span, "property")
    for activity in nodes_of(owner, syntax.Activity):
        for callback in (activity.goal_callback, activity.result_callback):
            if callback is not None:
                yield token(callback.span, "function")
    for settings in nodes_of(owner, syntax.CommunicationSettings):
        yield token(settings.technology.span, "namespace")
    for type_ in nodes_of(owner, syntax.TypeRef):
        start = type_.span.start
        package, slash, name = type_.name.partition("/")
        if slash:
            yield _token(start, len(package), "namespace")
            yield _token(start + len(package) + 1, len(name), "struct")
        elif type_.name in PRIMITIVES:
            yield _token(start, len(package), "type", _DEFAULT)
    for kind in (syntax.MessageType, syntax.ServiceType, syntax.ActionType):
        if isinstance(owner, kind):
            package, slash, _ = owner.name.partition("/")
            if slash:
                yield _token(owner.name.span.start, len(package), "namespace")
