"""What a model does not say and yet means, shown beside its text.

The policies are those of the CPSwarm project (D5.4, 5.2), as `swarmc build` writes them.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from swarmdsl.analysis.types.enum_values import numbers
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace.references import owners
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    Activity,
    Connector,
    Constant,
    EnumType,
    NameUse,
    Param,
    Role,
    TopLevel,
    nodes_of,
    walk,
)


@dataclass(frozen=True)
class Hint:
    """Text to be shown at an offset of a file, and what it says in whole."""

    offset: int
    text: str
    about: str
    kind: Literal["type", "parameter", ""] = ""


def hints(file: File, within: Span) -> Iterator[Hint]:
    """What can be shown in a part of a file."""
    for owner in owners(file):
        span = owner.span.absolute
        if span.start <= within.end and within.start <= span.end:
            base = span.start - owner.span.start
            for hint in _of_owner(owner):
                place = hint.offset + base
                if within.start <= place <= within.end:
                    yield Hint(place, hint.text, hint.about, hint.kind)


def _of_owner(owner: TopLevel) -> Iterator[Hint]:
    for activity in nodes_of(owner, Activity):
        yield from _policies(activity)
    for connector in nodes_of(owner, Connector):
        port = connector.source.port.target or connector.target.port.target
        if port is not None:
            text = port.type.span.text
            yield Hint(connector.span.end, f" : {text}", "the type of the ports", "type")
    for role in nodes_of(owner, Role):
        if role.multiplicity is None:
            yield Hint(role.span.end, "[1]", "one member, where nothing is said")
    if isinstance(owner, EnumType):
        known = numbers(owner)
        for value in owner.values:
            if not value.value and str(value.name) in known:
                yield Hint(value.span.end, f" = {known[str(value.name)]}", "its number")


def _policies(activity: Activity) -> Iterator[Hint]:
    """Where the goal comes from, and where the result goes."""
    if activity.function.target is None:
        return
    goal = _goal_policy(activity)
    result = "empty"
    if activity.result_callback is not None:
        result = "callback"
    elif activity.results:
        result = "userdata"
    end = activity.span.end
    about = f"goal policy: {goal}; result policy: {result}"
    yield Hint(end, f" {goal} → {result}", about)


def _goal_policy(activity: Activity) -> str:
    if activity.goal_callback is not None:
        return "callback"
    if not activity.arguments:
        return "empty"
    uses = (
        use
        for argument in activity.arguments
        for use in walk(argument.value)
        if isinstance(use, NameUse)
    )
    return "fixed" if all(map(_is_known, uses)) else "userdata"


def _is_known(use: NameUse) -> bool:
    """Whether a name stands for a value that is known when a model is compiled."""
    if isinstance(use.target, Param):
        return use.target.default is not None
    return isinstance(use.target, (Constant, EnumType))
