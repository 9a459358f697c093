"""Names that machines cannot have besides those that target `ros2` does not take."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.diagnostics import Diagnostics

from ..ros2.view import MachineView
from .ways import TARGET

_MODULES = ("following", "runner")


def check_modules(machines: Sequence[MachineView], report: Diagnostics) -> None:
    """Report machines whose modules would be those of others, or of the package."""
    charts = {machine.module for machine in machines}
    for machine in machines:
        module = f"{machine.module}_fsm"
        if machine.module in _MODULES or module in charts:
            name = module if module in charts else machine.module
            report.report(
                "bad-identifier", machine.origin, target=TARGET, name=name, use="a module name"
            )
