"""What a person can choose about the generated packages."""

from __future__ import annotations

from swarmdsl.codegen import dataclass, option
from swarmdsl.codegen.ros import PackageOptions


@dataclass(frozen=True)
class Options(PackageOptions):
    """The options of the target."""

    language: str = option("python", "language of the nodes", choices=("python", "cpp"))
    ros: int = option(1, "generation of ROS that the nodes run on", choices=("1", "2"))
    only: str = option(
        "", "names of the functions and components to write, with commas; all when empty"
    )
    interfaces: bool = option(
        True, "write the packages of the model's interfaces; false where another target does"
    )
