"""Third-party interfaces with valid names of ROS 2."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

from swarmdsl.codegen import replace
from swarmdsl.ir import Action, Array, Field, Interface, Message, Named, Service, Type

from .names import field_name, type_name

T = TypeVar("T", bound=Type)


def ported(interface: Interface) -> Interface:
    """Return an interface with valid names of ROS 2, if it is third-party."""
    if not interface.external:
        return interface
    interface = replace(interface, type=ported_type(interface.type))
    match interface:
        case Message(fields=fields):
            return replace(interface, fields=_ported(fields))
        case Service(request=request, response=response):
            return replace(interface, request=_ported(request), response=_ported(response))
        case Action(goal=goal, result=result, feedback=feedback):
            return replace(
                interface, goal=_ported(goal), result=_ported(result), feedback=_ported(feedback)
            )


def ported_type(type_: T) -> T:
    """Return a type with a valid name of ROS 2."""
    match type_:
        case Named(package=package, name=name):
            return replace(type_, package=package, name=type_name(name))
        case Array(element=element):
            return replace(type_, element=ported_type(element))
    return type_


def _ported(fields: Iterable[Field]) -> tuple[Field, ...]:
    return tuple(
        replace(field, name=field_name(field.name), type=ported_type(field.type))
        for field in fields
    )
