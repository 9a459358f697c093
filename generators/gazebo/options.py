"""Options of target `gazebo`."""

from __future__ import annotations

from swarmdsl.codegen import dataclass, option

from ..environments.lengths import length_fault


@dataclass(frozen=True)
class Options:
    """Options of target `gazebo`."""

    sdf: str = option(
        "1.9",
        "version of the format: `1.9` for Gazebo Fortress and later, `1.6` for Gazebo Classic",
        choices=("1.9", "1.6"),
    )
    thickness: str = option("0.1", "thickness of walls in m", check=length_fault)
    height: str = option(
        "3",
        "height in m of what has none, in an environment without a height",
        check=length_fault,
    )
