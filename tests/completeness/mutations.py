"""Changes of single fields of the intermediate representation and of syntax trees."""

from __future__ import annotations

import dataclasses
from collections import defaultdict
from collections.abc import Callable, Iterator, Set
from enum import Enum
from typing import Any

from swarmdsl.base.records import replace
from swarmdsl.base.source import Span
from swarmdsl.ir import Literal, System, Transition


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
    used = values_in_use(system)
    for node, rebuild in walk(system, lambda new: new):
        for name in fields(node):
            for value in other_values(getattr(node, name), used[type(node), name]):
                yield (
                    f"{type(node).__name__}.{name}",
                    kind_of(node),
                    lambda node=node, name=name, value=value, rebuild=rebuild: rebuild(
                        replace(node, **{name: value})
                    ),
                )


def kind_of(node: Any) -> str:
    """Kind of a node; a change of a field may show in some kinds only."""
    match node:
        case Literal(type=type_):
            return str(type_)
        case Transition(target=target, internal=internal):
            return f"{'stays' if target is None else 'leads away'} {internal}"
    return str(getattr(node, "kind", ""))


def values_in_use(system: System) -> dict[tuple[type, str], set[str]]:
    """The values that each field of strings has in a system: a reference needs one that exists."""
    used: dict[tuple[type, str], set[str]] = defaultdict(set)
    for node, _ in walk(system, lambda new: new):
        for name in fields(node):
            if name != "doc" and isinstance(value := getattr(node, name), str):
                used[type(node), name].add(value)
    return used


def other_values(value: Any, used: Set[str] = frozenset()) -> Iterator[Any]:
    """Values of the same type that differ from `value`."""
    match value:
        case bool():
            yield not value
        case Enum():
            yield from (each for each in type(value) if each is not value)
        case int() | float():
            yield value + 1
        case str():
            yield f"{value}x"
            yield from sorted(used - {value})[:3]
        case tuple() if value:
            yield value[:-1]
        case Literal():
            yield replace(value, value=next(other_values(value.value)))
        case None | ():
            return
        case _ if is_node(value):
            # A part that may be absent; its own fields are changed one by one.
            yield None
