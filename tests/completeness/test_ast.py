"""Every field of the syntax tree reaches the intermediate representation.

A field is changed in a checked model, which is lowered again. A field that makes no difference
has been forgotten, unless NOT_LOWERED has a reason.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.driver import pipeline
from swarmdsl.ir.dump import dump
from swarmdsl.lowering import lower
from swarmdsl.project.loader import Project
from swarmdsl.syntax import ast
from swarmdsl.syntax.ast.walk import NODES, walk

from .left_out import NOT_LOWERED
from .mutations import other_values
from .test_ir import MODELS

NO_CONTENT = {"span", "by_class", "missing_separators", "known"}
"""Fields with the place of a node, with a cache, and with what is reported or only checked."""

TRIES = 8
"""Nodes in which a field is changed until the lowered model differs."""


@cache
def project(model: Path) -> Project:
    found = pipeline.check([model]).valid
    assert found is not None
    return found


@cache
def lowered(model: Path) -> str:
    return dump(lower(project(model)))


def all_fields() -> Iterator[str]:
    """`Class.field` of all nodes of the syntax tree."""
    for name, cls in NODES.items():
        yield from (
            f"{name}.{each.name}" for each in dataclasses.fields(cls) if each.name not in NO_CONTENT
        )


def other(value: Any) -> Iterator[Any]:
    """Values of the same type that differ from `value`."""
    if isinstance(value, list) and value:
        yield value[:-1]
    elif isinstance(value, ast.Node | ast.Ref):
        yield None
    elif not isinstance(value, list):
        for each in other_values(value):
            yield ast.Word(each, value.span) if isinstance(value, ast.Word) else each


@cache
def nodes() -> Mapping[str, list[tuple[Path, ast.Node]]]:
    """Nodes of each class, over all models."""
    found: dict[str, list[tuple[Path, ast.Node]]] = {}
    for model in MODELS:
        for file in project(model).files:
            if not file.library:
                for node in walk(file.model):
                    found.setdefault(type(node).__name__, []).append((model, node))
    return found


def differs(model: Path, node: ast.Node, field: str, value: Any) -> bool:
    """Return True if the lowered model differs, or lowering refuses the value."""
    before: Callable[[], str] = lambda: dump(lower(project(model)))  # noqa: E731
    kept = getattr(node, field)
    expected = lowered(model)
    setattr(node, field, value)
    try:
        return before() != expected
    except Exception:
        return True
    finally:
        setattr(node, field, kept)


@pytest.mark.parametrize("name", sorted(all_fields()))
def test_a_change_is_lowered(name: str) -> None:
    cls, field = name.split(".")
    tried = [
        (model, node, value)
        for model, node in nodes().get(cls, [])
        for value in other(getattr(node, field))
    ]
    assert tried, "no model uses it"
    step = max(len(tried) // TRIES, 1)
    shown = any(differs(model, node, field, value) for model, node, value in tried[::step])
    assert shown == (name not in NOT_LOWERED)
