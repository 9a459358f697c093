"""State machines whose data are left open: guards on them may hold or not, each time.

That allows more than data do. So what holds without them, holds.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

from swarmdsl import ir
from swarmdsl.base.records import replace
from swarmdsl.codegen.shared.default_values import field_type
from swarmdsl.execution.engine import (
    Effect,
    Event,
    ExecutionError,
    Guard,
    InstanceLike,
    Machine,
)
from swarmdsl.execution.simulate.actors import Actor
from swarmdsl.execution.simulate.machine_data import first_data
from swarmdsl.execution.simulate.table import TableMaker
from swarmdsl.execution.verify.casts import delays_of, sends
from swarmdsl.execution.verify.nearness import EITHER
from swarmdsl.execution.verify.places import is_constant, parts
from swarmdsl.execution.verify.slice import can_fail
from swarmdsl.execution.verify.terms import facts_of

_NOBODY = "?"
"""Address that stands for a computed one: what others hear is left open, too."""


def loosened(cast: Sequence[Actor], system: ir.System) -> list[Actor]:
    """Return machines without data."""
    return [
        replace(each, machine=_table(system.machines_by_name[each.machine.name], system))
        for each in cast
    ]


def can_be_loose(property_: ir.Property, machines: Sequence[ir.StateMachine]) -> bool:
    """Return True if a property may be decided without the data of the machines.

    It must not be about them, nor about what the machines send, and no delay may depend on them.
    """
    own = {each.event for each in sends(machines)}
    for fact in facts_of(property_):
        if not isinstance(fact, ir.Fact) or fact.guard is None:
            continue
        if ir.reads_values(fact.guard) or fact.name in ("", *own):
            return False
    return all(map(is_constant, delays_of(machines)))


def _table(machine: ir.StateMachine, system: ir.System) -> Machine:
    maker = _Loose(machine, system)
    return Machine(
        machine.name,
        [maker.state(state) for state in machine.states],
        (machine.initial,),
        data=lambda: first_data(machine, system, {}),
    )


class _Loose(TableMaker):
    """Converter of the states of a machine, without what reads and writes variables."""

    def guard(self, expression: ir.Expression | None) -> Guard | None:
        """Convert a guard; what depends on data is a free choice."""
        if expression is None or _is_known(expression):
            return super().guard(expression)
        if can_fail(expression, None):
            return _either
        match expression:
            case ir.Unary(operator="not", operand=operand):
                inner = self.guard(operand)
                assert inner is not None
                return lambda instance, event: not inner(instance, event)
            case ir.Binary(operator="and" | "or" as operator, left=left, right=right):
                first, second = self.guard(left), self.guard(right)
                assert first is not None
                assert second is not None
                if operator == "and":
                    return lambda i, event: first(i, event) and second(i, event)
                return lambda i, event: first(i, event) or second(i, event)
        return _either

    def effects(self, effects: Iterable[ir.Effect]) -> Effect:
        """Return the effects without those on variables; each may fail if it can."""
        made = [step for each in effects for step in self._steps(each)]

        def all_of_them(instance: InstanceLike, event: Event) -> None:
            for each in made:
                each(instance, event)

        while made and made[-1] is _perhaps_fail:
            # Nothing follows that a failure would leave out.
            made.pop()
        return all_of_them

    def goal(self, activity: ir.Activity) -> Callable[[InstanceLike], Any]:
        """Return the function that makes an empty goal, or fails if the goal can."""
        sent = self.sent_types(activity)
        may_fail = any(can_fail(value, sent.get(name)) for name, value in activity.arguments)

        def make_goal(instance: InstanceLike) -> dict[str, Any]:
            if may_fail:
                _perhaps_fail(instance, None)
            return {}

        return make_goal

    def results(self, results: Iterable[ir.ResultMapping]) -> Effect:
        """Return the effect that stores no results."""
        del results
        return lambda instance, event: None

    def _steps(self, effect: ir.Effect) -> Iterator[Effect]:
        match effect:
            case ir.Assignment(value=value):
                if can_fail(value, self.held(effect)):
                    yield _perhaps_fail
            case ir.Send(event=name, arguments=arguments, to=to):
                type_ = self.system.event(name).type
                used = [(v, field_type(type_, (field,), self.system)) for field, v in arguments]
                used += [(value, None) for value in (to.values if to is not None else ())]
                if any(can_fail(value, held) for value, held in used):
                    yield _perhaps_fail
                if to is not None and to.values:
                    to = ir.Address(_NOBODY)
                yield super().effect(replace(effect, arguments=(), to=to))
            case _:
                yield super().effect(effect)


def _either(instance: InstanceLike, event: Event | None) -> bool:
    """Make a free choice."""
    del event
    return bool(instance.data[EITHER]())


def _perhaps_fail(instance: InstanceLike, event: Event | None) -> None:
    """Fail, or not."""
    if _either(instance, event):
        raise ExecutionError("a value that is left open has no place to be stored")


def _is_known(expression: ir.Expression) -> bool:
    """Return True if a condition depends on params and active states only."""
    if isinstance(expression, ir.InState):
        return True
    if isinstance(expression, (ir.Unary, ir.Binary)):
        return all(map(_is_known, parts(expression)))
    return is_constant(expression)
