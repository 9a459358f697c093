"""Contents of SVG files as other programs read them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from lxml import etree

from swarmdsl.cli import run
from swarmdsl.codegen.diagram.graph import Diagram, Edge, Node
from swarmdsl.tools.diagram.svg import svg

from .conftest import MODEL, ROOT, drawn_of

SVG = "{http://www.w3.org/2000/svg}"
PICTURES = ROOT / "docs" / "pictures"


def test_elements_say_what_they_show_and_where_that_is_written() -> None:
    diagram = next(each for each in drawn_of(MODEL) if each.name == "Patrol")
    root = etree.fromstring(svg(diagram).encode())
    lines = MODEL.read_text().splitlines()
    shown = {}
    for element in root.iter(f"{SVG}g"):
        place = element.get("data-place")
        assert place is not None
        path, line, column = place.rsplit(":", 2)
        assert path == str(MODEL)
        shown[element.get("data-id")] = lines[int(line) - 1][int(column) - 1 :]
    ids = {node.id for node in diagram.frame.walk()} | {edge.id for edge in diagram.edges}
    assert set(shown) == ids
    assert shown["Round.Eyes.Alert"].startswith("Alert {")
    assert "Go -> Far" in " ".join(shown["Round.Eyes.Alert.Near->0"].split())
    titles = [title.text for title in root.iter(f"{SVG}title")]
    assert "Nothing to do." in titles


def test_it_has_nothing_from_elsewhere(drawn: tuple[Diagram, ...]) -> None:
    for diagram in drawn:
        root = etree.fromstring(svg(diagram).encode())
        names = {name for element in root.iter() for name in map(str, element.attrib)}
        assert not {name for name in names if "href" in name or name.startswith("on")}
        text = svg(diagram)
        assert "url(" not in text
        assert "@import" not in text
        assert "hsl(" not in text


def test_every_colour_is_a_number_first() -> None:
    style = re.search(r"<style>(.*?)</style>", svg(drawn_of(MODEL)[0]), re.DOTALL)
    assert style is not None
    for rule in style[1].splitlines():
        names = re.findall(r"(fill|stroke): var", rule)
        for name in names:
            assert re.search(rf"{name}: #[0-9a-f]{{6}};.*{name}: var\(--\w+\)", rule), rule


def test_text_of_a_model_is_no_markup() -> None:
    odd = "<b>&amp;]]>\"'\x0b\ud800"
    frame = Node(
        "", "frame", odd, doc=odd, nodes=(Node(odd, "state", odd, "", ((odd,),), doc=odd),)
    )
    edges = (Edge("e" + odd, "transition", odd, odd, (odd,), doc=odd),)
    root = etree.fromstring(svg(Diagram("statechart", odd, frame, edges)).encode())
    told = "".join("".join(element.itertext()) for element in root.iter(f"{SVG}text"))
    assert told.count("<b>&amp;") == 4


@pytest.mark.parametrize("picture", sorted(PICTURES.glob("*.svg")), ids=lambda path: path.stem)
def test_pictures_of_the_documentation_are_up_to_date(
    picture: Path,
    bless: bool,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(ROOT)
    name, kind, _ = picture.name.split(".")
    options = ["--name", name, "--kind", kind]
    assert run(["diagram", "examples/search_and_rescue", *options]) == 0
    text = capsys.readouterr().out
    if bless:
        picture.write_text(text, encoding="utf-8")
    assert text == picture.read_text(encoding="utf-8")


def test_the_documentation_has_pictures() -> None:
    assert len(list(PICTURES.glob("*.svg"))) == 3
