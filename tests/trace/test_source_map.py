"""Places that a template prints become a table of the lines that come from them."""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.base.source import Piece, Source, Span
from swarmdsl.cli import run
from swarmdsl.codegen.api import OutputFile
from swarmdsl.codegen.python import comments
from swarmdsl.codegen.source_map import Entry, MappedText, TracedStr
from swarmdsl.codegen.templates import Templates
from swarmdsl.output import manifest, source_maps
from swarmdsl.output.source_maps import FileMap, Model, Position, Positions

MODEL = Source("lab.swarm", "package lab\n\n  param a : bool\n  param b : bool\n")
A, B = (Span(MODEL, start, start + 7) for start in (15, 32))


def printed(folder: Path, template: str, **values: object) -> MappedText:
    (folder / "template.j2").write_text(template, encoding="utf-8")
    return Templates(folder).fill("template.j2", **values)


def test_a_comment_holds_for_what_is_as_deep_and_deeper(tmp_path: Path) -> None:
    template = """{% for origin in origins %}
    # {{ comments(origin, 'of it')[0] }}
    if x:
        y = 1

        z = 2
{% endfor %}
done = True
"""
    text = printed(tmp_path, template, origins=(A, B), comments=comments)

    assert text.split("\n")[0] == "    # lab.swarm:3"
    assert text.entries == (Entry(1, A), Entry(6, B), Entry(11, None))
    assert [text.split("\n")[line - 1].strip() for line, _ in text.entries] == [
        "# lab.swarm:3",
        "# lab.swarm:4",
        "done = True",
    ]


def test_what_is_less_deep_goes_on_after_what_is_deeper(tmp_path: Path) -> None:
    template = """class X:{{ at(a) }}
    one
    two{{ at(b) }}
      three
    four
    # {{ comment }}
    five
      six{{ at(a) }}
      seven
    eight{{ at() }}
    nine
end
"""
    text = printed(tmp_path, template, a=A, b=B, comment=TracedStr("b", B, holds=True))

    assert text == (
        "class X:\n    one\n    two\n      three\n    four\n    # b\n    five\n"
        "      six\n      seven\n    eight\n    nine\nend\n"
    )
    assert text.entries == tuple(
        Entry(line, origin)
        for line, origin in [(1, A), (3, B), (5, A), (6, B), (8, A), (9, B), (10, A), (12, None)]
    )


def test_a_text_that_comes_from_a_place_marks_its_line_in_what_is_included(tmp_path: Path) -> None:
    (tmp_path / "inner.j2").write_text("{{ header }} {{ other }}\n", encoding="utf-8")
    text = printed(tmp_path, "{% include 'inner.j2' %}", header=TracedStr("x.h", A), other="\ufdd0")

    assert text == "x.h \ufdd0\n"
    assert text.entries == (Entry(1, A),)


def test_lines_that_are_broken_move_those_after_them(tmp_path: Path) -> None:
    text = printed(tmp_path, "a\nlong line{{ at(a) }}\nb{{ at(b) }}\n", a=A, b=B)
    broken = text.rewritten(4, str.split)

    assert broken == "a\nlong\nline\nb\n"
    assert broken.entries == (Entry(2, A), Entry(4, B))


@pytest.fixture
def place(tmp_path: Path) -> Span:
    model = tmp_path / "models" / "lab.swarm"
    model.parent.mkdir()
    model.write_text(MODEL.text, encoding="utf-8")
    return Span(Source("lab.swarm", MODEL.text, model), 15, 60)


def test_a_manifest_gives_back_what_it_was_given(tmp_path: Path, place: Span) -> None:
    positions = Positions(tmp_path / "out")
    text = MappedText("a\nb\nc\n", [Entry(2, place), Entry(3, None)])
    maps = {
        "smach/lab/node.py": positions.file_map(OutputFile("lab/node.py", text, origin=place)),
        "smach/lab/mine.py": positions.file_map(OutputFile("lab/mine.py", text, keep=True)),
    }
    (tmp_path / manifest.NAME).write_bytes(manifest.to_bytes(manifest.Manifest(maps=maps)))
    found = Position(Model("../models/lab.swarm", source_maps.digest(MODEL.text)), 3, 3, 14)

    assert manifest.read(tmp_path).maps == maps
    assert maps["smach/lab/node.py"] == FileMap(found, ((2, found), (3, None)))
    assert maps["smach/lab/mine.py"] == FileMap(of_user=True)
    assert [maps["smach/lab/node.py"].position(line) for line in (1, 2, 3, 9)] == [
        None,
        found,
        None,
        None,
    ]
    assert found.model.place(tmp_path / "out") == tmp_path / "models" / "lab.swarm"


def test_a_place_in_a_piece_of_a_file_is_one_in_the_file(tmp_path: Path, place: Span) -> None:
    piece = Piece("lab.swarm", MODEL.text[13:], whole=place.source, base=13)
    moved = OutputFile("x", "", origin=Span(piece, 2, 9))
    same = OutputFile("x", "", origin=Span(place.source, 15, 22))
    positions = Positions(tmp_path)

    assert positions.file_map(moved) == positions.file_map(same)


def test_libraries_of_swarmdsl_lie_wherever_it_is_installed() -> None:
    library = source_maps.resources.library()
    path = min(library.rglob("*.swarm"))
    origin = Span(Source("x", path.read_text(encoding="utf-8"), path), 0, 1)
    position = Positions(Path()).file_map(OutputFile("x", "", origin=origin)).origin

    assert position is not None
    assert position.model.path == f"swarmdsl:{path.relative_to(library).as_posix()}"
    assert position.model.place(Path("anywhere")) == path


def test_what_lies_in_no_file_is_not_mapped(tmp_path: Path) -> None:
    files = [OutputFile("x", "", origin=A), OutputFile("x", "")]

    assert [Positions(tmp_path).file_map(file) for file in files] == [FileMap(), FileMap()]


@pytest.mark.parametrize(
    "data",
    [
        None,
        [],
        {"version": 2, "models": [], "files": {"a": "0:1:1+1"}},
        {"version": 1, "models": 3, "files": {}},
        {"version": 1, "models": [], "files": [1]},
    ],
)
def test_a_map_of_another_form_is_none(data: object) -> None:
    assert source_maps.from_json(data) == {}


@pytest.mark.parametrize("text", ["0:1:1+1", "x y z", "9=0", "0:-1:2+3 =0:1:1+1", "1=7:1:1+1"])
def test_words_that_mean_nothing_are_passed_over(text: str) -> None:
    stored = {"version": 1, "models": [[], ["m"]], "files": {"a": text, "b": 3}}
    found = source_maps.from_json(stored)

    assert found.keys() == {"a"}
    assert found["a"].position(5) is None


def test_targets_built_one_by_one_have_the_map_of_all(tmp_path: Path) -> None:
    model = tmp_path / "blinker.swarm"
    model.write_bytes(Path("examples/minimal/blinker.swarm").read_bytes())
    for target in ("smach", "scxml", "smach"):
        assert run(["build", str(model), "--target", target, "-o", str(tmp_path / "out")]) == 0
    together = ["build", str(model), "--target", "smach", "--target", "scxml"]
    assert run([*together, "-o", str(tmp_path / "other")]) == 0

    first, second = (tmp_path / name / manifest.NAME for name in ("out", "other"))
    assert first.read_bytes() == second.read_bytes()
    maps = manifest.read(tmp_path / "out").maps
    assert {path.partition("/")[0] for path in maps} == {"smach", "scxml"}
