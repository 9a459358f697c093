"""Places of data that decide what some machines do.

Demands flow backwards, from guards over copies to where the data come from: a program slice
(M. Weiser, 1981).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from swarmdsl import ir
from swarmdsl.codegen.shared.default_values import (
    field_type,
    sent_types,
)
from swarmdsl.execution.engine import ExecutionError
from swarmdsl.execution.simulate.machines.expressions import function_of
from swarmdsl.execution.verify.abstraction.places import (
    Node,
    behind,
    is_constant,
    parts,
    places,
    places_in,
)
from swarmdsl.execution.verify.abstraction.representatives import Cut
from swarmdsl.ir.integer_ranges import bound_of

_COMPARISONS = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "==": "==", "!=": "!="}
"""Comparisons, each with the one that has its sides exchanged."""
_SURE = {
    *_COMPARISONS,
    *("and", "or", "+", "-", "*", "min", "max", "abs", "clamp", "hypot", "distance", "atan2"),
    *("len", "contains", "empty", "float", "seconds"),
}
"""Operations that have a value for all operands; of integers, it may be out of range."""


class Slice:
    """Places of data that decide on the behaviour of some machines.

    `data` are the first data of the instances of each machine, by its name. `extra` are the
    conditions of properties, each with the machine and the events that it is about. With `lengths`,
    those of delays count, else only if they are positive.
    """

    def __init__(
        self,
        system: ir.System,
        data: Mapping[str, Sequence[Mapping[str, Any]]],
        extra: Iterable[tuple[str, ir.Expression, tuple[str, ...]]] = (),
        *,
        lengths: bool = False,
    ) -> None:
        self._system = system
        self._has_lengths = lengths
        self._data = data
        self._flows: list[tuple[Node, Node]] = []
        self.cuts: dict[Node, set[Cut]] = {}
        """Places that are compared with constants."""
        self.exact: dict[Node, ir.Expression] = {}
        """Places whose very values count, with the expressions that use them."""
        self._computed: list[tuple[Node, ir.Expression, str, tuple[str, ...]]] = []
        self.is_addressed = False
        """True if a machine computes an address."""
        self.read: dict[Node, ir.Expression] = {}
        """Places of data with the first expressions that compare or need them."""
        for name in data:
            self._machine(system.machines_by_name[name])
        for name, expression, events in extra:
            self._decide(expression, name, events)
        for event in system.events:
            for here in system.events:
                if here.incoming_topic == event.topic and here is not event:
                    self._flows.append((("event", here.name, ()), ("event", event.name, ())))
        self._spread()

    @property
    def demanded(self) -> set[Node]:
        """Places that decide on anything."""
        return {*self.cuts, *self.exact}

    @property
    def growing(self) -> set[str]:
        """Variables that are computed from themselves, perhaps by way of others or messages."""
        sources: dict[tuple[str, str], set[tuple[str, str]]] = {}
        for target, source in self._flows:
            sources.setdefault(target[:2], set()).add(source[:2])
        computed = []
        for target, expression, machine, events in self._computed:
            if places(expression, machine, events) is None:
                read = {node[:2] for node in places_in(expression, machine, events)}
                sources.setdefault(target[:2], set()).update(read)
                computed.append((target[:2], read))
        return {
            target[1]
            for target, read in computed
            if target[0] == "var" and target in _reached(read, sources)
        }

    def reached_from(self, sources: Iterable[Node]) -> set[Node]:
        """Return some places, and all that hold what is copied or computed from them."""
        found = set(sources)
        todo = list(found)
        while todo:
            node = todo.pop()
            new = {behind(node, source, target) for target, source in self._flows}
            new |= {
                target
                for target, expression, machine, events in self._computed
                for read in places_in(expression, machine, events)
                if behind(node, read, read) is not None
            }
            fresh = {each for each in new if each is not None} - found
            found |= fresh
            todo += fresh
        return found

    # ---- internal

    def _spread(self) -> None:
        """Carry demands from where data are used to where they come from."""
        changed = True
        while changed:
            changed = False
            for target, source in self._flows:
                for node in sorted(self.demanded):
                    origin = behind(node, target, source)
                    if origin is None:
                        continue
                    if node in self.cuts:
                        cuts = self.cuts.setdefault(origin, set())
                        changed |= not self.cuts[node] <= cuts
                        cuts |= self.cuts[node]
                    if node in self.exact and origin not in self.exact:
                        self.exact[origin] = self.exact[node]
                        changed = True
            for target, expression, machine, events in self._computed:
                if any(behind(node, target, target) is not None for node in self.demanded):
                    before = len(self.exact)
                    self._need(expression, machine, events)
                    changed |= len(self.exact) != before

    def _machine(self, machine: ir.StateMachine) -> None:
        name = machine.name
        handled = tuple(
            dict.fromkeys(
                each.event
                for state in machine.walk()
                for transition in state.transitions
                for each in transition.triggers
                if isinstance(each, ir.EventTrigger)
            )
        )
        types = {each.name: each.type for each in machine.variables}
        for state in machine.walk():
            self._effects((*state.entry, *state.exit), name, handled, types)
            if state.activity is not None:
                call = self._system.function(state.activity.function).communication
                asked = sent_types(self._system.known_interface(call.type))
                for field, value in state.activity.arguments:
                    goal = ("goal", state.activity.function, (field,))
                    self._flow(goal, value, asked.get(field), name, handled, is_needed=True)
                for result in state.activity.results:
                    source = ("result", state.activity.function, (result.field,))
                    target = ("var", f"{name}.{result.variable}", result.path)
                    self._flows.append((target, source))
            for transition in state.transitions:
                events = tuple(
                    each.event for each in transition.triggers if isinstance(each, ir.EventTrigger)
                )
                for trigger in transition.triggers:
                    if isinstance(trigger, ir.TimeTrigger):
                        self._delay(trigger.delay, name, ())
                if transition.guard is not None:
                    self._decide(transition.guard, name, events or handled)
                self._effects(transition.effects, name, events or handled, types)

    def _effects(
        self,
        effects: Iterable[ir.Effect],
        machine: str,
        events: tuple[str, ...],
        types: Mapping[str, ir.Type],
    ) -> None:
        block = list(effects)
        for effect in block:
            match effect:
                case ir.Assignment(variable=variable, path=path, value=value):
                    held = field_type(types.get(variable), path, self._system)
                    target = ("var", f"{machine}.{variable}", path)
                    is_needed = effect is not block[-1]
                    self._flow(target, value, held, machine, events, is_needed=is_needed)
                case ir.Send(event=event, arguments=arguments, to=to, delay=delay):
                    type_ = self._system.event(event).type
                    for field, value in arguments:
                        held = field_type(type_, (field,), self._system)
                        target = ("event", event, (field,))
                        self._flow(target, value, held, machine, events, is_needed=True)
                    if to is not None:
                        self._address(to, machine, events)
                    if delay is not None:
                        self._delay(delay, machine, events)

    def _flow(
        self,
        target: Node,
        value: ir.Expression,
        held: ir.Type | None,
        machine: str,
        events: tuple[str, ...],
        *,
        is_needed: bool,
    ) -> None:
        """Note that a value is stored in a place.

        If it `is_needed` for what follows, it counts whether the expression has a value.
        """
        if isinstance(value, ir.Construction):
            for field, part in value.values:
                inner = field_type(value.type, (field,), self._system)
                place = (*target[:2], (*target[2], field))
                self._flow(place, part, inner, machine, events, is_needed=is_needed)
            return
        nodes = places(value, machine, events)
        if nodes is not None:
            self._flows += [(target, node) for node in nodes]
            for node in nodes:
                self.read.setdefault(node, value)
        elif not is_constant(value):
            self._computed.append((target, value, machine, events))
        if nodes is not None and bound_of(value, held) is not None:
            self._computed.append((target, value, machine, events))
        if is_needed and can_fail(value, held) and not is_constant(value):
            self._need(value, machine, events)

    def _address(self, to: ir.Address, machine: str, events: tuple[str, ...]) -> None:
        for value in to.values:
            if not isinstance(value, ir.Literal):
                self.is_addressed = True
                self._need(value, machine, events)

    def _delay(self, delay: ir.Expression, machine: str, events: tuple[str, ...]) -> None:
        """Demand the length of a delay, or if it is positive or not."""
        nodes = places(delay, machine, events)
        if nodes is not None and not self._has_lengths:
            for node in nodes:
                self.cuts.setdefault(node, set()).add((">", 0))
        elif not is_constant(delay):
            self._need(delay, machine, events)

    def _decide(self, expression: ir.Expression, machine: str, events: tuple[str, ...]) -> None:
        """Demand what the truth of a condition depends on."""
        nodes = places(expression, machine, events)
        if nodes is not None:
            for node in nodes:
                self.cuts.setdefault(node, set()).add(("==", True))
            return
        match expression:
            case ir.Unary(operator="not", operand=operand):
                self._decide(operand, machine, events)
            case ir.Binary(operator="and" | "or", left=left, right=right):
                self._decide(left, machine, events)
                self._decide(right, machine, events)
            case ir.Binary(operator=symbol, left=left, right=right) if symbol in _COMPARISONS:
                if not (
                    self._compare(symbol, left, right, machine, events)
                    or self._compare(_COMPARISONS[symbol], right, left, machine, events)
                ):
                    self._need(expression, machine, events)
            case _:
                self._need(expression, machine, events)

    def _compare(
        self,
        symbol: str,
        place: ir.Expression,
        constant: ir.Expression,
        machine: str,
        events: tuple[str, ...],
    ) -> bool:
        """Note the comparison of a place with a constant; return False if it is none."""
        nodes = places(place, machine, events)
        for node in nodes or ():
            self.read.setdefault(node, place)
        if nodes is None or not is_constant(constant):
            return False
        value = function_of(constant)
        try:
            values = {value(data, None) for data in self._data[machine]}
        except (ArithmeticError, ValueError, ExecutionError, TypeError):
            return False
        for node in nodes:
            self.cuts.setdefault(node, set()).update((symbol, each) for each in values)
        return True

    def _need(self, expression: ir.Expression, machine: str, events: tuple[str, ...]) -> None:
        """Demand the very values that an expression reads."""
        nodes = places(expression, machine, events)
        if nodes is not None:
            for node in nodes:
                self.exact.setdefault(node, expression)
                self.read.setdefault(node, expression)
            return
        for part in parts(expression):
            self._need(part, machine, events)


def can_fail(expression: ir.Expression, held: ir.Type | None) -> bool:
    """Return True if an expression may have no value that can be stored as a type."""
    return bound_of(expression, held) is not None or any(
        _is_unsure(part) for part in ir.subexpressions(expression)
    )


def _is_unsure(part: ir.Expression) -> bool:
    match part:
        case ir.Binary(operator=name) | ir.Call(function=name):
            return name not in _SURE
        case ir.Query(function=name):
            return name in ("min", "max")
    return False


def _reached(
    first: Iterable[tuple[str, str]],
    following: Mapping[tuple[str, str], Iterable[tuple[str, str]]],
) -> set[tuple[str, str]]:
    """Return what can be reached from some places."""
    found = set(first)
    todo = list(found)
    while todo:
        new = set(following.get(todo.pop(), ())) - found
        found |= new
        todo += new
    return found
