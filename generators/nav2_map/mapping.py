"""Mapping of each item of an environment, for `swarmc targets nav2_map`.

Text between backticks occurs in the generated files.
"""

from __future__ import annotations

from swarmdsl.codegen import Mapped, Support

_EXACT, _EMULATED, _REJECTED = Support.EXACT, Support.EMULATED, Support.REJECTED

MAPPING: tuple[Mapped, ...] = (
    Mapped("size", _EXACT, "size of the image, in cells of `resolution`; `origin` in its corner"),
    Mapped("wall", _EMULATED, "occupied cells, with option `thickness`"),
    Mapped("obstacle", _EMULATED, "occupied cells"),
    Mapped("zone", _EMULATED, "occupied cells, with option `zones`"),
    Mapped("height", _EMULATED, "what begins above option `below` is left out"),
    Mapped("environment without size and content", _REJECTED, "left out (SW0916)"),
    Mapped("area", _REJECTED, "left out (SW0916)"),
    Mapped("target", _REJECTED, "left out (SW0916)"),
    Mapped("wind, rain", _REJECTED, "left out (SW0916)"),
    Mapped("map of more than 25 million cells", _REJECTED, "reported (SW0903)"),
)
