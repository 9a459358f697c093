"""Where the content of a call comes from, as D5.4 (5.2) names it; the model only implies it."""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.codegen.shared.constants import constant
from swarmdsl.ir import Activity, Param, Policy


def goal_policy(activity: Activity, params: Mapping[str, Param]) -> Policy:
    """Where the goal or request comes from."""
    if activity.goal_callback is not None:
        return Policy.CALLBACK
    if not activity.arguments:
        return Policy.EMPTY
    if all(constant(value, params) is not None for _, value in activity.arguments):
        return Policy.FIXED
    return Policy.USERDATA


def result_policy(activity: Activity) -> Policy:
    """Where the result or response goes."""
    if activity.result_callback is not None:
        return Policy.CALLBACK
    return Policy.USERDATA if activity.results else Policy.EMPTY
