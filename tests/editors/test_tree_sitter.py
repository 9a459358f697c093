"""The grammar for tree-sitter reads models as the compiler does."""

from __future__ import annotations

import re
from typing import Any

import pytest

from swarmdsl.base.source import Source
from swarmdsl.syntax.ast import NODES, walk
from swarmdsl.syntax.parser import generated
from swarmdsl.syntax.parser.result import NESTING_LIMIT
from swarmdsl.syntax.pegen.grammar import read
from swarmdsl.syntax.pegen.metamodel import metamodel

from ..pegen.test_swarm_parser import models
from .tree_sitter import QUERIES, language

STALE = "editors/tree-sitter/src/parser.c is stale: run `make tree-sitter`"
# The whole file has no space around it here; expressions are flat, and types in them are names.
OTHERS = {"Model", "Expression", "TypeRef"}


@pytest.fixture(scope="module")
def parser() -> Any:
    from tree_sitter import Parser

    return Parser(language())


def node_name(rule: str) -> str:
    return re.sub(r"(?<=[a-z])(?=[A-Z])", "_", rule).lower()


def test_every_node_of_every_model(parser: Any) -> None:
    rules = {rule.name for rule in read(metamodel()).rules.values() if rule.kind == "node"}
    kinds = {node_name(name): name for name in rules & NODES.keys() - OTHERS}
    seen = set()
    for text in models():
        parsed = generated.parse(Source("model.swarm", text), {}, NESTING_LIMIT)
        if parsed is None:
            continue
        offsets = [0]
        for letter in text:
            offsets.append(offsets[-1] + len(letter.encode()))
        expected = {
            (name, offsets[node.span.start], offsets[node.span.end])
            for node in walk(parsed[0])
            if (name := type(node).__name__) in kinds.values()
        }
        root = parser.parse(text.encode()).root_node
        assert not root.has_error, f"{STALE}\n{text}"
        found = set()
        pending = [root]
        while pending:
            node = pending.pop()
            pending += node.named_children
            if node.type in kinds:
                found.add((kinds[node.type], node.start_byte, node.end_byte))
        assert found == expected, STALE
        seen |= {name for name, _, _ in found}
    assert seen == set(kinds.values())


@pytest.mark.parametrize("text", [
    "state", "statemachine A { state B { on", "event \xe9 : T", "\0", "param a : int32 = 5 %",
    "statemachine A { state B { on C / send D after 5", "/* open", '"open',
])  # fmt: skip
def test_half_a_model_is_a_tree(parser: Any, text: str) -> None:
    root = parser.parse(text.encode()).root_node
    assert root.end_byte <= len(text.encode())
    assert root.has_error


@pytest.mark.parametrize("query", sorted(path.name for path in QUERIES.glob("*.scm")))
def test_queries_are_about_nodes_that_there_are(query: str) -> None:
    from tree_sitter import Query

    assert Query(language(), (QUERIES / query).read_text(encoding="utf-8")).pattern_count
