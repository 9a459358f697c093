"""Print effects and activities."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.codegen.swarm_printer.expressions import expression
from swarmdsl.ir import Activity, Address, Assignment, Effect, Expression, Send


def effect_text(effect: Effect) -> str:
    """Return `x = 1` or `send Found(id = 7)`."""
    match effect:
        case Assignment(variable=variable, path=path, value=value):
            return f"{'.'.join((variable, *path))} = {expression(value)}"
        case Send(event=event, arguments=values, to=to):
            given = f"({arguments(values)})" if values else ""
            return f"send {event}{given}" + (f" to {address_text(to)}" if to is not None else "")


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
