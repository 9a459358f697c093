"""Interface of the action or service that an activity calls."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.analysis.resolve.interfaces import Interfaces
from swarmdsl.syntax.ast import (
    ActionType,
    Communication,
    Field,
    Function,
    Operation,
    Parameter,
    ServiceType,
)
from swarmdsl.syntax.types import Named

Fields = Sequence[Field] | Sequence[Parameter]


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


def call_fields(
    called: Function | Operation | None, interfaces: Interfaces
) -> tuple[Fields, Fields]:
    """Return the fields that a call takes, and those that it gives.

    They are those of a goal and result, of a request and response, or of an operation.
    """
    if isinstance(called, Operation):
        taken = [each for each in called.parameters if each.direction != "out"]
        return taken, [each for each in called.parameters if each.direction == "out"]
    match called_interface(called, interfaces):
        case ActionType(goal=sent, result=received):
            return sent, received
        case ServiceType(request=sent, response=received):
            return sent, received
    return (), ()
