"""Semantic actions of the language, and the source of its parser."""

from __future__ import annotations

from dataclasses import fields

from swarmdsl.base.resources import grammar_checksum
from swarmdsl.syntax.ast import (
    NODES,
    DeliverySetting,
    Documented,
    EnumValue,
    Field,
    Node,
    Parameter,
    PartValue,
)
from swarmdsl.syntax.pegen.actions import Target
from swarmdsl.syntax.pegen.grammar import Grammar
from swarmdsl.syntax.pegen.module import definitions


def _values(node: type[Node]) -> dict[str, str]:
    """Return expressions for the fields of a node: parsed, its documentation, or defaults."""
    parsed = {part.name: f"{part.name}_" for part in fields(node) if part.init}
    others = {part.name: repr(part.default) for part in fields(node) if not part.init}
    if issubclass(node, Documented):
        others["doc"] = "docs.pop(start) if start in docs else ''"
    del parsed["span"]
    return {**parsed, **others}


TARGET = Target(
    nodes={name: _values(node) for name, node in NODES.items()},
    words={
        **dict.fromkeys(
            ("Name", "FieldName", "PortName", "InterfaceName", "PackageName", "Unit"), "{}"
        ),
        "Text": "unquoted({})",
    },
    written={"Expression": "expression", "Operand": "operand", "Delay": "delay"},
    items={
        name: "," if node in (PartValue, EnumValue, Field, DeliverySetting) else ";"
        for name, node in NODES.items()
        if issubclass(node, Documented) and node is not Parameter
    },
    begin="""\
    find = text.find
    inline = {}
    expressions = ExpressionParser(LANGUAGE, source, (tokens, ends), limit)
    expression = expressions.expression
    operand = expressions.operand
    delay = expressions.delay
""",
    finish="""\
        model.missing_separators = [
            Word(separator, Span(source, ends[at + 1] - len(tokens[at]), ends[at + 1]))
            for at, separator in inline.items()
            if tokens[at - 1] not in SEPARATORS
        ]""",
    result="len(expressions.faults)",
)
_HEAD = '''\
"""Parses .swarm files: made from grammar/*.tx by `make parser`, not to be edited."""

# mypy: ignore-errors
from __future__ import annotations

import re

from swarmdsl.syntax.parser.expressions import ExpressionParser, TooDeepError
from swarmdsl.syntax.parser.literals import Language, unquoted
from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.ast import Ref, Word, {classes}
from swarmdsl.syntax.parser.lexer import Lexer

GRAMMAR = {checksum}
{definitions}
LANGUAGE = Language(LEXER, RESERVED)
# An item may stand after them on one line; the last one is the start of the file.
SEPARATORS = frozenset(("", *"{{}};,"))
'''


def parser(grammar: Grammar) -> str:
    """Source of the parser; raises UnsupportedError."""
    text, nodes = definitions(grammar, TARGET)
    return _HEAD.format(checksum=grammar_checksum(), definitions=text, classes=", ".join(nodes))
