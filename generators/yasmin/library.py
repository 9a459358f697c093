"""Properties of YASMIN as a library on ROS 2."""

from __future__ import annotations

from ..ros2.view import Variant
from ..ros2_outcomes.library import Library

YASMIN = Library(
    target="yasmin",
    name="YASMIN",
    stopped="canceled",
    variant=Variant(
        host="runner",
        suffix="_fsm",
        depends=(
            *(("depend", name) for name in ("yasmin", "yasmin_ros", "yasmin_viewer")),
            ("test_depend", "yasmin_factory"),
        ),
        folders=(("state_machines", "*.xml"),),
    ),
    packages=("yasmin", "yasmin_factory", "yasmin_ros", "yasmin_viewer"),
)
