"""Pictures are easy to read, by counts of what makes others hard to read."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from types import ModuleType

import pytest

from swarmdsl.base.records import replace
from swarmdsl.codegen.diagram.graph import Diagram, Edge, Node
from swarmdsl.driver import pipeline
from swarmdsl.tools.diagram.layout import Picture, lay_out
from swarmdsl.tools.diagram.shapes import Direction
from swarmdsl.tools.diagram.views import diagrams

from .conftest import ROOT


@pytest.fixture(scope="module")
def counting() -> Iterator[ModuleType]:
    """Counts of the benchmark that compares layouts."""
    sys.path.insert(0, str(ROOT / "benchmarks"))
    import picture_counts

    yield picture_counts
    sys.path.remove(str(ROOT / "benchmarks"))


@pytest.fixture(scope="module")
def mission(counting: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Diagram:
    """A state machine with 57 states on three levels."""
    from mission_model import mission_model, states

    path = tmp_path_factory.mktemp("mission") / "mission.swarm"
    path.write_text(mission_model(), encoding="utf-8")
    system = pipeline.check([path]).system
    assert system is not None
    assert len(states()) == 57
    return next(diagrams(system))


@pytest.fixture(scope="module")
def large(mission: Diagram) -> Picture:
    return lay_out(mission)


def test_no_edge_continues_a_rule_and_no_arrow_heads_meet(
    counting: ModuleType, drawn: tuple[Diagram, ...]
) -> None:
    for diagram in drawn:
        drawing = counting.drawing_of(lay_out(diagram))
        assert not counting.on_rules(drawing), diagram.name
        assert not counting.head_to_head(drawing), diagram.name


def test_a_large_machine_has_the_shape_of_a_page(large: Picture) -> None:
    assert 1 / 3 <= large.width / large.height <= 3
    # In one direction it is 2,700 by 8,700 or 16,600 by 1,600 pixels.
    assert max(large.width, large.height) < 6_000
    # 30 million in ELK.
    assert large.width * large.height < 15_000_000


def test_a_large_machine_is_easier_to_read_than_in_other_layouts(
    counting: ModuleType, large: Picture
) -> None:
    """The bounds are the counts of ELK: `make bench BENCH=diagram`."""
    found = counting.counts(counting.drawing_of(large))

    assert found.crossings < 224
    assert found.bends < 538
    # 41 in ELK.
    assert found.jogs < 10
    # 310,000 in ELK, where twice the area leaves room for straight edges.
    assert found.length < 330_000
    # 1,500 in ELK.
    assert found.label_distance < 170
    assert found.on_rules == found.head_to_head == 0


def test_a_small_edit_moves_little(mission: Diagram, large: Picture) -> None:
    """States stay where they are to each other when a transition is added."""
    edge = Edge("new", "transition", "Survey.Coverage.FlyStrip", "Survey.Coverage.SelectStrip")
    edited = lay_out(replace(mission, edges=(*mission.edges, edge)))
    before, after = (
        {box.node.id: (box.x, box.y) for box in picture.boxes} for picture in (large, edited)
    )
    turned = sum(
        (before[one][axis] < before[other][axis]) != (after[one][axis] < after[other][axis])
        for one in before
        for other in before
        for axis in (0, 1)
        if one < other
    )

    assert turned < 0.1 * len(before) ** 2


def test_arrow_heads_inside_and_outside_are_apart(counting: ModuleType) -> None:
    """They end at the same border, from both sides."""
    inner = tuple(Node(f"c.{at}", "state", f"Inner{at}") for at in range(3))
    nodes = (Node("a", "state", "A"), Node("c", "composite", "C", nodes=inner))
    edges = [Edge(f"in{at}", "transition", f"c.{at}", "c", ("Up",)) for at in range(3)]
    edges += (Edge(f"out{at}", "transition", "a", "c", ("In",)) for at in range(2))
    edges += (Edge(f"back{at}", "transition", "c", "a", ("Back",)) for at in range(2))
    frame = Node("", "frame", "Machine", "statemachine", nodes=nodes)
    diagram = Diagram("statechart", "Machine", frame, tuple(edges))
    for direction in ("down", "right", None):
        drawing = counting.drawing_of(lay_out(diagram, direction))  # type: ignore[arg-type]
        assert not counting.head_to_head(drawing), direction


def test_the_label_of_a_short_state_beside_a_long_one_is_near() -> None:
    """Not beside the layer that the two share."""
    inner = tuple(Node(f"long.{at}", "state", f"Inner{at}") for at in range(5))
    nodes = (
        Node("start", "state", "Start"),
        Node("long", "composite", "Long", nodes=inner),
        Node("wait", "state", "Wait"),
    )
    edges = [
        Edge(f"in{at}", "transition", f"long.{at}", f"long.{at + 1}", ("Next",)) for at in range(4)
    ]
    edges += (Edge(f"to {to}", "transition", "start", to, ("Go",)) for to in ("long", "wait"))
    edges.append(Edge("back", "transition", "wait", "start", ("Back",)))
    frame = Node("", "frame", "Machine", "statemachine", nodes=nodes)
    picture = lay_out(Diagram("statechart", "Machine", frame, tuple(edges)), "right")
    boxes = {box.node.id: box for box in picture.boxes}
    line = picture.lines[-1]
    assert line.label is not None

    # The state is in the middle of the long one, far from both ends.
    assert boxes["wait"].x - boxes["long"].x > 100
    assert 0 <= boxes["wait"].x - (line.label_x + line.label.width) < 20


def test_levels_have_directions_of_their_own() -> None:
    """A chain of composites with chains inside is neither a column nor a row."""
    steps = [
        tuple(Node(f"p{phase}.s{at}", "state", f"Step{at}") for at in range(6))
        for phase in range(6)
    ]
    phases = tuple(
        Node(f"p{at}", "composite", f"Phase{at}", nodes=inner) for at, inner in enumerate(steps)
    )
    edges = [
        Edge(f"e{phase}{at}", "transition", f"p{phase}.s{at}", f"p{phase}.s{at + 1}", ("Next",))
        for phase in range(6)
        for at in range(5)
    ]
    edges += (Edge(f"e{at}", "transition", f"p{at}", f"p{at + 1}", ("Done",)) for at in range(5))
    frame = Node("", "frame", "Machine", "statemachine", nodes=phases)
    picture = lay_out(Diagram("statechart", "Machine", frame, tuple(edges)))
    at = {box.node.id: (box.x, box.y) for box in picture.boxes}
    outside = at["p0"][1] == at["p5"][1]
    inside = at["p0.s0"][1] == at["p0.s5"][1]

    assert outside != inside
    assert 1 / 3 <= picture.width / picture.height <= 3


@pytest.mark.parametrize("direction", ["down", "right", None])
def test_edges_that_enter_the_same_state_do_not_cross(
    counting: ModuleType, direction: Direction | None
) -> None:
    """The order of edges at a border is that of the level outside."""
    outside = tuple(Node(f"a{at}", "state", f"A{at}") for at in range(6))
    inside = tuple(Node(f"c.{at}", "state", f"Inner{at}") for at in range(2))
    nodes = (*outside, Node("c", "composite", "C", nodes=inside))
    # Against the order of the states, so that it must be found.
    edges = [
        Edge(f"in{at}{to}", "transition", f"a{at}", f"c.{to}", ("In",))
        for to in (1, 0)
        for at in (5, 2, 0, 4, 1, 3)
        if at % 2 == to
    ]
    frame = Node("", "frame", "Machine", "statemachine", nodes=nodes)
    picture = lay_out(Diagram("statechart", "Machine", frame, tuple(edges)), direction)

    assert not counting.crossings(counting.drawing_of(picture))
