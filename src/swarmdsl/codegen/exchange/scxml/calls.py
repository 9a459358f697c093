"""Calls of functions in the CPSwarm dialect (D5.4, 5.2).

The dialect has goals that are empty, constant, taken from userdata key by key, or made by a
callback. Any other goal becomes a callback for the user to complete.
"""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.base.records import dataclass
from swarmdsl.codegen.exchange.content_policy import goal_policy, result_policy
from swarmdsl.codegen.shared.constants import constant, params_by_name
from swarmdsl.ir import (
    Action,
    Activity,
    Expression,
    Field,
    Function,
    Param,
    Policy,
    Primitive,
    StateMachine,
    System,
    VariableRef,
)
from swarmdsl.ir.expression_printer import Dialect, envelope_name, python_literal, translate
from swarmdsl.syntax.types import DURATION


@dataclass(frozen=True)
class Call:
    """Activity in terms of the dialect.

    `goal_items` are the values of a fixed goal, in Python, or the fields of one from userdata;
    `mappings` are pairs of a field and the userdata key that stores it. `completion` lists the
    fields that the user has to fill in the goal callback; it may be empty.
    """

    function: Function
    goal: Policy
    goal_items: tuple[str, ...]
    result: Policy
    result_fields: tuple[str, ...]
    mappings: tuple[tuple[str, str], ...]
    completion: tuple[tuple[str, str], ...] = ()

    @property
    def is_action(self) -> bool:
        """True if the function is an action, not a service."""
        return self.function.communication.paradigm == "action"


def call_of(activity: Activity, machine: StateMachine, system: System) -> Call:
    """Return the call of an activity."""
    function = system.function(activity.function)
    params = params_by_name(machine.params)
    goal, items, from_goal = _goal(activity, function, params, system)
    results = tuple((each.field, each.variable) for each in activity.results)
    completion: tuple[tuple[str, str], ...] = ()
    if items is None or _has_conflict(from_goal, results):
        goal, items, from_goal = Policy.CALLBACK, (), ()
        completion = tuple((field, _python(value, params)) for field, value in activity.arguments)
    mappings = dict.fromkeys(pair for pair in (*from_goal, *results) if pair[0] != pair[1])
    return Call(
        function,
        goal,
        items,
        result_policy(activity),
        tuple(field for field, _ in results),
        tuple(mappings),
        completion,
    )


def _goal(
    activity: Activity, function: Function, params: Mapping[str, Param], system: System
) -> tuple[Policy, tuple[str, ...] | None, tuple[tuple[str, str], ...]]:
    """Return policy, items (None if the dialect has none) and mappings of a goal."""
    policy = goal_policy(activity, params)
    if policy is Policy.FIXED:
        return policy, _fixed(activity, function, params, system), ()
    if policy is Policy.USERDATA:
        keys = []
        for field, value in activity.arguments:
            if isinstance(value, VariableRef):
                keys.append((field, value.name))
            elif constant(value, params) not in ("", 0, False):
                # A field that is not set keeps its default; any other constant needs code.
                return policy, None, ()
        return policy, tuple(field for field, _ in keys), tuple(keys)
    return policy, (), ()


def _fixed(
    activity: Activity, function: Function, params: Mapping[str, Param], system: System
) -> tuple[str, ...] | None:
    """Return all fields of the goal, in the order of the message's constructor."""
    described = system.interface(function.communication.type)
    # The generator creates a request of the wrong class from constants.
    if not isinstance(described, Action):
        return None
    given = dict(activity.arguments)
    values = []
    for field in described.goal:
        text = _field_value(field, given.get(field.name), params)
        if text is None:
            return None
        values.append(text)
    return tuple(values)


def _field_value(field: Field, value: Expression | None, params: Mapping[str, Param]) -> str | None:
    if value is None:
        return _default(field)
    text = repr(constant(value, params))
    return f"rospy.Duration({text})" if value.type == DURATION else text


def _default(field: Field) -> str | None:
    if not isinstance(field.type, Primitive) or field.type.name in ("time", "duration"):
        return None
    return {"string": "''", "bool": "False"}.get(field.type.name, "0")


def _has_conflict(goal: tuple[tuple[str, str], ...], results: tuple[tuple[str, str], ...]) -> bool:
    """Return True if a field would have to be stored in two places."""
    kept = dict(goal)
    return any(kept.get(field, key) != key for field, key in results)


def _python(value: Expression, params: Mapping[str, Param]) -> str:
    """Return a value in a goal callback; a param is replaced by its default."""
    known = constant(value, params)
    if known is not None:
        return repr(known)
    return translate(
        value,
        Dialect(
            literal=python_literal,
            variable=lambda name: f"userdata.{name}",
            param=lambda name: f"rospy.get_param('~{name}')",
            event="event",
            envelope=envelope_name,
            identity="self.{}".format,
            operators={},
            functions={},
        ),
    )
