"""Layout of diagrams: nothing overlaps, and lines end where they should."""

from __future__ import annotations

import random
import re
from collections.abc import Sequence
from itertools import combinations, pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swarmdsl.codegen.diagram.graph import Diagram, Edge, Node
from swarmdsl.tools.diagram import layout
from swarmdsl.tools.diagram.layout import (
    Box,
    Picture,
    directions,
    lay_out,
    layering,
    routing,
    rows,
)
from swarmdsl.tools.diagram.layout.cycles import feedback_edges
from swarmdsl.tools.diagram.layout.simplex import Constraint, minimize
from swarmdsl.tools.diagram.measure import width, wrap
from swarmdsl.tools.diagram.shapes import PSEUDO_STATES, Direction

from .conftest import MODEL, drawn_of

Area = tuple[int, int, int, int]
DIRECTIONS: tuple[Direction | None, ...] = ("down", "right", None)
"""Forced for all levels, or chosen for each."""


def area(box: Box) -> Area:
    return box.x, box.y, box.x + box.width, box.y + box.height


def overlap(one: Area, other: Area) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


def within(inner: Area, outer: Area) -> bool:
    return (
        outer[0] <= inner[0]
        and outer[1] <= inner[1]
        and inner[2] <= outer[2]
        and inner[3] <= outer[3]
    )


