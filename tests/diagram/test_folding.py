"""Diagrams with the insides of some boxes hidden."""

from __future__ import annotations

import random
from pathlib import Path

from hypothesis import given, settings
from hypothesis import strategies as st
from lxml import etree

from swarmdsl.codegen.diagram.graph import Diagram
from swarmdsl.tools.diagram.folding import fold
from swarmdsl.tools.diagram.layout import lay_out
from swarmdsl.tools.diagram.svg import svg
from swarmdsl.tools.diagram.views import diagrams

from .conftest import MODEL, drawn_of, system_of
from .test_layout import DIRECTIONS, check, machines


def diagram(name: str) -> Diagram:
    return next(each for each in drawn_of(MODEL) if each.stem == name)


def ways(of: Diagram) -> set[tuple[str, str, tuple[str, ...]]]:
    return {(edge.source, edge.target, edge.label) for edge in of.edges}


def test_edges_lead_to_what_is_folded() -> None:
    patrol = diagram("Patrol.statechart")
    found = fold(patrol, ["Round"])
    ids = {node.id for node in found.frame.walk()}
    assert ids == {
        each.id for each in patrol.frame.walk() if not each.id.startswith(("Round.", "Round#"))
    }
    crossing = {
        (s if s in ids else "Round", t if t in ids else "Round", label)
        for s, t, label in ways(patrol)
        if {s, t} & (ids - {"Round"})
    }
    itself = {("Round", "Round", label) for s, t, label in ways(patrol) if s == t == "Round"}
    assert ways(found) == crossing | itself
    (node,) = (each for each in found.frame.nodes if each.id == "Round")
    assert (node.folded, node.nodes, node.compartments) == (True, (), ())


def test_edges_that_look_the_same_are_one(tmp_path: Path) -> None:
    """Those of two inner states that lead to the same one for the same reason."""
    model = tmp_path / "walk.swarm"
    model.write_text(
        """
        package p
        message M {}
        event Stop : M
        statemachine Walk {
          initial Go
          state Go {
            initial Left
            state Left { on Stop -> End; after 1 s -> Right }
            state Right { on Stop -> End; after 1 s -> Left }
          }
          final End
        }
        """
    )
    (walk,) = diagrams(system_of(model))
    assert sum(edge.target == "End" for edge in walk.edges) == 2
    assert sum(edge.target == "End" for edge in fold(walk, ["Go"]).edges) == 1


def test_what_is_not_there_or_has_no_inside_is_not_folded() -> None:
    patrol = diagram("Patrol.statechart")
    assert fold(patrol, ["Nowhere", "Idle", "Pick", "", "Round.Legs"]) == patrol


def test_a_folded_state_in_a_folded_one_is_hidden_like_the_others() -> None:
    patrol = diagram("Patrol.statechart")
    assert fold(patrol, ["Round.Eyes.Alert", "Round"]) == fold(patrol, ["Round"])
    assert "Round.Eyes.Alert" in {
        node.id for node in fold(patrol, ["Round.Eyes.Alert"]).frame.walk()
    }


def test_a_folded_part_keeps_its_ports() -> None:
    rover = diagram("Rover.internal")
    part = next(node for node in rover.frame.nodes if node.foldable)
    found = fold(rover, [part.id])
    assert found.edges == rover.edges
    (now,) = (node for node in found.frame.nodes if node.id == part.id)
    assert (now.ports, now.compartments) == (part.ports, ())


def test_a_picture_says_what_can_be_folded() -> None:
    root = etree.fromstring(svg(fold(diagram("Patrol.statechart"), ["Round"])).encode())
    folds = {each.get("data-id"): each.get("data-fold") for each in root.iter("{*}g")}
    assert folds["Round"] == "closed"
    assert folds["Idle"] is None
    root = etree.fromstring(svg(diagram("Patrol.statechart")).encode())
    folds = {each.get("data-id"): each.get("data-fold") for each in root.iter("{*}g")}
    assert {id_ for id_, fold in folds.items() if fold == "open"} == {"Round", "Round.Eyes.Alert"}


@settings(max_examples=20)
@given(st.integers(0, 2**32), st.sampled_from(DIRECTIONS))
def test_pictures_with_what_is_folded_are_laid_out_well(seed: int, direction: object) -> None:
    machine = machines(seed)
    ids = [node.id for node in machine.frame.walk()]
    some = random.Random(seed).sample(ids, len(ids) // 3)
    check(lay_out(fold(machine, some), direction))
