"""Names in the style of the field: `LikeThis`, `like_this` and `LIKE_THIS`."""

from __future__ import annotations

import re

from swarmdsl.naming import camel_case, snake_case
from swarmdsl.scopes import bare, kind_of
from swarmdsl.syntax import (
    Choice,
    Component,
    Constant,
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
    Region,
    Role,
    State,
    StateMachine,
    StructType,
    Swarm,
    Variable,
    walk,
)
from swarmdsl.validate.context import Context
from swarmdsl.validate.names import RESERVED_EVENTS

_CAMEL = re.compile(r"[A-Z][A-Za-z0-9]*")
_SNAKE = re.compile(r"[a-z][a-z0-9_]*")
_UPPER = re.compile(r"[A-Z][A-Z0-9_]*")

_Camel = (
    *(StructType, EnumType, Event, Component, Member, StateMachine, Swarm, Environment, Fitness),
    *(State, Parallel, Region, Choice, History, FinalState),
)
_Snake = (Function, Operation, Parameter, Param, Variable, Part, Port, Role)
_Upper = (Constant, EnumValue)


def check_style(declaration: Declaration, context: Context) -> None:
    """Check the style of all names in a declaration but those that ROS or others have given."""
    for node in walk(declaration):
        if isinstance(node, _Camel):
            style, written, better = _CAMEL, "CamelCase", camel_case
        elif isinstance(node, _Snake):
            style, written, better = _SNAKE, "snake_case", snake_case
        elif isinstance(node, _Upper):
            style, written, better = _UPPER, "UPPER_CASE", _upper_case
        else:
            continue
        reserved = isinstance(node, Event) and node.name in RESERVED_EVENTS
        if not style.fullmatch(node.name) and not reserved:
            context.report.report(
                "naming-style",
                node.name.span,
                kind=bare(kind_of(node)),
                name=node.name,
                style=written,
                help=f"write `{better(node.name)}`",
            )


def _upper_case(name: str) -> str:
    return snake_case(name).upper()
