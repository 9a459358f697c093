"""Events and functions."""

from __future__ import annotations

from swarmdsl.syntax import (
    ActionType,
    Communication,
    Event,
    Function,
    FunctionPort,
    MessageType,
    Param,
    ServiceType,
)
from swarmdsl.validate.context import Context


def check_event(event: Event, context: Context) -> None:
    """An event comes with a message."""
    context.check_kind(event.type, MessageType)


def check_function(function: Function, context: Context) -> None:
    """A function is called in one way, and its ports carry messages."""
    calls = [item for item in function.items if isinstance(item, Communication)]
    if not calls:
        context.report.report(
            "unbound-function",
            function.name.span,
            name=function.name,
            help='say how it is called, `action "cmd/name" : package/Type` for instance',
        )
    context.check_single([call.span for call in calls], "how the function is called")
    for item in function.items:
        match item:
            case Communication():
                wanted = ActionType if item.paradigm == "action" else ServiceType
                context.check_kind(item.type, wanted)
            case FunctionPort():
                context.check_kind(item.type, MessageType)
            case Param():
                context.check_default(item, item.default)
