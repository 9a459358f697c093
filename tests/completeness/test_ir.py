"""Every field of the intermediate representation reaches every consumer.

A field is changed in a model; a consumer whose output stays the same has overlooked it, unless
LEFT_OUT says that it leaves the field out. A new field fails here until each consumer shows it,
and until a model among MODELS uses it.
"""

from __future__ import annotations

import dataclasses
import tempfile
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from pathlib import Path

import pytest

from swarmdsl import ir
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.codegen.diagram.mermaid import mermaid
from swarmdsl.codegen.exchange.scxml import Options, emit
from swarmdsl.codegen.swarm_printer.system import print_system
from swarmdsl.driver import pipeline
from swarmdsl.ir.dump import dump
from swarmdsl.syntax.formatter import format_source
from swarmdsl.tools.compare.comparison import compare
from swarmdsl.tools.diagram.dot import dot
from swarmdsl.tools.diagram.views import diagrams
from swarmdsl.tools.document import document
from swarmdsl.tools.merge.files import merge_files

from .left_out import LEFT_OUT, NEVER_ALONE
from .mutations import fields, systems

ROOT = Path(__file__).resolve().parents[2]
MODELS = (
    Path(__file__).parent / "model.swarm",
    ROOT / "tests/golden/language/model.swarm",
    ROOT / "tests/golden/everything/model.swarm",
    ROOT / "tests/golden/operations/model.swarm",
    ROOT / "tests/golden/submachine/model.swarm",
    ROOT / "examples/search_and_rescue",
)
TRIES = 30
"""Places at which a field is changed until a consumer shows it."""
LOOKS = 8
"""Places at which a consumer is seen to leave out what LEFT_OUT says."""


@cache
def system(model: Path) -> ir.System:
    found = pipeline.check([model]).system
    assert found is not None
    return found


@cache
def size(model: Path) -> int:
    return len(print_system(system(model)))


def shown(consumer: Callable[[ir.System], object], given: ir.System) -> object:
    """Return a consumer's result for a system, or the type of the exception raised."""
    try:
        return consumer(given)
    except Exception as error:
        return type(error)


def print_differences(given: ir.System) -> object:
    return compare(_before[0], given)[0]


_before: list[ir.System] = []


def draw(given: ir.System) -> object:
    return [text(each) for each in diagrams(given) for text in (mermaid, dot)]


def write_scxml(given: ir.System) -> object:
    return [file.text for file in emit(given, Options(profile="portable"), Diagnostics())]


ON_SYSTEMS: Mapping[str, Callable[[ir.System], object]] = {
    "dump": dump,
    "printer": print_system,
    "diff": print_differences,
    "diagram": draw,
    "portable SCXML": write_scxml,
}


def checked_text(text: str) -> pipeline.Result:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.swarm"
        path.write_text(text, encoding="utf-8")
        return pipeline.check([path])


