"""Interface of the action or service that an activity calls."""

from __future__ import annotations

from swarmdsl.analysis.resolve.interfaces import Interfaces
from swarmdsl.syntax.ast import (
    ActionType,
    Activity,
    Communication,
    Field,
    Function,
    Operation,
    Parameter,
    ServiceType,
)
from swarmdsl.syntax.types import Named


def called_interface(
    function: Function | None, interfaces: Interfaces
) -> ActionType | ServiceType | None:
    """Return the action or service of a function, None if it is unknown."""
    items = function.items if function is not None else ()
    call = next((item for item in items if isinstance(item, Communication)), None)
    if call is None or not isinstance(call.type.type, Named):
        return None
    kind = ActionType if call.paradigm == "action" else ServiceType
    known = interfaces.get(call.type.type, kind)
    return known if isinstance(known, (ActionType, ServiceType)) else None


def taken_fields(activity: Activity, interfaces: Interfaces) -> list[Field] | list[Parameter]:
    """Return the fields that an activity can set: of a goal, of a request or of an operation."""
    function = activity.function.target
    if isinstance(function, Operation):
        return [each for each in function.parameters if each.direction != "out"]
    match called_interface(function, interfaces):
        case ActionType(goal=fields) | ServiceType(request=fields):
            return fields
    return []
