"""Every model in the documentation compiles, or shows the mistake it is there to show."""

from __future__ import annotations

from io import StringIO
from pathlib import Path

import pytest

from swarmdsl.base import resources
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.diagnostics.render import render
from swarmdsl.base.records import replace
from swarmdsl.base.source import Source
from swarmdsl.cli import run
from swarmdsl.codegen import registry
from swarmdsl.codegen.emit import Request
from swarmdsl.driver import pipeline
from swarmdsl.syntax.ast import NODES, MessageType, Node, RoleUse, walk
from swarmdsl.syntax.parse import parse

from ..targets import COMPOSED
from .pages import LANGUAGE, Block, blocks

MODELS = blocks("swarm")
TARGETS = [each for each in registry.BUILT_IN if each not in COMPOSED]

# Classes of the tree that no rule of the grammar makes by itself.


def write(block: Block, folder: Path) -> Path:
    """Write a block, and those before it that are kept as files; return its path."""
    for earlier in block.page.blocks:
        if earlier is block:
            break
        if "file" in earlier.attributes:
            _write(folder / earlier.attributes["file"], earlier.text)
    path = folder / block.attributes.get("file", "model.swarm")
    start = f'import "{block.attributes["with"]}"\n' if "with" in block.attributes else ""
    _write(path, start + block.text)
    return path


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def test_the_example_of_an_absence_holds_in_all_runs(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (block,) = (each for each in MODELS if "property Absence " in each.text)

    assert run(["verify", str(write(block, tmp_path)), "--property", "Absence"]) == 0
    assert "  Absence  holds" in capsys.readouterr().out


@pytest.mark.parametrize("block", MODELS, ids=str)
def test_model(block: Block, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    path = write(block, tmp_path)

    report = pipeline.check([path.relative_to(tmp_path)]).report

    expected = {code for code in block.attributes.get("reports", "").split(",") if code}
    shown = StringIO()
    render(report, "text", shown)
    assert {found.code for found in report} == expected, shown.getvalue()


@pytest.mark.parametrize(
    "block", [block for block in MODELS if "reports" not in block.attributes], ids=str
)
def test_every_target_can_express_it(block: Block, tmp_path: Path) -> None:
    checked = pipeline.check([write(block, tmp_path)])

    refused = {}
    for target in TARGETS:
        result = replace(checked, report=Diagnostics())
        report = pipeline.generate(result, [Request(target)], tmp_path / target).report
        if report.has_errors:
            refused[target] = list(report)
    refusing = block.attributes.get("except", "").split(",")
    assert refused.keys() == set(TARGETS).intersection(refusing), refused


def test_attributes_are_known() -> None:
    known = {"file", "with", "reports", "except"}
    assert [block for block in MODELS if not block.attributes.keys() <= known] == []


def test_the_reference_shows_every_element() -> None:
    shown: set[type[Node]] = set()
    for block in LANGUAGE.blocks:
        if block.language == "swarm":
            tree = parse(Source(str(block), block.text), Diagnostics()).model
            shown |= {type(node) for node in walk(tree)}
            shown |= {type(getattr(node, "tree", None)) for node in walk(tree)}

    missing = set(NODES.values()) - shown - {RoleUse}  # of a name, once the swarm is known

    assert missing == set()


def test_interfaces_of_the_library_are_described_as_it_does() -> None:
    """A message of CPSwarm in the documentation has the fields that it has in the library."""

    def fields(text: str) -> dict[str, list[tuple[str, str]]]:
        model = parse(Source("a.swarm", text), Diagnostics()).model
        return {
            str(each.name): [(str(field.name), str(field.type.name)) for field in each.fields]
            for each in model.declarations
            if isinstance(each, MessageType) and "/" in str(each.name)
        }

    library: dict[str, list[tuple[str, str]]] = {}
    for path in sorted((resources.library() / "cpswarm").rglob("*.swarm")):
        library |= fields(path.read_text(encoding="utf-8"))
    described = [
        (str(block), name, found, library[name])
        for block in MODELS
        for name, found in fields(block.text).items()
        if name in library
    ]
    assert len(described) >= 2
    assert [each for each in described if each[2] != each[3]] == []
