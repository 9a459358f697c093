"""Options of the generated packages."""

from __future__ import annotations

from swarmdsl.codegen import dataclass, option
from swarmdsl.codegen.ros import PackageOptions


@dataclass(frozen=True)
class Options(PackageOptions):
    """The options of the target."""

    language: str = option("python", "language of the nodes", choices=("python", "cpp"))
    ros: int = option(1, "version of ROS that the nodes run on", choices=("1", "2"))
    only: str = option(
        "", "names of functions and components to write, separated by commas; all when empty"
    )
    interfaces: bool = option(
        True, "write the packages of the model's interfaces; false if another target writes them"
    )