def on_border(point: tuple[int, int], box: Box) -> bool:
    x, y, wide, high = box.core
    dx, dy = point[0] - x, point[1] - y
    if not (0 <= dx <= wide and 0 <= dy <= high):
        return False
    if box.node.kind in PSEUDO_STATES:
        away = abs(dx - wide // 2), abs(dy - high // 2)
        if box.node.kind == "choice":
            return sum(away) == wide // 2
        return abs((away[0] ** 2 + away[1] ** 2) ** 0.5 - wide // 2) < 1
    return dx in (0, wide) or dy in (0, high)


def check(picture: Picture) -> None:
    """All that must be so in a picture, whatever it is of."""
    boxes = {box.node.id: box for box in picture.boxes}
    whole = (0, 0, picture.width, picture.height)
    labels: list[Area] = []
    for line in picture.lines:
        if line.label is not None:
            x, y = line.label_x, line.label_y
            labels.append((x, y, x + line.label.width, y + line.label.height))
    for box in picture.boxes:
        assert within(area(box), whole), box.node.id
        for text in box.block.texts:
            left = text.x if text.x is not None else (box.width - text.width) // 2
            assert left >= 0, text
            assert left + text.width <= box.width, text
        head = (box.x, box.y, box.x + box.block.width, box.y + box.block.height)
        for child in box.node.nodes:
            assert within(area(boxes[child.id]), area(box)), child.id
            assert not overlap(area(boxes[child.id]), head), child.id
        for one, other in combinations(box.node.nodes, 2):
            assert not overlap(area(boxes[one.id]), area(boxes[other.id])), (one.id, other.id)
        if not box.node.nodes:
            for label in labels:
                assert not overlap(label, area(box)), (label, box.node.id)
    for label in labels:
        assert within(label, whole)
    for one, other in combinations(labels, 2):
        assert not overlap(one, other)
    for line in picture.lines:
        edge = line.edge
        for one, other in pairwise(line.points):
            assert (one[0] == other[0]) != (one[1] == other[1]), (edge.id, line.points)
            stretch = (
                *(min(a, b) for a, b in zip(one, other, strict=True)),
                *(max(a, b) for a, b in zip(one, other, strict=True)),
            )
            thin: Area = (stretch[0], stretch[1], stretch[2] + 1, stretch[3] + 1)
            for box in picture.boxes:
                inner = (box.x + 1, box.y + 1, box.x + box.width - 1, box.y + box.height - 1)
                ends = box.node.id in (edge.source, edge.target)
                if not box.node.nodes and not (ends and box.node.kind in PSEUDO_STATES):
                    assert not overlap(thin, inner), (edge.id, box.node.id)
            for label in labels:
                assert not overlap(thin, label), (edge.id, label)
        if edge.source_port is None:
            assert on_border(line.points[0], boxes[edge.source]), edge.id
            assert on_border(line.points[-1], boxes[edge.target]), edge.id


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_pictures_of_models(drawn: tuple[Diagram, ...], direction: Direction | None) -> None:
    for diagram in drawn:
        check(lay_out(diagram, "right" if diagram.kind == "internal" else direction))


def test_a_line_from_a_state_to_its_region(monkeypatch: pytest.MonkeyPatch) -> None:
    inside = Node("p.r.s", "state", "S")
    regions = (
        Node("p.r", "region", "R", nodes=(inside,)),
        Node("p.q", "region", "Q", nodes=(Node("p.q.s", "state", "S" * 60),)),
    )
    frame = Node(
        "", "frame", "M", "statemachine", nodes=(Node("p", "parallel", "P", nodes=regions),)
    )
    edge = Edge("e", "transition", "p.r.s", "p.r", ("Event",))
    for across in ("down", "right"):
        chosen = {"": "down", "p": "right", "p.r": across, "p.q": across}
        monkeypatch.setattr(layout, "choose_directions", lambda *_, found=chosen: [(found, {})])
        check(lay_out(Diagram("statechart", "M", frame, (edge,))))


def test_lines_end_at_the_ports_of_parts() -> None:
    diagram = next(each for each in drawn_of(MODEL) if each.kind == "internal")
    picture = lay_out(diagram)
    pins = {pin.port.id: pin for pin in picture.pins}
    assert len(pins) == 9
    for line in picture.lines:
        for port, point in (
            (line.edge.source_port, line.points[0]),
            (line.edge.target_port, line.points[-1]),
        ):
            assert port is not None
            assert point[1] == pins[port].y
            assert abs(point[0] - pins[port].x) == 5


def machines(seed: int) -> Diagram:
    """A state machine of random states in states, with random transitions."""
    chance = random.Random(seed)
    ids: list[str] = []

    def inside(prefix: str, depth: int) -> tuple[Node, ...]:
        nodes = []
        for number in range(chance.randint(1, 5)):
            id_ = f"{prefix}{number}"
            ids.append(id_)
            kind = chance.choice(("state", "state", "state", "choice", "final", "history"))
            children: tuple[Node, ...] = ()
            lines = tuple("word " * chance.randint(1, 20) for _ in range(chance.randint(0, 3)))
            if depth and chance.random() < 0.4:
                children = inside(f"{id_}.", depth - 1)
                kind = chance.choice(("composite", "parallel"))
                if kind == "parallel":
                    ids.append(f"{id_}.r")
                    region = Node(f"{id_}.r", "region", "Region", nodes=children)
                    ids.append(f"{id_}.q")
                    other = Node(f"{id_}.q", "region", "Other", nodes=inside(f"{id_}.q.", 0))
                    children = (region, other)
            shown = (lines,) if lines and kind in ("state", "composite", "parallel") else ()
            nodes.append(Node(id_, kind, "S" * chance.randint(1, 12), "", shown, children))  # type: ignore[arg-type]
        return tuple(nodes)

    frame = Node("", "frame", "Machine", "statemachine", nodes=inside("s", 2))
    # Nothing leads from a pseudo-state or a region to itself.
    no_loops = {*PSEUDO_STATES, "region"}
    states = [node.id for node in frame.walk() if node.id and node.kind not in no_loops]
    pairs = [
        (chance.choice(ids), chance.choice(ids)) for _ in range(chance.randint(0, 2 * len(ids)))
    ]
    edges = tuple(
        Edge(
            f"e{number}",
            "transition",
            source,
            target,
            ("event",) * chance.randint(0, 1) + ("[guard of some length]",) * chance.randint(0, 1),
        )
        for number, (source, target) in enumerate(pairs)
        if source != target or source in states
    )
    return Diagram("statechart", "Machine", frame, edges)


@settings(max_examples=60)
@given(st.integers(0, 2**32), st.sampled_from(DIRECTIONS))
def test_pictures_of_random_machines(seed: int, direction: Direction | None) -> None:
    check(lay_out(machines(seed), direction))


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32), st.sampled_from(DIRECTIONS))
def test_pictures_with_lanes_beside_all_else(seed: int, direction: Direction | None) -> None:
    """As in very large ones."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(layering, "_MAX_CROSSED", -1)
        patch.setattr(layering, "_NEAR", 0)
        check(lay_out(machines(seed), direction))


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32))
def test_pictures_with_levels_in_rows(seed: int) -> None:
    """As in large ones, whatever the shape."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(directions, "_PAGE", 0)
        patch.setattr(directions, "_LEAST_GAIN_OF_ROWS", -10)
        patch.setattr(rows, "MAX_LANES", 100)
        check(lay_out(machines(seed)))


def chain(count: int, extra: Sequence[tuple[int, int]] = ()) -> Diagram:
    """A state machine whose states follow each other, with further transitions."""
    states = tuple(Node(f"s{number}", "state", f"S{number}") for number in range(count))
    pairs = [*pairwise(range(count)), *extra]
    edges = tuple(
        Edge(f"e{number}", "transition", f"s{source}", f"s{target}", ("Next",))
        for number, (source, target) in enumerate(pairs)
    )
    frame = Node("", "frame", "Machine", "statemachine", nodes=states)
    return Diagram("statechart", "Machine", frame, edges)


def test_a_long_chain_has_rows_of_states_that_follow_each_other() -> None:
    picture = lay_out(chain(100))
    check(picture)
    assert 0.8 < picture.width / picture.height < 2.5, "it is a page, no strip"
    boxes = {box.node.id: box for box in picture.boxes}
    places = [(boxes[f"s{at}"].x, boxes[f"s{at}"].y) for at in range(100)]
    turned = 0
    for line, (one, other) in zip(picture.lines, pairwise(places), strict=True):
        if one[0] == other[0] or one[1] == other[1]:
            assert len(line.points) == 2, "it is straight within a row"
        else:
            turned += 1
            assert len(line.points) == 6, "it goes around the ends of two rows"
    assert 5 < turned < 20


