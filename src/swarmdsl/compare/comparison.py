"""Two models compared."""

from __future__ import annotations

from swarmdsl.compare.architecture import system_element
from swarmdsl.compare.breaking import Breach, breaches
from swarmdsl.compare.changes import Change, changes_between
from swarmdsl.ir import System


def compare(before: System, after: System) -> tuple[list[Change], list[Breach]]:
    """All differences, and what of them breaks what others build on the model."""
    changes, matching = changes_between(system_element(before), system_element(after))
    return changes, list(breaches(changes, matching))
