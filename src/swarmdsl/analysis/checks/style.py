"""Checks of the style of names: `LikeThis`, `like_this` and `LIKE_THIS`."""

from __future__ import annotations

from collections.abc import Callable

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.names import RESERVED_EVENTS
from swarmdsl.analysis.node_kinds import kind_name
from swarmdsl.analysis.resolve.membership import MEMBER_EVENTS
from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.naming import camel_case, snake_case
from swarmdsl.syntax.ast import (
    AliasType,
    Choice,
    Component,
    Constant,
    Contract,
    Declaration,
    EnumType,
    EnumValue,
    Environment,
    Event,
    FinalState,
    Fitness,
    Function,
    History,
    Member,
    Operation,
    Parallel,
    Param,
    Parameter,
    Part,
    Port,
    Property,
    Region,
    Role,
    State,
    StateMachine,
    StructType,
    Swarm,
    Variable,
    by_class,
)


def _upper_case(name: str) -> str:
    return snake_case(name).upper()


# Names have letters, digits and `_`, all ASCII.


def _is_camel_case(name: str) -> bool:
    return name[:1].isupper() and "_" not in name


def _is_snake_case(name: str) -> bool:
    return name[:1].islower() and name.islower()


def _is_upper_case(name: str) -> bool:
    return name[:1].isupper() and name.isupper()


# A predicate, the name of the style, and the conversion of other names.
_Style = tuple[Callable[[str], bool], str, Callable[[str], str]]
_CAMEL: _Style = _is_camel_case, "CamelCase", camel_case
_SNAKE: _Style = _is_snake_case, "snake_case", snake_case
_UPPER: _Style = _is_upper_case, "UPPER_CASE", _upper_case

_STYLES = {
    **dict.fromkeys((StructType, EnumType, AliasType, Event, Component), _CAMEL),
    **dict.fromkeys(
        (Contract, Member, StateMachine, Swarm, Environment, Fitness, Property), _CAMEL
    ),
    **dict.fromkeys((State, Parallel, Region, Choice, History, FinalState), _CAMEL),
    **dict.fromkeys((Function, Operation, Parameter, Param, Variable, Part, Port, Role), _SNAKE),
    **dict.fromkeys((Constant, EnumValue), _UPPER),
}


def check_style(declaration: Declaration, context: Context) -> None:
    """Check the style of all names in a declaration except those of ROS and other tools."""
    for kind, nodes in by_class(declaration).items():
        if kind not in _STYLES:
            continue
        is_so, written, better = _STYLES[kind]
        for node in nodes:
            name = node.name
            reserved = kind is Event and name in (*RESERVED_EVENTS, *MEMBER_EVENTS)
            if not is_so(name) and not reserved:
                context.report.report(
                    "naming-style",
                    name.span,
                    kind=kind_name(node),
                    name=name,
                    style=written,
                    help=Advice(f"write `{better(name)}`", "rename everywhere", better(name)),
                )
