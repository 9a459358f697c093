"""Type checks of guards, effects, delays and values in a state machine."""

from __future__ import annotations

from swarmdsl.analysis.checks.activities import check_arguments
from swarmdsl.analysis.checks.arrays import (
    check_array_effect,
    check_element_names,
    report_not_assignable,
)
from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.enums import check_first_value
from swarmdsl.analysis.checks.guard_satisfiability import guard_condition
from swarmdsl.analysis.checks.interfaces import check_graph_name
from swarmdsl.analysis.types import COUNT, Typing, assignable, item_of
from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.syntax.ast import (
    Address,
    Append,
    Assignment,
    Branch,
    Clear,
    Effect,
    Entry,
    Event,
    EventTrigger,
    Exit,
    Expression,
    ExpressionTree,
    MessageType,
    MonitorTrigger,
    OperatorUse,
    Param,
    Remove,
    Send,
    StateMachine,
    TimeTrigger,
    Transition,
    Variable,
    nodes_of,
)
from swarmdsl.syntax.types import BOOL, DURATION, STRING, Named


def check_expressions(machine: StateMachine, context: Context) -> None:
    """Check all expressions of a machine except those of activities.

    Sets the conditions of the guards in the context.
    """
    check_element_names(machine, context)
    for param in nodes_of(machine, Param):
        context.check_default(param, param.default)
    for variable in nodes_of(machine, Variable):
        context.check_default(variable, variable.initial)
        check_first_value(variable, context)
    for time in nodes_of(machine, TimeTrigger):
        _check_delay(time.delay, context.typing, context)
    for monitor in nodes_of(machine, MonitorTrigger):
        check_graph_name(monitor.topic, "a topic", context)
        context.check_kind(monitor.type, MessageType)
    for transition in nodes_of(machine, Transition):
        if transition.guard is None and not transition.effects:
            continue
        triggers = transition.triggers
        events = [t for t in triggers if isinstance(t, (EventTrigger, MonitorTrigger))]
        all_events = events and len(events) == len(triggers)
        typing = context.with_event(events) if all_events else context.typing
        _check_guard(transition, typing, context)
        _check_effects(transition.effects, typing, context)
    for branch in nodes_of(machine, Branch):
        _check_guard(branch, context.typing, context)
        _check_effects(branch.effects, context.typing, context)
    for entry in nodes_of(machine, Entry):
        _check_effects(entry.effects, context.typing, context)
    for exit_ in nodes_of(machine, Exit):
        _check_effects(exit_.effects, context.typing, context)


def _check_guard(item: Transition | Branch, typing: Typing, context: Context) -> None:
    """Check the type of a guard and set the condition of a correct one."""
    tree = item.guard.tree if item.guard is not None else None
    if tree is not None and typing.expect(tree, BOOL):
        context.conditions[item] = guard_condition(tree, typing)


def _check_delay(delay: Expression, typing: Typing, context: Context) -> None:
    context.expect(delay, DURATION, typing)
    if delay.tree is not None and _negative(delay.tree, typing):
        context.report.report("negative-delay", delay.span)
    elif delay.tree is not None and _zero(delay.tree, typing):
        context.report.report(
            "zero-delay",
            delay.span,
            help="give it a duration; `on done` of an idle state fires at once",
        )


def _negative(delay: ExpressionTree, typing: Typing) -> bool:
    """Return True for a negative delay, also as the default of a param."""
    value = typing.folding.value(delay)
    if isinstance(value, (int, float)):
        return value < 0
    return isinstance(delay, OperatorUse) and delay.operator == "-" and len(delay.operands) == 1


def _zero(delay: ExpressionTree, typing: Typing) -> bool:
    """Return True for a delay of zero. A plain number is reported elsewhere."""
    return typing.folding.value(delay) == 0 and typing.infer(delay) == DURATION


def _check_effects(effects: list[Effect], typing: Typing, context: Context) -> None:
    for effect in effects:
        match effect:
            case Assignment():
                _check_assignment(effect, typing, context)
            case Append() | Remove() | Clear():
                check_array_effect(effect, typing)
            case Send():
                context.check_repeated((argument.name for argument in effect.arguments), "field")
                event = effect.event.target
                type_ = event.type.type if event is not None else None
                fields = typing.interfaces.fields(type_) if isinstance(type_, Named) else None
                check_arguments(effect.arguments, fields, f"`{type_}`", typing)
                if effect.to is not None:
                    _check_address(effect.to, event, typing)
                if effect.delay is not None:
                    _check_delay(effect.delay, typing, context)


def _check_address(address: Address, event: Event | None, typing: Typing) -> None:
    """Check the event, and the types; the swarms that run the machine check the roles."""
    if event is not None and not event.swarm:
        typing.report.report(
            "local-address",
            address.span,
            related=(Label(event.name.span, "an event of the robot itself"),),
            help=Advice(
                f"declare `swarm event {event.name}` to send it to other robots",
                "declare swarm event",
                str(event.name),
            ),
        )
    if address.role_use is None:
        typing.expect(address.id.tree, STRING)
    elif address.index is not None:
        typing.expect(address.index, COUNT)


def _check_assignment(effect: Assignment, typing: Typing, context: Context) -> None:
    target = effect.target.tree
    if target is None:
        return
    if not assignable(target) and item_of(target) is None:
        report_not_assignable(effect.target, typing)
        return
    typing.expect(effect.value.tree, typing.infer(target))
