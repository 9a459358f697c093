"""Comparison of two models."""

from __future__ import annotations

from swarmdsl.base.records import replace
from swarmdsl.ir import System
from swarmdsl.tools.compare.breaking_changes import BreakingChange, find_breaking_changes
from swarmdsl.tools.compare.changes import Change, changes_between, display_name
from swarmdsl.tools.compare.delivery import offers_less
from swarmdsl.tools.compare.model import model_element
from swarmdsl.tools.compare.strength import strength


def compare(before: System, after: System) -> tuple[list[Change], list[BreakingChange]]:
    """Return all changes, and those that break users of the model."""
    changes, matching = changes_between(model_element(before), model_element(after))
    were = {each.name: each for each in before.properties}
    are = {each.name: each for each in after.properties}
    lessened = []
    for index, each in enumerate(changes):
        if each.kind == "property" and each.property_name == "says" and each.old is not None:
            old, new = were[display_name(each.old)], are[display_name(each.element)]
            changes[index] = replace(each, strength=strength(old, new))
        if each.property_name == "delivery" and each.old is not None:
            name = display_name(each.element)
            delivered = before.event(display_name(each.old)).delivery
            lessened += [name] if offers_less(delivered, after.event(name).delivery) else []
    return changes, list(find_breaking_changes(changes, matching, lessened))
