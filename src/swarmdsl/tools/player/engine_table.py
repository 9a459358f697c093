"""Tables of state machines as JSON, for the engine in the page.

They are those of the Python engine: the same converter makes them, with effects as lists of words
instead of functions.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from swarmdsl import ir
from swarmdsl.codegen.shared.default_values import default_value, field_type
from swarmdsl.execution.engine import (
    Activity,
    Effect,
    Event,
    Guard,
    InstanceLike,
    Machine,
    Transition,
)
from swarmdsl.execution.engine.table import Edge
from swarmdsl.execution.simulate.machines.table import TableMaker
from swarmdsl.ir import Assignment, Cancel, Expression, Send, System
from swarmdsl.tools.player.engine_values import Tree, encoded, stored_tree, tree_of


class Written:
    """Guard, effect or goal that is written as a tree, and is never called."""

    def __init__(self, tree: Any) -> None:
        self.tree = tree

    def __call__(self, instance: InstanceLike, event: Event | None = None) -> Any:
        """Refuse to run: the engine in the page does."""
        raise AssertionError("a table for the page runs in the page")


def written_machine(machine: ir.StateMachine, system: System) -> dict[str, Any]:
    """Return the table of a machine as JSON."""
    maker = _Maker(machine, system)
    states = [maker.state(state) for state in machine.states]
    return written_table(Machine(machine.name, states, (machine.initial,)))


def written_table(machine: Machine) -> dict[str, Any]:
    """Return a table as JSON; its guards and effects have a `tree`."""
    return {
        "name": machine.name,
        "limit": machine.limit,
        "most": machine.most_deferred,
        "states": [_state(machine, number) for number in range(len(machine.states))],
    }


def _state(machine: Machine, number: int) -> dict[str, Any]:
    state, entry = machine.states[number], machine.entries[number]
    found: dict[str, Any] = {
        "id": state.id,
        "kind": state.kind.value,
        "parent": machine.parents[number],
        "edges": [_edge(each, machine.called(each.table)) for each in machine.edges[number]],
        "first": _edge(entry, "") if entry is not None else None,
        "entry": [_tree(each) for each in state.entry],
        "exit": [_tree(each) for each in state.exit],
        "deferred": state.deferred,
        "timed": state.timed,
        "activity": _activity(state.activity) if state.activity is not None else None,
    }
    return _brief(found)


def _edge(edge: Edge, called: str) -> dict[str, Any]:
    table: Transition = edge.table
    found = {
        "source": edge.source,
        "guard": _tree(table.guard),
        "effect": _tree(table.effect),
        "internal": table.internal,
        "called": called,
    }
    return {"events": table.events, "targets": edge.targets, **_brief(found)}


def _brief(found: dict[str, Any]) -> dict[str, Any]:
    """Leave out what is empty, such as the number of the machine as a parent."""
    return {key: value for key, value in found.items() if value}


def _activity(activity: Activity) -> dict[str, Any]:
    return {
        "name": activity.name,
        "server": activity.server,
        "events": dict(activity.events),
        "goal": _tree(activity.goal),
        "finalize": _tree(activity.finalize),
        "refused": activity.refused,
    }


def _tree(written: object) -> Any:
    return getattr(written, "tree", None)


class _Maker(TableMaker):
    """Converter of the states of a machine, with trees instead of functions."""

    def guard(self, expression: Expression | None) -> Guard | None:
        """Convert a guard."""
        return Written(tree_of(expression)) if expression is not None else None

    def effects(self, effects: Iterable[ir.Effect]) -> Effect:
        """Return the effects as one, which stops at the first error."""
        return Written(["all", *(self._written(each) for each in effects)])

    def _written(self, effect: ir.Effect) -> Tree:
        match effect:
            case Assignment(variable=variable, path=path, value=value):
                tree = stored_tree(value, self.held(effect), self.system)
                return ["set", variable, list(path), tree]
            case Cancel(event=name):
                return ["cancel", f"send.{name}"]
            case Send(event=name, arguments=arguments, to=to, delay=delay):
                type_ = self.system.event(name).type
                fields = [
                    [
                        field,
                        stored_tree(value, field_type(type_, (field,), self.system), self.system),
                    ]
                    for field, value in arguments
                ]
                blank = encoded(default_value(type_, self.system))
                wait = tree_of(delay) if delay is not None else None
                return ["send", name, blank, fields, _address(to) if to else None, wait]

    def goal(self, activity: ir.Activity) -> Callable[[InstanceLike], Any]:
        """Return what makes the goal of an activity."""
        sent = self.sent_types(activity)
        return Written(
            [
                [name, stored_tree(value, sent.get(name), self.system)]
                for name, value in activity.arguments
            ]
        )

    def results(self, results: Iterable[ir.ResultMapping]) -> Effect:
        """Return the effect that stores the results of an activity."""
        return Written(
            ["results", *([r.field, self.bound(r), r.variable, list(r.path)] for r in results)]
        )

    def raising(self, name: str) -> Effect:
        """Return the effect that raises an event of the machine itself."""
        return Written(["raise", name])

    def starting(self, timers: Mapping[str, Expression]) -> Effect:
        """Return the effect that starts the delays of a state."""
        return Written(["start", *([name, tree_of(delay)] for name, delay in timers.items())])

    def stopping(self, names: Iterable[str]) -> Effect:
        """Return the effect that cancels the delays of a state."""
        return Written(["stop", *names])


def _address(address: ir.Address) -> Tree:
    """Return an address: a value, or a role with the number of a robot in it."""
    if address.id is not None:
        return ["id", tree_of(address.id)]
    return ["role", address.role, tree_of(address.index) if address.index is not None else None]
