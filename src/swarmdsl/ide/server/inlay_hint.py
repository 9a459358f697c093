"""Inlay hints: implicit types, multiplicities, enum values and policies.

Source of the policies: CPSwarm D5.4, section 5.2; `swarmc build` writes the same.
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
class InlayHint:
    """Hint at an offset of a file, with its tooltip in `about`."""

    offset: int
    text: str
    about: str
    kind: Literal["type", "parameter", ""] = ""


def inlay_hints(file: File, within: Span) -> Iterator[InlayHint]:
    """Yield the hints in a part of a file."""
    for owner in owners(file):
        span = owner.span.absolute
        if span.start <= within.end and within.start <= span.end:
            base = span.start - owner.span.start
            for hint in _declaration_hints(owner):
                place = hint.offset + base
                if within.start <= place <= within.end:
                    yield InlayHint(place, hint.text, hint.about, hint.kind)


def _declaration_hints(owner: TopLevel) -> Iterator[InlayHint]:
    for activity in nodes_of(owner, Activity):
        yield from _policies(activity)
    for connector in nodes_of(owner, Connector):
        port = connector.source.port.target or connector.target.port.target
        if port is not None:
            text = port.type.span.text
            yield InlayHint(connector.span.end, f" : {text}", "type of the ports", "type")
    for role in nodes_of(owner, Role):
        if role.multiplicity is None:
            yield InlayHint(role.member.span.end, "[1]", "default multiplicity: one member")
    if isinstance(owner, EnumType):
        known = numbers(owner)
        for value in owner.values:
            if not value.value and str(value.name) in known:
                yield InlayHint(value.span.end, f" = {known[str(value.name)]}", "implicit value")


def _policies(activity: Activity) -> Iterator[InlayHint]:
    """Yield the goal policy and the result policy of an activity."""
    if activity.function.target is None:
        return
    goal = _goal_policy(activity)
    result = "empty"
    if activity.result_callback is not None:
        result = "callback"
    elif activity.results:
        result = "userdata"
    if goal == result == "empty":
        return  # nothing is left implicit
    end = activity.span.end
    about = f"goal policy: {goal}; result policy: {result}"
    yield InlayHint(end, f" {goal} → {result}", about)


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
    """Return True if the value of a name is known at compile time."""
    if isinstance(use.target, Param):
        return use.target.default is not None
    return isinstance(use.target, (Constant, EnumType))
