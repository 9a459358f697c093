"""Models, trees and their strings can be pickled and copied."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Iterator
from copy import copy, deepcopy
from enum import Enum
from importlib import import_module
from pathlib import Path
from pkgutil import walk_packages
from typing import Any

import pytest

from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.records import fields_of, is_dataclass
from swarmdsl.base.source import Source, Span
from swarmdsl.codegen.source_map import Entry, MappedText, TracedStr
from swarmdsl.driver import pipeline
from swarmdsl.ir.dump import dump
from swarmdsl.lowering import lower
from swarmdsl.syntax.ast.nodes import Word

ROOT = Path(__file__).resolve().parents[1]
MODELS = [
    *(path for path in sorted((ROOT / "examples").iterdir()) if path.is_dir()),
    *sorted((ROOT / "tests" / "golden").glob("*/model.swarm")),
]
SPAN = Span(Source("m.swarm", "a b"), 0, 1)
SAMPLES: dict[type, Any] = {
    Advice: Advice("add a", "import", "a"),
    MappedText: MappedText("a\n", [Entry(1, SPAN)]),
    TracedStr: TracedStr("a", SPAN, holds=True),
    Word: Word("a", SPAN),
}
WAYS: dict[str, Callable[[Any], Any]] = {
    "pickle": lambda value: pickle.loads(pickle.dumps(value)),
    "copy": copy,
    "deepcopy": deepcopy,
}


def values_in(value: object, seen: set[int]) -> Iterator[object]:
    """All values that a record contains, each once."""
    waiting = [value]
    while waiting:
        each = waiting.pop()
        if id(each) in seen:
            continue
        seen.add(id(each))
        yield each
        if isinstance(each, dict):
            waiting += [*each, *each.values()]
        elif isinstance(each, (list, tuple)):
            waiting += each
        elif is_dataclass(type(each)):
            waiting += [getattr(each, name) for name in fields_of(type(each))]


def copy_of(value: Any, way: str) -> Any:
    """A copy; the reason of a failure without the value, whose text has no end."""
    try:
        return WAYS[way](value)
    except (AttributeError, TypeError, pickle.PicklingError) as error:
        reason = str(error)
    return pytest.fail(f"{way}: {reason}", pytrace=False)


@pytest.mark.parametrize("model", MODELS, ids=lambda path: str(path.relative_to(ROOT)))
def test_models(model: Path) -> None:
    checked = pipeline.check([model])
    system, project = checked.system, checked.valid
    text = dump(system) if system is not None else ""

    assert text
    assert [each for each in values_in(system, set()) if isinstance(each, Word)] == []
    for way in WAYS:
        same = copy_of(system, way) == system
        assert same
        assert dump(copy_of(system, way)) == text
        assert dump(lower(copy_of(project, way), checked.name)) == text


def told(value: Any) -> Any:
    """A value whose equality does not depend on the identity of a source."""
    if isinstance(value, Span):
        return value.text, value.start, value.end
    return [told(each) for each in value] if isinstance(value, tuple) else value


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("kind", SAMPLES, ids=lambda kind: kind.__name__)
def test_strings_with_places(kind: type, way: str) -> None:
    made = copy_of(SAMPLES[kind], way)

    assert (type(made), made) == (kind, str(SAMPLES[kind]))
    for name in kind.__slots__:  # type: ignore[attr-defined]
        assert told(getattr(made, name)) == told(getattr(SAMPLES[kind], name))


def test_all_classes_that_are_made_in_their_own_way_have_a_sample() -> None:
    found = set()
    for package in ("base", "codegen", "ir", "syntax"):
        inside = import_module(f"swarmdsl.{package}")
        for about in walk_packages(inside.__path__, f"{inside.__name__}."):
            for value in vars(import_module(about.name)).values():
                if isinstance(value, type) and _is_made_in_its_own_way(value):
                    found.add(value)

    assert found == set(SAMPLES)


def _is_made_in_its_own_way(cls: type) -> bool:
    known = issubclass(cls, Enum) or hasattr(cls, "_fields")  # a named tuple
    return cls.__module__.startswith("swarmdsl.") and "__new__" in vars(cls) and not known
