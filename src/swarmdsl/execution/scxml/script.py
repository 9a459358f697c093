"""The element `<script>`: assignments only, compiled to effects and never run as code."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache
from typing import Any

from lark import Token, Tree

from swarmdsl.execution.engine import Effect, Event, InstanceLike
from swarmdsl.execution.scxml.ecmascript import Value, assignment, compiled
from swarmdsl.execution.scxml.grammar import Unreadable, parse_script
from swarmdsl.execution.scxml.operations import OPERATIONS


@lru_cache(maxsize=1000)
def script(written: str) -> Effect:
    """Compile a script. Raises Unreadable."""
    effects = [each for tree in _statements(parse_script(written)) for each in _effects(tree)]

    def run(instance: InstanceLike, event: Event) -> None:
        for each in effects:
            each(instance, event)

    return run


def _statements(tree: Tree[Token]) -> Iterator[Tree[Token]]:
    """Yield the statements; each ends with a semicolon, a line or the script."""
    line: int | None = None
    for each in tree.children:
        if isinstance(each, Token):
            line = None
            continue
        tokens = [*each.scan_values(lambda found: isinstance(found, Token))]
        if tokens[0].line == line:
            raise Unreadable(f"`{tokens[0]}` cannot stand here")
        line = tokens[-1].line
        yield each


def _effects(tree: Any) -> Iterator[Effect]:
    if tree.data in ("before", "after"):
        yield _evaluation(compiled(tree))
    elif tree.data == "assignment":
        target, sign, given = tree.children
        if target.data not in ("name", "member", "item"):
            raise Unreadable(f"`{sign}` needs a variable")
        value = compiled(given)
        if sign != "=":
            value = _operation(OPERATIONS[str(sign[:-1])], compiled(target), value)
        yield _storing(assignment(target, str(sign), declares=True), value)
    else:
        for variable in tree.children:
            name, *initial = variable.children
            if initial:
                store = assignment(Tree("name", [name]), str(name), declares=True)
                yield _storing(store, compiled(initial[0]))
            else:
                yield _declaration(str(name))


def _evaluation(value: Value) -> Effect:
    return lambda instance, event: value(instance, event, {})


def _operation(operation: Callable[[Any, Any], Any], left: Value, right: Value) -> Value:
    return lambda instance, event, names: operation(
        left(instance, event, names), right(instance, event, names)
    )


def _storing(store: Callable[[InstanceLike, Event, Any], None], value: Value) -> Effect:
    return lambda instance, event: store(instance, event, value(instance, event, {}))


def _declaration(name: str) -> Effect:
    return lambda instance, event: instance.data.setdefault(name, None)
