"""The parser of the language: what its rules become, and what it imports for that."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path
from typing import Any

import swarmdsl
from swarmdsl.peg.emission import Target
from swarmdsl.peg.grammar import read
from swarmdsl.peg.module import definitions
from swarmdsl.resources import grammar_checksum
from swarmdsl.syntax import NODES, Documented

PATH = Path(swarmdsl.__file__).with_name("swarm_parser.py")
TARGET = Target(
    nodes={
        name: tuple(field.name for field in fields(node) if field.init and field.name != "span")
        for name, node in NODES.items()
    },
    documented=frozenset(name for name, node in NODES.items() if issubclass(node, Documented)),
    words={
        **dict.fromkeys(("Name", "FieldName", "InterfaceName", "PackageName"), "{}"),
        "Text": "unquoted({})",
    },
    written={"Expression": "expression", "Operand": "operand", "Delay": "delay"},
    begin="""\
    expressions = ExpressionParser(LANGUAGE, source, limit)
    expression = expressions.expression
    operand = expressions.operand
    delay = expressions.delay
""",
    result="len(expressions.faults)",
)
_HEAD = '''\
"""Parses .swarm files: made from grammar/*.tx by `make parser`, not to be edited."""

# mypy: ignore-errors
from __future__ import annotations

import re

from swarmdsl.expression_parser import ExpressionParser, TooDeepError
from swarmdsl.expressions import Language, unquoted
from swarmdsl.source import Source, Span
from swarmdsl.syntax import Ref, Word, {classes}

GRAMMAR = {checksum}
{definitions}
LANGUAGE = Language(TOKEN, BLANK, RESERVED)
'''


def parser(metamodel: Any) -> str:
    """The source of the parser for a textX metamodel; raises UnsupportedError."""
    text, nodes = definitions(read(metamodel), TARGET)
    return _HEAD.format(checksum=grammar_checksum(), definitions=text, classes=", ".join(nodes))
