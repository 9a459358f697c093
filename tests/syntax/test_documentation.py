"""Everything that begins a line keeps its documentation, in any model."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import fields, is_dataclass
from pathlib import Path
from shutil import copytree
from typing import Any

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.driver import pipeline
from swarmdsl.ir import System
from swarmdsl.syntax.ast import (
    NODES,
    AliasType,
    Constant,
    Documented,
    ImportFile,
    ImportLibrary,
    ImportRos,
    MessageType,
    Package,
    walk,
)
from swarmdsl.syntax.formatter import format_source
from swarmdsl.syntax.parse import parse

from ..docs.pages import blocks

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = [
    folder
    for parent in ("examples", "tests/golden")
    for folder in sorted((ROOT / parent).iterdir())
    if list(folder.glob("*.swarm"))
]
FILES = [file for folder in FOLDERS for file in sorted(folder.glob("*.swarm"))]
MODELS = {str(file.relative_to(ROOT)): file.read_text(encoding="utf-8") for file in FILES}
MODELS |= {str(block): block.text for block in blocks("swarm")}
# What has no place in the IR: what a name stands for is there instead.
ELSEWHERE = (Package, ImportFile, ImportLibrary, ImportRos, AliasType)


def documented(text: str) -> list[Documented] | None:
    """Return the documentable nodes in document order; None if the text does not parse."""
    report = Diagnostics()
    parsed = parse(Source("model", text), report)
    assert "unattached-doc-comment" not in {found.name for found in report}
    nodes = [node for node in walk(parsed.model) if isinstance(node, Documented)]
    return None if report.has_errors else sorted(nodes, key=lambda node: node.span.start)


def with_docs(text: str, nodes: list[Documented]) -> str:
    """The text with a line of documentation before each of the nodes."""
    pieces, end = [], 0
    for number, node in enumerate(nodes):
        start = node.span.start
        begins_line = not text[text.rfind("\n", 0, start) + 1 : start].strip()
        pieces += [text[end:start], "" if begins_line else "\n", f"/// Number {number}.\n"]
        end = start
    return "".join(pieces) + text[end:]


def last_lines(nodes: list[Documented] | None) -> list[str]:
    assert nodes is not None
    return [node.doc.rpartition("\n")[2] for node in nodes]


def test_many_models_are_looked_at() -> None:
    kinds = {type(node) for text in MODELS.values() for node in documented(text) or ()}

    assert len(MODELS) > 60
    documentable = {node for node in NODES.values() if issubclass(node, Documented)}
    assert documentable == kinds


@pytest.mark.parametrize("name", MODELS)
def test_everything_has_documentation(name: str) -> None:
    nodes = documented(MODELS[name])
    if nodes is None:
        pytest.skip("about a syntax error")
    text = with_docs(MODELS[name], nodes)
    expected = [f"Number {number}." for number in range(len(nodes))]
    layout = format_source(Source("model", text), Diagnostics())

    assert last_lines(documented(text)) == expected
    assert layout is not None
    assert last_lines(documented(layout)) == expected
    assert format_source(Source("model", layout), Diagnostics()) == layout


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: str(folder.relative_to(ROOT)))
def test_documentation_is_in_the_representation(folder: Path, tmp_path: Path) -> None:
    copytree(folder, tmp_path / "model")
    # Another example imports it.
    copytree(ROOT / "examples" / "search_and_rescue", tmp_path / "search_and_rescue")
    expected = []
    for path in sorted((tmp_path / "model").glob("*.swarm")):
        text = path.read_text(encoding="utf-8")
        nodes = documented(text) or []
        path.write_text(with_docs(text, nodes).replace("/// Number", f"/// {path.stem}"), "utf-8")
        in_messages = {
            constant
            for node in nodes
            if isinstance(node, MessageType)
            for constant in node.constants
        }
        expected += [
            f"{path.stem} {number}."
            for number, node in enumerate(nodes)
            if not isinstance(node, ELSEWHERE)
            and (not isinstance(node, Constant) or node in in_messages)
        ]
    system = pipeline.check([tmp_path / "model"]).system
    found = {line for text in texts(system) for line in text.splitlines()}

    assert expected
    assert set(expected) - found == set()


def test_what_is_said_of_effects_on_entry_stands_together(
    compiled: Callable[[str], System],
) -> None:
    system = compiled(
        """
        statemachine M {
          var n : int32
          initial A
          state A {
            /// One.
            entry / n = 1
            entry / n = n + 1
            /// Two.
            // More.
            entry / n = n * 2
            exit / n = 0
            after 1 s -> End
          }
          final End
        }
        """
    )

    assert system.machines[0].states[0].docs == (("entry", "One.\nTwo."),)


def test_a_behavior_is_inherited_with_what_is_said_of_it(
    compiled: Callable[[str], System],
) -> None:
    system = compiled(
        """
        statemachine M { initial A; state A { after 1 s -> E } final E }
        member Base {
          /// Runs.
          behavior M
        }
        member Plain extends Base { }
        member Own extends Base { behavior M }
        """
    )
    docs = {member.name: member.docs for member in system.members}

    assert docs == {"Base": (said := (("behavior", "Runs."),)), "Plain": said, "Own": ()}


def texts(node: Any) -> Iterator[str]:
    """Return all strings of the IR, documentation included."""
    if isinstance(node, str):
        yield node
    elif isinstance(node, tuple):
        for item in node:
            yield from texts(item)
    elif is_dataclass(node):
        for field in fields(node):
            if field.compare:
                yield from texts(getattr(node, field.name))
