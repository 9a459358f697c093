"""Variables of states in diagrams: in their states, with the names that the model has."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, TypeVar, cast

from swarmdsl.base.records import fields_of, replace
from swarmdsl.base.source import Span
from swarmdsl.ir import Assignment, Effect, ResultMapping, Variable, VariableRef

T = TypeVar("T")

_NAMES: Mapping[type, str] = {
    VariableRef: "name",
    Assignment: "variable",
    ResultMapping: "variable",
}


def local_names(variables: Iterable[Variable]) -> dict[str, str]:
    """Return the names in the model of those variables that have another one in the machine."""
    return {each.name: each.local for each in variables if each.local}


def renamed(node: T, names: Mapping[str, str]) -> T:
    """Return a node of the IR in which variables have other names."""
    if isinstance(node, Span):
        return node
    if isinstance(node, tuple):
        return cast("T", tuple(renamed(each, names) for each in node))
    if isinstance(node, Mapping):
        return cast("T", {key: renamed(each, names) for key, each in node.items()})
    if "__parts__" not in vars(type(node)):
        return node
    changed = {name: renamed(getattr(node, name), names) for name in fields_of(type(node))}
    name = _NAMES.get(type(node))
    if name is not None:
        changed[name] = names.get(changed[name], changed[name])
    return cast("T", replace(cast("Any", node), **changed))


def without_first_values(
    effects: Iterable[Effect], declared: Iterable[Variable]
) -> tuple[Effect, ...]:
    """Return the effects on entry without the first values of the variables of states."""
    places = {each.origin for each in declared}
    return tuple(each for each in effects if each.origin is None or each.origin not in places)
