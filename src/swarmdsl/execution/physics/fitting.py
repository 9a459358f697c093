"""Check that MuJoCo can move the bodies of robots."""

from __future__ import annotations

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.space.layout import Layout

_LEAST = {"radius": (0.01, "m"), "mass": (0.001, "kg")}
"""Least values of a body that MuJoCo moves reliably."""


def check_bodies(layout: Layout, report: Diagnostics) -> None:
    """Report bodies that are too small or too light, once for each type of member."""
    told = set()
    for unit in layout.units:
        kind = unit.robot.kind
        for name, (least, word) in _LEAST.items():
            value = getattr(unit.body, name)
            if value < least and (kind, name) not in told:
                told.add((kind, name))
                owner = f"the body of member `{kind}`"
                reason = f"is {value:g}: physics needs {least:g} {word} or more"
                report.report("unfit-device", name=name, owner=owner, reason=reason)
