"""Semantic tokens: the meaning of each word of a file.

A word such as `state` can be a keyword or a field of a message. Patterns of a TextMate grammar
cannot tell the two apart.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from swarmdsl.analysis.resolve.scopes import FileScope
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace.references import occurrences
from swarmdsl.ide.server.code import find_tokens
from swarmdsl.project.libraries import imported_name
from swarmdsl.project.loader import File
from swarmdsl.syntax import ast
from swarmdsl.syntax.ast import Node, TopLevel, nodes_of, references
from swarmdsl.syntax.parser import generated
from swarmdsl.syntax.types import PRIMITIVES

# Source: LSP 3.17, "Semantic Tokens"; all of these are predefined.
TYPES = (
    *("namespace", "class", "struct", "enum", "enumMember", "type", "interface", "event"),
    *("function", "method", "variable", "parameter", "property", "label", "keyword"),
)
MODIFIERS = ("declaration", "readonly", "defaultLibrary")
_NUMBERS = {kind: number for number, kind in enumerate(TYPES)}
_DECLARATION, _READONLY, _DEFAULT = (1 << index for index in range(len(MODIFIERS)))

_KINDS: dict[type[Node], str] = {
    ast.StructType: "struct",
    ast.MessageType: "struct",
    ast.EnumType: "enum",
    ast.EnumValue: "enumMember",
    ast.AliasType: "type",
    ast.ServiceType: "interface",
    ast.ActionType: "interface",
    ast.Constant: "variable",
    ast.Event: "event",
    ast.Function: "function",
    ast.Fitness: "function",
    ast.Property: "property",
    ast.Contract: "property",
    ast.Operation: "method",
    ast.Component: "class",
    ast.Member: "class",
    ast.StateMachine: "class",
    ast.Swarm: "class",
    ast.Environment: "class",
    ast.Variable: "variable",
    ast.Param: "parameter",
    ast.Parameter: "parameter",
    ast.FitnessInput: "parameter",
    ast.Part: "property",
    ast.Port: "property",
    ast.Role: "property",
    ast.Area: "property",
    ast.Zone: "property",
    ast.Obstacle: "property",
    ast.Targets: "property",
    ast.Field: "property",
    ast.State: "label",
    ast.Parallel: "label",
    ast.Region: "label",
    ast.Choice: "label",
    ast.History: "label",
    ast.FinalState: "label",
}
_WORD = re.compile(r'[A-Za-z_]\w*|"(?:[^"\\\n]|\\[^\n])*"|//[^\n]*|/\*')
_NAME = re.compile(r"[A-Za-z_]\w*")
_KEYWORDS = frozenset(
    literal for _, _, literal in generated.TERMINALS if literal.isalpha()
) | frozenset(("and", "or", "not", "true", "false"))

# Keywords for which the TextMate grammar has a scope of their own, for colours of the user.
_OWN_SCOPES = ("succeeded", "aborted", "preempted", "maximize", "minimize")


class Token(NamedTuple):
    """Offset, length, index in TYPES, and bit set of MODIFIERS of a word."""

    start: int
    length: int
    type: int
    modifiers: int


def _token(start: int, length: int, kind: str, modifiers: int = 0) -> Token:
    return Token(start, length, _NUMBERS[kind], modifiers)


def head_tokens(file: File) -> Iterator[list[Token]]:
    """Yield tokens of the package and of each import, with offsets in the file."""
    model = file.model
    nodes = [*model.imports, *([model.package] if model.package is not None else [])]
    for node in nodes:
        source, start, end = node.span.absolute
        found = find_tokens(source.text, _WORD, start, end)
        words = [(at, word) for at, word in found if word[0] not in '"/']
        count = 1 if not isinstance(node, ast.ImportRos) else 2
        tokens = []
        for index, (at, word) in enumerate(words):
            last = index == len(words) - 1
            one = isinstance(node, ast.ImportLibrary) and last and imported_name(node)
            if index < count:
                tokens.append(_token(at, len(word), "keyword"))
            elif not one:
                tokens.append(_token(at, len(word), "namespace"))
        if tokens:
            yield tokens


def declaration_tokens(owner: TopLevel, scope: FileScope) -> list[Token]:
    """Return the tokens of a declaration, with offsets in the source of its tree."""
    base = owner.span.absolute.start - owner.span.start
    found: dict[int, Token | None] = {}
    for span in _names(owner):
        for name in _NAME.finditer(span.source.text, span.start, span.end):
            found[name.start()] = None
    for token in _by_grammar(owner):
        found[token.start] = token
    for each in occurrences(owner, scope):
        kind = _KINDS[type(each.node)]
        modifiers = _DECLARATION if each.declares else 0
        if isinstance(each.node, (ast.Constant, ast.EnumValue)):
            modifiers |= _READONLY
        package, slash, _ = each.span.text.rpartition("/")
        start = each.span.start - base + len(package) + len(slash)
        found[start] = _token(start, each.span.end - base - start, kind, modifiers)
    source, start, end = owner.span
    for at, word in find_tokens(source.text, _WORD, start, end):
        if word in _KEYWORDS and word not in _OWN_SCOPES and at not in found:
            found[at] = _token(at, len(word), "keyword")
    return [token for token in found.values() if token is not None]


def _names(owner: TopLevel) -> Iterator[Span]:
    """Yield the spans of all names."""
    for _, ref in references(owner):
        if ref.kind != "Outcome":
            yield ref.span
    for type_ in nodes_of(owner, ast.TypeRef):
        source, start, _ = type_.span
        yield Span(source, start, start + len(type_.name))


def _by_grammar(owner: TopLevel) -> Iterator[Token]:
    """Yield names whose kind follows from the grammar."""

    def token(span: Span, kind: str, modifiers: int = 0) -> Token:
        return _token(span.start, span.end - span.start, kind, modifiers)

    for field in nodes_of(owner, ast.FieldUse):
        yield token(field.name.span, "property")
    for argument in nodes_of(owner, ast.Argument):
        yield token(argument.name.span, "property")
    for value in nodes_of(owner, ast.PartValue):
        yield token(value.name.span, "parameter")
    for call in nodes_of(owner, ast.Call):
        yield token(call.function.span, "function", _DEFAULT)
    for result in nodes_of(owner, ast.ResultMapping):
        yield token(result.field.span, "property")
    for activity in nodes_of(owner, ast.Activity):
        for callback in (activity.goal_callback, activity.result_callback):
            if callback is not None:
                yield token(callback.span, "function")
    for settings in nodes_of(owner, ast.CommunicationSettings):
        yield token(settings.technology.span, "namespace")
    for type_ in nodes_of(owner, ast.TypeRef):
        start = type_.span.start
        package, slash, name = type_.name.partition("/")
        if slash:
            yield _token(start, len(package), "namespace")
            yield _token(start + len(package) + 1, len(name), "struct")
        elif type_.name in PRIMITIVES:
            yield _token(start, len(package), "type", _DEFAULT)
    for kind in (ast.MessageType, ast.ServiceType, ast.ActionType):
        if isinstance(owner, kind):
            package, slash, _ = owner.name.partition("/")
            if slash:
                yield _token(owner.name.span.start, len(package), "namespace")
