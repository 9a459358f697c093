"""Mapping of each construct of a model, for `swarmc targets yasmin`."""

from __future__ import annotations

from swarmdsl.codegen import Mapped, Support

from ..ros2_outcomes.mapping import mapping

_CANCELED = "the outcome of stopped machines (SW0905)"

MAPPING = mapping(
    "set_start_state('Deep')",
    "blackboard",
    own=[Mapped("state called `canceled`", Support.REJECTED, _CANCELED)],
)
