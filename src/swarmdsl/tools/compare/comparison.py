"""Two models compared."""

from __future__ import annotations

from swarmdsl.ir import System
from swarmdsl.tools.compare.architecture import system_element
from swarmdsl.tools.compare.breaking_changes import Breach, breaches
from swarmdsl.tools.compare.changes import Change, changes_between


def compare(before: System, after: System) -> tuple[list[Change], list[Breach]]:
    """All differences, and what of them breaks what others build on the model."""
    changes, matching = changes_between(system_element(before), system_element(after))
    return changes, list(breaches(changes, matching))
