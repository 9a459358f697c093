"""Changes of single fields of the intermediate representation and of syntax trees."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator
from enum import Enum
from typing import Any

from swarmdsl.base.records import replace
from swarmdsl.base.source import Span
from swarmdsl.ir import Literal, System


def fields(node: Any) -> Iterator[str]:
    """Names of the fields that count when nodes are compared."""
    yield from (each.name for each in dataclasses.fields(node) if each.compare)


def is_node(value: Any) -> bool:
    return dataclasses.is_dataclass(value) and not isinstance(value, (type, Span))


Rebuild = Callable[[Any], Any]


def walk(node: Any, rebuild: Rebuild) -> Iterator[tuple[Any, Rebuild]]:
    """Yield each node below `node` with a function that puts another in its place."""
    yield node, rebuild
    for name in fields(node):
        value = getattr(node, name)
        outer: Rebuild = lambda new, name=name: rebuild(replace(node, **{name: new}))  # noqa: E731
        yield from _walk_value(value, outer)


def _walk_value(value: Any, rebuild: Rebuild) -> Iterator[tuple[Any, Rebuild]]:
    if is_node(value):
        yield from walk(value, rebuild)
    elif isinstance(value, tuple):
        for number, part in enumerate(value):
            yield from _walk_value(
                part,
                lambda new, number=number: rebuild((*value[:number], new, *value[number + 1 :])),
            )


def systems(system: System) -> Iterator[tuple[str, str, Callable[[], System]]]:
    """Yield each field as `Class.field`, the kind of its node, and a function that changes it."""
    for node, rebuild in walk(system, lambda new: new):
        for name in fields(node):
            for value in other_values(getattr(node, name)):
                yield (
                    f"{type(node).__name__}.{name}",
                    str(getattr(node, "kind", "")),
                    lambda node=node, name=name, value=value, rebuild=rebuild: rebuild(
                        replace(node, **{name: value})
                    ),
                )


def other_values(value: Any) -> Iterator[Any]:
    """Values of the same type that differ from `value`."""
    match value:
        case bool():
            yield not value
        case Enum():
            yield from (each for each in type(value) if each is not value)
        case int() | float():
            yield value + 1
        case str():
            # One that names something else of the model may be the only valid one.
            yield f"{value}x"
        case tuple() if value:
            yield value[:-1]
        case Literal():
            yield replace(value, value=next(other_values(value.value)))
        case None | ():
            return
        case _ if is_node(value):
            # A part that may be absent; its own fields are changed one by one.
            yield None
