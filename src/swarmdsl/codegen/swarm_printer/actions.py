"""Print effects and activities."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.codegen.swarm_printer.expressions import delay, expression
from swarmdsl.ir import Activity, Address, Assignment, Call, Cancel, Effect, Expression, Send


def effect_text(effect: Effect) -> str:
    """Return `x = 1`, `send Found(id = 7) to uav after 5 s` or `cancel Found`."""
    match effect:
        case Assignment(variable=variable, path=path, value=value):
            return store_text(".".join((variable, *path)), value)
        case Send(event=event, arguments=values, to=to, delay=length):
            given = f"({arguments(values)})" if values else ""
            given += f" to {address_text(to)}" if to is not None else ""
            given += f" after {delay(length)}" if length is not None else ""
            return f"send {event}{given}"
        case Cancel(event=event):
            return f"cancel {event}"


def store_text(target: str, value: Expression) -> str:
    """Return `x = 1`, or an effect on an array such as `append 1 to x`."""
    match value:
        case Call(function="append", arguments=(_, item, _)):
            return f"append {expression(item)} to {target}"
        case Call(function="remove", arguments=(_, index)):
            return f"remove {target}[{expression(index)}]"
        case Call(function="replace", arguments=(_, index, item)):
            return f"{target}[{expression(index)}] = {expression(item)}"
        case Call(function="empty"):
            return f"clear {target}"
    return f"{target} = {expression(value)}"


def address_text(address: Address) -> str:
    """Return `uav`, `uav[2]` or `event.sender`."""
    if address.id is not None:
        return expression(address.id)
    index = f"[{expression(address.index)}]" if address.index is not None else ""
    return f"{address.role}{index}"


def activity_text(activity: Activity, function: str) -> str:
    """Return `go(height = 2) gives (id => found)`, the function by the given name."""
    text = function
    if activity.goal_callback is not None:
        text += f"(by {activity.goal_callback})"
    elif activity.arguments:
        text += f"({arguments(activity.arguments)})"
    if activity.result_callback is not None:
        text += f" gives by {activity.result_callback}"
    elif activity.results:
        results = (
            f"{each.field} => {'.'.join((each.variable, *each.path))}" for each in activity.results
        )
        text += f" gives ({', '.join(results)})"
    return text


def arguments(values: Iterable[tuple[str, Expression]]) -> str:
    """Return `height = 2, name = "a"`."""
    return ", ".join(f"{name} = {expression(value)}" for name, value in values)
