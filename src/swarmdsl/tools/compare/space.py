"""Geometry and weather of environments, and the sights of components, as elements."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator

from swarmdsl.codegen.swarm_printer.space import (
    Item,
    places,
    shape,
    space_items,
    times,
    wall_line,
    wind,
)
from swarmdsl.ir import Area, Environment, Obstacle, Rain, Sight, Targets, Wall, Wind, Zone
from swarmdsl.tools.compare.elements import Element, argument_values, properties, with_doc


def space_elements(environment: Environment) -> Iterator[Element]:
    """Yield an element for each item; those without a name of their own have a number."""
    seen: Counter[str] = Counter()
    for item in space_items(environment):
        kind, name, values = _described(item)
        seen[f"{kind} {name}"] += 1
        count = seen[f"{kind} {name}"]
        numbered = name if name and count == 1 else f"{name} {count}".strip()
        element = Element(kind, (numbered,), properties(**values), origin=item.origin)
        yield with_doc(element, item.doc)


def _described(item: Item) -> tuple[str, str, dict[str, object]]:
    """Return the kind, the name and the properties of an item."""
    match item:
        case Area() | Zone():
            return type(item).__name__.lower(), item.name, {"place": shape(item.box)}
        case Obstacle():
            return "obstacle", item.name, {"place": shape(item.shape)}
        case Wall():
            return "wall", "", {"line": wall_line(item)}
        case Targets():
            return "target", item.kind, {"number": item.count, "place": places(item)}
        case Wind():
            return "wind", "", {"wind": wind(item), "time": times(item)}
        case Rain():
            return "rain", "", {"time": times(item)}


def sight_elements(sights: Iterable[Sight]) -> Iterator[Element]:
    """Yield an element for each kind of target that a component finds."""
    for sight in sights:
        values = properties(values=argument_values(sight.values))
        element = Element("sight", (sight.kind,), values, origin=sight.origin)
        yield with_doc(element, sight.doc, sight.docs)
