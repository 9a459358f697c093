"""Properties of a library that follows the engine."""

from __future__ import annotations

from swarmdsl.codegen import dataclass

from ..ros2.view import Variant


@dataclass(frozen=True)
class Library:
    """A library whose states end with outcomes.

    `target` is its name in diagnostics, `name` its usual name. States that are stopped end with the
    outcome `stopped`. `variant` has the differences from target `ros2`; `packages` are the ROS
    packages of the library.
    """

    target: str
    name: str
    stopped: str
    variant: Variant
    packages: tuple[str, ...]

    @property
    def suffix(self) -> str:
        """Suffix of the module of a machine in the library."""
        return self.variant.suffix
