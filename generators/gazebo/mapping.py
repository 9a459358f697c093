"""Mapping of each item of an environment, for `swarmc targets gazebo`.

Text between backticks occurs in the generated files.
"""

from __future__ import annotations

from swarmdsl.codegen import Mapped, Support

_EXACT, _EMULATED, _REJECTED = Support.EXACT, Support.EMULATED, Support.REJECTED

MAPPING: tuple[Mapped, ...] = (
    Mapped("size", _EXACT, "ground of this size: `<plane>`"),
    Mapped("name of another world", _REJECTED, "not read and not written: it is another file"),
    Mapped("area", _EMULATED, "visual without collision: `area_`"),
    Mapped("zone", _EMULATED, "visual without collision, nothing keeps robots out: `zone_`"),
    Mapped("wall", _EXACT, "a box between two points: `wall_1`"),
    Mapped("obstacle", _EXACT, "a box or a cylinder: `obstacle_`"),
    Mapped("wall, obstacle or zone without a height", _EMULATED, "up to option `height`"),
    Mapped("target at a point", _EMULATED, "small model without collision: `target_`"),
    Mapped("target at random", _REJECTED, "not placed (SW0916)"),
    Mapped("wind for the whole run", _EXACT, "`<wind>`"),
    Mapped("wind at times", _REJECTED, "left out: a world has one wind (SW0916)"),
    Mapped("rain", _REJECTED, "left out (SW0916)"),
)