def test_rows_begin_so_that_long_layers_are_beside_long_ones() -> None:
    # States and labels in turn, of which a share of a quarter ends between two.
    lengths = [250, 20] * 49
    starts = rows.starts_of_rows(lengths, [1] * 99, 4)
    assert len(starts) == 4
    assert all(start % 2 == 0 for start in starts), starts


def test_a_transition_to_a_row_far_away_passes_those_between() -> None:
    near, far = chain(100), chain(100, [(99, 0), (10, 90)])
    plain, picture = lay_out(near), lay_out(far)
    check(picture)
    assert picture.width * picture.height < 1.5 * plain.width * plain.height
    assert all(len(line.points) <= 12 for line in picture.lines[-2:])


def test_far_transitions_of_a_large_machine_share_lanes() -> None:
    count, far = 500, 60
    states = tuple(Node(f"s{number}", "state", f"S{number}") for number in range(count))
    edges = [Edge(f"e{n}", "transition", f"s{n}", f"s{n + 1}", ("Next",)) for n in range(count - 1)]
    for number in range(far):
        low, high = number, count - 1 - number
        edges.append(Edge(f"f{number}", "transition", f"s{low}", f"s{high}", ("Far",)))
    for number in range(2 * far, count - 2 * far, 10):
        edges.append(Edge(f"g{number}", "transition", f"s{number + 7}", f"s{number}"))
    frame = Node("", "frame", "Machine", "statemachine", nodes=states)
    picture = lay_out(Diagram("statechart", "Machine", frame, tuple(edges)), "down")
    check(picture)
    rights = [max(x for x, _ in line.points) for line in picture.lines]
    assert len(set(rights[count - 1 : count - 1 + far])) == far, "they would lie on each other"
    assert len(set(rights[count - 1 + far :])) == 1, "these do not meet"


@given(st.data())
def test_no_other_numbers_cost_less(data: st.DataObject) -> None:
    count = data.draw(st.integers(1, 5))
    pairs = [(tail, head) for tail in range(count) for head in range(tail + 1, count)]
    drawn = st.tuples(st.sampled_from(pairs or [(0, 0)]), st.integers(0, 2), st.integers(0, 3))
    some = data.draw(st.lists(drawn, max_size=8)) if pairs else []
    constraints: list[Constraint] = [(*pair, length, weight) for pair, length, weight in some]

    def cost(numbers: list[int]) -> int | None:
        if any(numbers[h] - numbers[t] < length for t, h, length, _ in constraints):
            return None
        return sum(weight * (numbers[h] - numbers[t]) for t, h, _, weight in constraints)

    found = cost(minimize(count, constraints))
    assert found is not None
    # No step that moves some of them by one makes it better: the costs are convex.
    numbers = minimize(count, constraints)
    for moved in range(1, 2**count):
        for step in (-1, 1):
            other = [n + step * (moved >> at & 1) for at, n in enumerate(numbers)]
            value = cost(other)
            assert value is None or value >= found


@given(st.lists(st.tuples(st.integers(0, 7), st.integers(0, 7)), max_size=20))
def test_without_backward_edges_there_are_no_circles(edges: list[tuple[int, int]]) -> None:
    flipped = feedback_edges(8, edges, (0,))
    rest = {edge for at, edge in enumerate(edges) if at not in flipped}
    left = set(range(8))
    while left:
        free = {
            node for node in left if not any(head == node and tail in left for tail, head in rest)
        }
        assert free
        left -= free


@given(st.text(min_size=1), st.integers(20, 200))
def test_lines_are_not_wider_than_asked_for(text: str, most: int) -> None:
    lines = wrap(text, "line", most)
    assert "".join(lines).split() == "".join(text.split()).split() or "".join(
        "".join(lines).split()
    ) == "".join(text.split())
    assert all(width(line, "line") <= most or re.fullmatch(r"\w+", line) for line in lines)


def test_identifiers_are_not_broken() -> None:
    text = "uav_mavros_takeoff(altitude=maximum_of_all_heights,target=event.position_of_finding)"

    lines = wrap(text, "line", 150)

    assert "".join(lines) == text
    assert len(lines) > 3
    assert not any(
        one[-1].isidentifier() and other[0].isidentifier() for one, other in pairwise(lines)
    )
    assert all(width(line, "line") <= 150 for line in lines)


def test_many_lines_from_one_state_are_not_compared_in_pairs(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    count, compared = 400, 0

    def counted(one: object, other: object) -> int:
        nonlocal compared
        compared += 1
        return 0

    monkeypatch.setattr(routing, "_cost", counted)
    states = tuple(Node(f"s{number}", "state", f"S{number}") for number in range(count))
    edges = tuple(Edge(f"e{n}", "transition", "s0", f"s{n}", (f"E{n}",)) for n in range(1, count))
    frame = Node("", "frame", "Machine", "statemachine", nodes=states)
    lay_out(Diagram("statechart", "Machine", frame, edges), "down")

    assert compared < count * count / 10
