"""Convert a diagram to a graph of ELK, and the laid-out graph to what is counted."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

from picture_counts import Drawing, Point
from swarmdsl.codegen.diagram.graph import Diagram, Edge, Node
from swarmdsl.tools.diagram.layout.edge_routes import EdgeRoutes
from swarmdsl.tools.diagram.shapes import shape_of
from swarmdsl.tools.diagram.text_blocks import label_block

Handling = Literal["INCLUDE_CHILDREN", "SEPARATE_CHILDREN"]
ElkDirection = Literal["DOWN", "RIGHT"]
DIRECTIONS: tuple[ElkDirection, ...] = ("DOWN", "RIGHT")

_PADDING = 18
_OTHER: dict[ElkDirection, ElkDirection] = {"DOWN": "RIGHT", "RIGHT": "DOWN"}


def elk_graph(diagram: Diagram, handling: Handling, direction: ElkDirection) -> dict[str, Any]:
    """Return a state machine with the same sizes of boxes and labels as in swarmdsl.

    With SEPARATE_CHILDREN the direction alternates from level to level, and an edge that crosses
    borders is one edge in each state that it crosses, between ports on the borders.
    """
    routes = EdgeRoutes(diagram)
    alternates = handling == "SEPARATE_CHILDREN"
    made: dict[str, dict[str, Any]] = {}

    def node(each: Node, way: ElkDirection) -> dict[str, Any]:
        shape = shape_of(each, "down" if way == "DOWN" else "right", set())
        found: dict[str, Any] = {"id": each.id or "root", "ports": [], "edges": []}
        made[each.id] = found
        options = {
            "elk.algorithm": "layered",
            "elk.direction": way,
            "elk.edgeRouting": "ORTHOGONAL",
            "elk.hierarchyHandling": handling,
        }
        found["layoutOptions"] = options
        if not each.nodes:
            found |= {"width": shape.width, "height": shape.height}
            return found
        top = shape.block.height + _PADDING
        options["elk.padding"] = f"[top={top},left={_PADDING},bottom={_PADDING},right={_PADDING}]"
        options["elk.nodeSize.constraints"] = "[MINIMUM_SIZE]"
        options["elk.nodeSize.minimum"] = f"({shape.width},{top + _PADDING})"
        inner = _OTHER[way] if alternates else way
        found["children"] = [node(child, inner) for child in each.nodes]
        return found

    root = node(diagram.frame, direction)
    root["layoutOptions"] |= {"elk.json.edgeCoords": "ROOT", "elk.json.shapeCoords": "ROOT"}
    for number, edge in enumerate(diagram.edges):
        if not alternates or number not in routes.routes:
            container = root if not alternates else made[routes.parents[edge.source]]
            container["edges"].append(_edge(f"{number}:0", edge.source, edge.target, edge))
            continue
        route = routes.routes[number]
        previous = edge.source
        for leg, (within, source, target) in enumerate(route.legs):
            if leg == 0 and source is None:
                previous = _port(made[within], number, -1)
            end = edge.target
            if leg < len(route.legs) - 1 or target is None:
                # It ends at the border of the state that it is in, or crosses one.
                end = _port(made[within if target is None else target], number, leg)
            labelled = edge if leg == route.main else None
            made[within]["edges"].append(_edge(f"{number}:{leg}", previous, end, labelled))
            previous = end
    return root


def _port(node: dict[str, Any], number: int, leg: int) -> str:
    id_ = f"port {number} {leg}"
    node["ports"].append({"id": id_, "width": 0, "height": 0})
    return id_


def _edge(id_: str, source: str, target: str, labelled: Edge | None) -> dict[str, Any]:
    made: dict[str, Any] = {"id": id_, "sources": [source], "targets": [target]}
    if labelled is not None and labelled.label:
        block = label_block(labelled.label)
        made["labels"] = [{"text": "label", "width": block.width, "height": block.height}]
    return made


def drawing_of_elk(diagram: Diagram, laid_out: Mapping[str, Any]) -> Drawing:
    """Return what is counted of a laid-out graph."""
    found = Drawing(laid_out["width"], laid_out["height"])
    nodes = {each.id: each for each in diagram.frame.walk()}
    pieces: dict[int, dict[int, Any]] = {}

    def walk(laid: Mapping[str, Any]) -> None:
        node = nodes["" if laid["id"] == "root" else laid["id"]]
        if node.kind not in ("frame", "region"):
            block = shape_of(node, "down", set()).block
            heights = [*block.rules, *[block.height] * bool(node.nodes)]
            left, right = laid["x"], laid["x"] + laid["width"]
            found.rules += ((left, right, laid["y"] + height) for height in heights)
        for edge in laid.get("edges", ()):
            number, _, leg = edge["id"].partition(":")
            pieces.setdefault(int(number), {})[int(leg)] = edge
        for child in laid.get("children", ()):
            walk(child)

    walk(laid_out)
    for legs in (pieces[number] for number in sorted(pieces)):
        points: list[Point] = []
        label = None
        for edge in (legs[leg] for leg in sorted(legs)):
            for section in edge["sections"]:
                bends: Sequence[Any] = section.get("bendPoints", ())
                for point in (section["startPoint"], *bends, section["endPoint"]):
                    points.append((point["x"], point["y"]))
            for each in edge.get("labels", ()):
                x, y = each["x"], each["y"]
                label = (x, y, x + each["width"], y + each["height"])
        found.lines.append(straightened(points))
        found.has_head.append(True)
        found.labels.append(label)
    return found


def straightened(points: Sequence[Point]) -> list[Point]:
    """Remove points at which a line does not bend."""
    found: list[Point] = []
    for point in points:
        if found and _near(point, found[-1]):
            continue
        while len(found) > 1 and any(
            abs(found[-2][axis] - found[-1][axis]) < 0.5
            and abs(found[-1][axis] - point[axis]) < 0.5
            for axis in (0, 1)
        ):
            found.pop()
        found.append(point)
    return found


def _near(one: Point, other: Point) -> bool:
    return abs(one[0] - other[0]) < 0.5 and abs(one[1] - other[1]) < 0.5
