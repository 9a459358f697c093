"""Messages and results for a machine: small, and near to what its guards compare with."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any

from swarmdsl import ir
from swarmdsl.codegen.shared.default_values import default_value
from swarmdsl.ir import Action, Array, EventData, FieldAccess, Literal, Primitive, Service, System
from swarmdsl.syntax.types import DURATION, INT


class Values:
    """Draws values of one machine."""

    def __init__(self, machine: ir.StateMachine, system: System) -> None:
        self.machine = machine
        self.system = system
        self.dice = random.Random(0)
        nodes = [*_nodes(machine.states)]
        self.asks = any(isinstance(node, ir.EnvelopeField) for node in nodes)
        """True if the machine asks who sent an event, or when."""
        literals = [node.value for node in nodes if isinstance(node, Literal)]
        numbers = [v for v in literals if isinstance(v, (int, float)) and abs(v) < 1e6]
        self.whole = sorted({int(v) + near for v in numbers for near in (-1, 0, 1)} | set(range(8)))
        self.real = sorted({v + near for v in numbers for near in (-0.125, 0, 0.125)} | {0, 5.5})
        self.texts = sorted({v for v in literals if isinstance(v, str)} | {"", "a", "b"})
        self.asked = {path: node.type for node in nodes if (path := _path(node))}
        """The fields of messages that are looked at, which an interface may not tell."""
        self.needed: dict[tuple[str, ...], list[Any]] = {}
        """Values that such fields have to equal somewhere."""
        for node in nodes:
            match node:
                case ir.Binary(operator="==", left=left, right=Literal(value=value)):
                    if path := _path(left):
                        self.needed.setdefault(path, []).append(value)

    def value(self, type_: ir.Type) -> Any:
        """A value of a type."""
        match type_:
            case Primitive(name="bool"):
                return self.dice.random() < 0.5
            case Primitive(name="string" | "wstring"):
                return self.dice.choice(self.texts)
            case Primitive(name="float32" | "float64"):
                return self.dice.choice(self.real)
            case Primitive() if type_ == DURATION:
                return self.dice.choice([250, 1_500, 4_000]) * 1_000_000
            case Primitive(name=name):
                low = 0 if name.startswith("u") else -10
                return self.dice.choice([n for n in self.whole if n >= low])
            case Array(element=element, size=None):
                return [self.value(element) for _ in range(self.dice.randrange(3))]
            case Array():
                return default_value(type_, self.system)
        known = self.system.interface(type_)
        inner = known.fields if isinstance(known, ir.Message) else ()
        return {each.name: self.value(each.type) for each in inner}

    def message(self, event: ir.Event) -> dict[str, Any]:
        """A message that comes with an event."""
        message: dict[str, Any] = self.value(event.type)
        for path, type_ in self.asked.items():
            _inside(message, path).setdefault(path[-1], self.value(type_))
        for path, literals in self.needed.items():
            if self.dice.random() < 0.5:
                _inside(message, path)[path[-1]] = self.dice.choice(literals)
        return message

    def result(self, activity: ir.Activity) -> dict[str, Any]:
        """Return a result of an activity, with every field that the machine stores."""
        known = self.system.interface(self.system.function(activity.function).communication.type)
        inner: tuple[ir.Field, ...] = ()
        if isinstance(known, Action):
            inner = known.result
        elif isinstance(known, Service):
            inner = known.response
        types = {variable.name: variable.type for variable in self.machine.variables}
        result = {
            each.field: self.value(INT if each.path else types[each.variable])
            for each in activity.results
        }
        return {**result, **{each.name: self.value(each.type) for each in inner}}


def _nodes(node: Any) -> Iterator[Any]:
    """A node of the IR and all in it."""
    if isinstance(node, tuple):
        for each in node:
            yield from _nodes(each)
    elif is_dataclass(node):
        yield node
        for field in fields(node):
            if field.name != "origin":
                yield from _nodes(getattr(node, field.name))


def _path(node: Any) -> tuple[str, ...]:
    """The field of the message that an expression is; no field for others."""
    path: tuple[str, ...] = ()
    while isinstance(node, FieldAccess):
        path = (node.field, *path)
        node = node.base
    return path if isinstance(node, EventData) else ()


def _inside(message: dict[str, Any], path: tuple[str, ...]) -> dict[str, Any]:
    """The part of a message that has the last field of a path."""
    for field in path[:-1]:
        message = message.setdefault(field, {})
    return message
