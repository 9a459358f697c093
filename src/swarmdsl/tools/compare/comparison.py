"""Comparison of two models."""

from __future__ import annotations

from swarmdsl.ir import System
from swarmdsl.tools.compare.architecture import model_element
from swarmdsl.tools.compare.breaking_changes import BreakingChange, find_breaking_changes
from swarmdsl.tools.compare.changes import Change, changes_between


def compare(before: System, after: System) -> tuple[list[Change], list[BreakingChange]]:
    """Return all changes, and those that break users of the model."""
    changes, matching = changes_between(model_element(before), model_element(after))
    return changes, list(find_breaking_changes(changes, matching))