@pytest.fixture
def without_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave pictures out of pages: the text shows every field, and they take half of the time."""
    monkeypatch.setattr("swarmdsl.tools.document.pictures", lambda *_: {})


@cache
def documented(text: str) -> str:
    result = checked_text(text)
    assert result.valid is not None
    return document(result.valid)[1]


def merged_into(base: str) -> Callable[[str], object]:
    """Merge a change of one side only: the result has it."""

    def merge(text: str) -> object:
        with tempfile.TemporaryDirectory() as folder:
            paths = [Path(folder) / name for name in ("base", "ours", "theirs")]
            for path, content in zip(paths, (base, base, text), strict=True):
                path.write_text(content, encoding="utf-8")
            result = merge_files(*paths, Diagnostics())
        assert result is not None
        assert not result.conflicts
        return result.content

    return merge


def all_fields() -> Iterator[str]:
    """`Class.field` of all nodes of the IR, without those that lowering derives."""
    for name in set(ir.__all__) - {"PortGroup"}:
        cls = getattr(ir, name)
        if isinstance(cls, type) and dataclasses.is_dataclass(cls):
            yield from (f"{name}.{each}" for each in fields(cls))


@cache
def changes() -> Mapping[str, list[tuple[Path, Callable[[], ir.System]]]]:
    """Changes of each field, over all models."""
    found: dict[str, list[tuple[str, Path, Callable[[], ir.System]]]] = {}
    for model in MODELS:
        for name, kind, make in systems(system(model)):
            found.setdefault(name, []).append((kind, model, make))
    return {name: spread(each) for name, each in found.items()}


def spread(
    places: list[tuple[str, Path, Callable[[], ir.System]]],
) -> list[tuple[Path, Callable[[], ir.System]]]:
    """Choose TRIES places at most, from nodes of each kind and from all models."""
    by_kind: dict[str, list[tuple[Path, Callable[[], ir.System]]]] = {}
    for kind, model, make in places:
        by_kind.setdefault(kind, []).append((model, make))
    share = max(TRIES // len(by_kind), 1)
    chosen = [
        each for found in by_kind.values() for each in found[:: max(len(found) // share, 1)][:share]
    ]
    # Small models first: most changes are shown in the first one that has the field.
    return sorted(chosen, key=lambda each: size(each[0]))


def test_the_models_use_every_field() -> None:
    assert sorted(set(all_fields()) - changes().keys()) == []


@cache
def shown_unchanged(consumer: str, model: Path) -> object:
    _before[:] = [system(model)]
    return shown(ON_SYSTEMS[consumer], system(model))


@pytest.mark.parametrize("name", sorted(set(all_fields())))
def test_a_change_is_shown(name: str) -> None:
    overlooked = set(ON_SYSTEMS)
    left_out = {each for each in ON_SYSTEMS if name in LEFT_OUT[each]}
    for number, (model, make) in enumerate(changes()[name]):
        if overlooked <= left_out and (not overlooked or number == LOOKS):
            break
        after = make()
        for consumer in sorted(overlooked):
            unchanged = shown_unchanged(consumer, model)
            _before[:] = [system(model)]
            if unchanged != shown(ON_SYSTEMS[consumer], after):
                overlooked.discard(consumer)
    assert overlooked == left_out


@cache
def printed(model: Path) -> str:
    return print_system(system(model))


@cache
def printed_change(name: str, number: int) -> object:
    return shown(print_system, changes()[name][number][1]())


def texts(name: str) -> Iterator[tuple[str, str]]:
    """Yield texts of models before and after changes of a field."""
    for number, (model, _) in enumerate(changes()[name]):
        before = printed(model)
        after = printed_change(name, number)
        if isinstance(after, str) and after != before:
            yield before, after


PRINTED = sorted(set(all_fields()) - LEFT_OUT["printer"])


@pytest.mark.parametrize("name", PRINTED)
def test_a_change_is_formatted_and_merged(name: str) -> None:
    found = next(texts(name), None)
    if found is None:
        pytest.skip("the printer refuses each change of this field alone")
    before, after = found
    text = format_source(Source("model.swarm", after), Diagnostics())
    if text is not None:  # the change is in the grammar
        assert "".join(text.split()) == "".join(after.split())
        assert merged_into(before)(after) == after.encode()


def documentation(name: str) -> bool | None:
    """Return True if a page shows a valid change of a field, or None if no change is valid."""
    shown = None
    for before, after in texts(name):
        result = checked_text(after)
        if result.valid is not None:
            shown = documented(before) != document(result.valid)[1]
        if shown:
            break
    return shown


@pytest.mark.long
@pytest.mark.usefixtures("without_pictures")
@pytest.mark.parametrize("name", sorted(set(PRINTED) - NEVER_ALONE))
def test_a_change_is_documented(name: str) -> None:
    shown = documentation(name)
    if shown is None:
        pytest.skip("no change of this field alone gives a valid model")
    assert shown == (name not in LEFT_OUT["document"])


@pytest.mark.thorough
@pytest.mark.usefixtures("without_pictures")
@pytest.mark.parametrize("name", sorted(NEVER_ALONE))
def test_a_change_alone_is_never_valid(name: str) -> None:
    assert documentation(name) is None
