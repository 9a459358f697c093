"""Catalogue of the models that functions can have in space, with their arguments.

What they do is in `execution/space/functions/`; this is what a model or a scenario may say of them.
Lengths are in metres, speeds in m/s, angles in radians, times in nanoseconds.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal, NamedTuple

ArgumentKind = Literal[
    "length", "speed", "angle", "time", "number", "share", "place", "area", "text"
]
"""A `place` is a message with a position in it, an `area` and a `text` are strings."""


class Argument(NamedTuple):
    """Argument of a model; with `default` None, the model chooses a value by itself."""

    name: str
    kind: ArgumentKind
    default: float | str | None
    doc: str


class FunctionModel(NamedTuple):
    """Model of a function: what it does, its arguments, and how it can end."""

    name: str
    doc: str
    arguments: tuple[Argument, ...] = ()
    outcomes: tuple[str, ...] = ("succeeded", "aborted")

    def argument(self, name: str) -> Argument | None:
        """Return the argument of that name, or None."""
        return next((each for each in self.arguments if each.name == name), None)


_HEIGHT = Argument("height", "length", None, "height above the ground; that of now without it")
_SPEED = Argument("speed", "speed", None, "speed; that of the body without it")

MODELS: Mapping[str, FunctionModel] = {
    each.name: each
    for each in (
        FunctionModel(
            "go_to",
            "Go to a place in a straight line.",
            (
                Argument("to", "place", None, "the place; without it, the first one in the goal"),
                _HEIGHT,
                _SPEED,
                Argument("tolerance", "length", 0.1, "distance at which it has arrived"),
            ),
        ),
        FunctionModel(
            "random_walk",
            "Go straight on, and in another direction after a distance or a contact.",
            (
                Argument("leg", "length", 10.0, "mean distance between two turns"),
                Argument("time", "time", None, "time after which it succeeds; without it, never"),
                _HEIGHT,
                _SPEED,
            ),
        ),
        FunctionModel(
            "coverage",
            "Sweep an area in parallel lanes, each robot its share; end where a target is seen.",
            (
                Argument("width", "length", 5.0, "distance between two lanes"),
                Argument("area", "area", None, "name of the area; without it, the environment"),
                _HEIGHT,
                _SPEED,
                Argument("target", "text", None, "kind of target that ends it; without it, any"),
            ),
        ),
    )
}
