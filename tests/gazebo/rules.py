"""Rules of SDF 1.6 and 1.9 for the elements of a world without robots."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import Any

COLOUR, VECTOR, POSE, NUMBER, FLAG, PLANE = "colour", "vector", "pose", "number", "flag", "plane"
LENGTHS = {COLOUR: 4, VECTOR: 3, POSE: 6, NUMBER: 1, PLANE: 2}

# Attributes, children with the number of them, and elements of which there is exactly one.
ELEMENTS: dict[str, tuple[set[str], dict[str, str], set[str]]] = {
    "sdf": ({"version"}, {"world": "1"}, set()),
    "world": ({"name"}, {"wind": "?", "light": "*", "model": "*"}, set()),
    "wind": (set(), {"linear_velocity": "?"}, set()),
    "light": (
        {"name", "type"},
        {"pose": "?", "cast_shadows": "?", "diffuse": "?", "specular": "?", "direction": "1"},
        set(),
    ),
    "model": ({"name"}, {"static": "?", "pose": "?", "link": "*"}, set()),
    "link": ({"name"}, {"pose": "?", "collision": "*", "visual": "*"}, set()),
    "collision": ({"name"}, {"pose": "?", "geometry": "1"}, set()),
    "visual": (
        {"name"},
        {"pose": "?", "geometry": "1", "material": "?", "transparency": "?", "cast_shadows": "?"},
        set(),
    ),
    "geometry": (set(), {"box": "?", "cylinder": "?", "plane": "?"}, {"box", "cylinder", "plane"}),
    "box": (set(), {"size": "1"}, set()),
    "cylinder": (set(), {"radius": "1", "length": "1"}, set()),
    "plane": (set(), {"normal": "1", "size": "1"}, set()),
    "material": (set(), {"ambient": "?", "diffuse": "?"}, set()),
}
VALUES = {
    "pose": POSE,
    "linear_velocity": VECTOR,
    "direction": VECTOR,
    "normal": VECTOR,
    "diffuse": COLOUR,
    "specular": COLOUR,
    "ambient": COLOUR,
    "radius": NUMBER,
    "length": NUMBER,
    "transparency": NUMBER,
    "static": FLAG,
    "cast_shadows": FLAG,
}


def faults(root: Any) -> Iterator[str]:
    """Yield what is wrong in a file, from its root."""
    if root.tag != "sdf":
        yield f"the root is {root.tag}"
    for element in root.iter():
        if isinstance(element.tag, str):
            yield from (f"{element.tag}: {fault}" for fault in _faults(element))


def _faults(element: Any) -> Iterator[str]:
    children = [child for child in element if isinstance(child.tag, str)]
    kind = VALUES.get(element.tag)
    if element.tag == "size":
        kind = PLANE if element.getparent().tag == "plane" else VECTOR
    if kind is not None:
        yield from _value_faults(element, kind)
        if children or element.attrib:
            yield "more than a value"
        return
    if element.tag not in ELEMENTS:
        yield "there is no such element"
        return
    attributes, allowed, one_of = ELEMENTS[element.tag]
    if set(element.attrib) != attributes:
        yield f"attributes {sorted(element.attrib)}"
    numbers = Counter(child.tag for child in children)
    yield from (f"has a {tag}" for tag in numbers if tag not in allowed)
    for tag, number in allowed.items():
        if (number == "1" and numbers[tag] != 1) or (number == "?" and numbers[tag] > 1):
            yield f"has {numbers[tag]} {tag}"
    if one_of and sum(numbers[tag] for tag in one_of) != 1:
        yield f"has {dict(numbers)}"
    yield from _name_faults(children)


def _name_faults(children: list[Any]) -> Iterator[str]:
    """Names beside each other differ, whatever has them; some are reserved."""
    names = Counter(child.get("name") for child in children if "name" in child.attrib)
    for name, number in names.items():
        if number > 1:
            yield f"{number} are called {name}"
        if not name or "::" in name or (name.startswith("__") and name.endswith("__")):
            yield f"the name {name!r} is reserved"
        if name == "world":
            yield "the name `world` is reserved"


def _value_faults(element: Any, kind: str) -> Iterator[str]:
    words = (element.text or "").split()
    if kind == FLAG:
        if words not in (["true"], ["false"]):
            yield f"{words} is no truth value"
        return
    numbers = [float(word) for word in words]
    if len(numbers) != LENGTHS[kind]:
        yield f"has {len(numbers)} numbers"
    if kind == COLOUR and not all(0 <= number <= 1 for number in numbers):
        yield f"{numbers} is no colour"
    if element.tag in ("size", "radius", "length") and not all(number > 0 for number in numbers):
        yield f"{numbers} has no room"
    if element.tag == "transparency" and not 0 <= numbers[0] <= 1:
        yield f"{numbers} is no transparency"
