"""What there is to know of a library that follows the engine."""

from __future__ import annotations

from swarmdsl.codegen import dataclass

from ..ros2.view import Variant


@dataclass(frozen=True)
class Library:
    """A library whose states end with outcomes.

    `target` is what reports call it, `name` what people do. What is stopped ends with the outcome
    `stopped`. `variant` is what its packages have besides those of target `ros2`; `packages` are
    those of ROS that it is in.
    """

    target: str
    name: str
    stopped: str
    variant: Variant
    packages: tuple[str, ...]

    @property
    def suffix(self) -> str:
        """The end of the name of the module of a machine in the library."""
        return self.variant.suffix
