"""Source of the content of a call, by the policies of D5.4 (5.2)."""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.codegen.shared.constants import constant
from swarmdsl.ir import Activity, Param, Policy


def goal_policy(activity: Activity, params: Mapping[str, Param]) -> Policy:
    """Return the source of the goal or request."""
    if activity.goal_callback is not None:
        return Policy.CALLBACK
    if not activity.arguments:
        return Policy.EMPTY
    if all(constant(value, params) is not None for _, value in activity.arguments):
        return Policy.FIXED
    return Policy.USERDATA


def result_policy(activity: Activity) -> Policy:
    """Return the destination of the result or response."""
    if activity.result_callback is not None:
        return Policy.CALLBACK
    return Policy.USERDATA if activity.results else Policy.EMPTY
