"""Texts in diagrams, in every format."""

from __future__ import annotations

import html
import re
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from swarmdsl.codegen.diagram.graph import Diagram
from swarmdsl.ir import StateKind, System
from swarmdsl.tools.diagram.formats import FORMATS, SUFFIXES
from swarmdsl.tools.diagram.views import diagrams

from .conftest import MODEL, drawn_of, system_of

GOLDEN = Path(__file__).parent / "golden"
# How each format writes characters that mean something to it.
ESCAPES: dict[str, Callable[[str], str]] = {
    # A backslash is one in a label of HTML.
    "dot": lambda text: html.unescape(
        re.sub(r'"(?:[^"\\]|\\.)*"', lambda found: re.sub(r"\\(.)", r"\1", found[0]), text)
    ),
    "mermaid": lambda text: re.sub(
        r"#(\w+);",
        lambda found: chr(int(found[1])) if found[1].isdigit() else html.unescape(f"&{found[1]};"),
        text,
    ),
    # A line may be broken where it is too long.
    "svg": lambda text: "".join(
        html.unescape(found) for found in re.findall(r"<text[^>]*>([^<]*)", text)
    ),
    "plantuml": lambda text: re.sub(r"<U\+(\w+)>", lambda found: chr(int(found[1], 16)), text),
}


def told(diagram: Diagram) -> Iterator[str]:
    """All that a diagram must say: names, lines, pieces of labels, ports."""
    for node in diagram.frame.walk():
        yield node.name
        yield from (line for group in node.compartments for line in group)
        yield from (f"{port.name} : {port.type}" for port in node.ports)
    for edge in diagram.edges:
        yield from edge.label


@pytest.mark.parametrize("format_", sorted(ESCAPES))
def test_every_format_says_everything(drawn: tuple[Diagram, ...], format_: str) -> None:
    assert drawn
    for diagram in drawn:
        text = ESCAPES[format_](FORMATS[format_](diagram))
        bare = "".join(text.split())
        assert [what for what in told(diagram) if "".join(what.split()) not in bare] == []


def test_all_of_the_model_is_in_its_diagrams() -> None:
    system = system_of(MODEL)
    drawn = {(each.kind, each.name): each for each in drawn_of(MODEL)}
    assert list(drawn) == [
        ("composition", "Pack"),
        ("internal", "Rover"),
        ("statechart", "Homing"),
        ("statechart", "Patrol"),
    ]
    patrol = drawn["statechart", "Patrol"]
    machine = next(each for each in system.machines if each.name == "Patrol")
    home = next(state for state in machine.states if state.name == "Home")
    reused = {state.id for state in home.walk()} - {"Home"}
    wanted = {state.id for state in machine.walk()} - reused
    initials = {"#initial", *(f"{s.id}#initial" for s in machine.walk() if s.initial)}
    shown = {node.id for node in patrol.frame.walk()} - {""}
    assert shown == wanted | initials - {"Home#initial"}
    transitions = {
        (state.id, each.target)
        for state in machine.walk()
        if state.id in wanted
        for each in state.transitions
        if each.target is not None
    }
    edges = [edge for edge in patrol.edges if edge.kind == "transition"]
    assert {(edge.source, edge.target) for edge in edges} == transitions
    kinds = {node.id: node.kind for node in patrol.frame.walk()}
    assert kinds["Home"] == "submachine"
    assert kinds["Round.Eyes.Alert.Deepest"] == "deep history"
    assert {kinds[s.id] for s in machine.walk() if s.kind is StateKind.CHOICE} == {"choice"}
    (member,) = system.members
    assert len(drawn["internal", "Rover"].edges) == len(member.connectors)
    flows = [edge for edge in drawn["composition", "Pack"].edges if edge.kind == "flow"]
    assert [edge.label for edge in flows] == [("Halt",)]


def test_labels_are_as_the_model_has_them() -> None:
    patrol = next(each for each in drawn_of(MODEL) if each.name == "Patrol")
    labels = {(edge.source, edge.target): edge.label for edge in patrol.edges}
    assert labels["Idle", "Pick"] == (
        "Go",
        '[tries < 3 and name == "x;y:z#"]',
        "/ tries = tries + 1",
    )
    assert labels["Pick", "Idle"] == ("[else]",)
    assert labels["Round", "Home"] == ("Eyes.done",)
    lines = {node.id: node.compartments for node in patrol.frame.walk()}
    assert lines["Idle"] == (
        ("entry / tries = 0, send Halt", "exit / tries = 1", "Halt / tries = 2"),
    )
    assert lines["Home"] == (("speed = 2.0",),)


@pytest.mark.parametrize("format_", sorted(FORMATS))
@pytest.mark.parametrize("diagram", drawn_of(MODEL), ids=lambda diagram: diagram.stem)
def test_golden(diagram: Diagram, format_: str, bless: bool) -> None:
    path = GOLDEN / f"{diagram.stem}{SUFFIXES[format_]}"
    # Places in the model are as its file was named.
    text = FORMATS[format_](diagram).replace(str(MODEL), MODEL.name)
    if bless:
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
    assert text == path.read_text(encoding="utf-8")


def test_nothing_is_drawn_of_a_model_without_anything(
    compiled: Callable[[str], System],
) -> None:
    assert list(diagrams(compiled("event E : std_msgs/Empty\n"))) == []


def test_values_have_their_names(tmp_path: Path) -> None:
    model = tmp_path / "model.swarm"
    model.write_text(
        """
        enum Species { DOCK, THISTLE }
        const PATIENCE : duration = 2 * 30 s
        endless statemachine Spray {
          param wanted : Species = Species.THISTLE
          initial Wait
          state Wait { after PATIENCE [wanted == Species.DOCK] -> Wait }
        }
        """,
        encoding="utf-8",
    )
    (diagram,) = diagrams(system_of(model))
    said = list(told(diagram))

    assert "param wanted : Species = Species.THISTLE" in said
    assert "after PATIENCE" in said
    assert "[wanted == Species.DOCK]" in said
