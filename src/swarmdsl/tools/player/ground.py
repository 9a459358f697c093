"""Ground of the map in the player: the environment as SVG, and how places get on it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from swarmdsl.execution.simulate.pictures.map_svg import (
    DEFINITIONS,
    MapDrawing,
    Moment,
    Place,
    Track,
    number,
)
from swarmdsl.execution.simulate.pictures.run_map import ground_of
from swarmdsl.ir import Environment


def ground(
    environment: Environment | None, places: Iterable[Place], roles: Iterable[str]
) -> dict[str, Any] | None:
    """Return the ground of a run as plain data, None if nobody is anywhere.

    `svg` is the picture, a part of a page. A place is at `left + x * scale`, `bottom - y * scale`
    in it. `colours` are those of the roles.
    """
    known = list(places)
    if not known:
        return None
    tracks = [Track(role, role, ()) for role in roles]
    drawing = MapDrawing("", ground_of(environment, known), Moment(0, tracks))
    drawing.shapes()
    low = drawing.ground.low
    box = (drawing.x(low.x), drawing.y(drawing.ground.high.y), drawing.width, drawing.height)
    view = f'viewBox="{" ".join(map(number, box))}"'
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" {view}>', DEFINITIONS, *drawing.parts]
    return {
        "svg": "\n".join([*svg, "</svg>"]),
        "left": drawing.x(0.0),
        "bottom": drawing.y(0.0),
        "scale": drawing.scale,
        "colours": drawing.colours,
    }
