"""Options of target `nav2_map`."""

from __future__ import annotations

from swarmdsl.codegen import dataclass, option

from ..environments.lengths import length_fault, optional_length_fault


@dataclass(frozen=True)
class Options:
    """Options of target `nav2_map`."""

    resolution: str = option("0.05", "side of a cell in m", check=length_fault)
    thickness: str = option("0.1", "thickness of walls in m", check=length_fault)
    zones: bool = option(True, "whether cells of zones are occupied, too")
    below: str = option(
        "",
        "height of the robots in m: what begins above it is left out; all is there if empty",
        check=optional_length_fault,
    )
