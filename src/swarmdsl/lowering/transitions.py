"""Lower the content of states: transitions, entry and exit effects, activity."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from swarmdsl import ir
from swarmdsl.analysis.called_interface import call_fields
from swarmdsl.analysis.event_topics import is_of_swarm, received_topic
from swarmdsl.analysis.resolve.membership import is_member_event
from swarmdsl.base.records import dataclass, replace
from swarmdsl.lowering.context import Context
from swarmdsl.lowering.expressions import (
    lower_expression,
    lower_fields,
    lower_optional,
    lower_path,
    lower_store,
    lower_tree,
)
from swarmdsl.syntax.ast import (
    Activity,
    Address,
    Branch,
    Cancel,
    Defer,
    DoneTrigger,
    Effect,
    Entry,
    EventTrigger,
    Exit,
    MonitorTrigger,
    OutcomeTrigger,
    Parallel,
    Ref,
    Region,
    Send,
    State,
    TimeTrigger,
    Transition,
    Trigger,
    Vertex,
)


@dataclass(frozen=True)
class Frame:
    """Use of a machine: the ids of its states there, and its names."""

    ids: Mapping[Vertex | Region, str]
    context: Context


def lower_effects(
    state: State | Parallel, kind: type[Entry] | type[Exit], frame: Frame
) -> tuple[ir.Effect, ...]:
    """Lower the effects on entry or on exit of a state."""
    return tuple(
        _effect(effect, frame.context)
        for item in state.items
        if isinstance(item, kind)
        for effect in item.effects
    )


def lower_deferred(state: State | Parallel, frame: Frame) -> tuple[ir.EventTrigger, ...]:
    """Lower the events that a state defers."""
    return tuple(
        ir.EventTrigger(
            frame.context.name(deferred.event),
            deferred.span,
            is_member_event(deferred.event.target),
        )
        for item in state.items
        if isinstance(item, Defer)
        for deferred in item.events
    )


def lower_transitions(state: State | Parallel, frame: Frame) -> tuple[ir.Transition, ...]:
    """Lower the transitions of a state."""
    items = [item for item in state.items if isinstance(item, Transition)]
    return tuple(made for item in items for made in _transition(item, state, frame))


def _transition(
    transition: Transition, owner: State | Parallel, frame: Frame
) -> Iterator[ir.Transition]:
    """Lower a transition; two if one trigger is the completion of a simple state.

    A state without activity and content is complete at once (UML 2.5.1, 14.2.3.4):
    a transition on that has no trigger.
    """
    context = frame.context
    messages = [_message_type(trigger, context) for trigger in transition.triggers]
    types = [type_ for type_ in messages if type_ is not None]
    if types and len(types) == len(messages):
        of_swarm = all(map(is_of_swarm, transition.triggers))
        context = context.with_event(types, of_swarm=of_swarm)
    waiting = [t for t in transition.triggers if not _is_immediate(t, owner)]
    triggers = tuple(_trigger(trigger, owner, frame) for trigger in waiting)
    made = ir.Transition(
        triggers=triggers,
        guard=lower_optional(transition.guard, context),
        effects=tuple(_effect(effect, context) for effect in transition.effects),
        target=_target(transition.target, frame) if transition.target is not None else None,
        # A transition without a target is always internal.
        internal=transition.internal and transition.target is not None,
        doc=transition.doc,
        origin=transition.span,
    )
    if len(waiting) < len(transition.triggers):
        yield replace(made, triggers=())
    if waiting or not transition.triggers:
        yield made


def _message_type(trigger: Trigger, context: Context) -> ir.Type | None:
    match trigger:
        case EventTrigger():
            assert trigger.event.target is not None
            return context.type_of(trigger.event.target.type)
        case MonitorTrigger():
            return context.type_of(trigger.type)
    return None


def _is_immediate(trigger: Trigger, owner: State | Parallel) -> bool:
    if not (isinstance(trigger, DoneTrigger) and trigger.region is None):
        return False
    return (
        isinstance(owner, State)
        and owner.machine is None
        and not any(isinstance(item, (Activity, Vertex)) for item in owner.items)
    )


def lower_branch(branch: Branch, frame: Frame) -> ir.Transition:
    """Lower a branch of a choice."""
    return ir.Transition(
        triggers=(),
        guard=lower_optional(branch.guard, frame.context),
        effects=tuple(_effect(effect, frame.context) for effect in branch.effects),
        target=_target(branch.target, frame),
        doc=branch.doc,
        origin=branch.span,
    )


def _target(ref: Ref[Vertex], frame: Frame) -> str:
    assert ref.target is not None
    return frame.ids[ref.target]


def _trigger(trigger: Trigger, owner: State | Parallel, frame: Frame) -> ir.Trigger:
    match trigger:
        case EventTrigger():
            predefined = is_member_event(trigger.event.target)
            return ir.EventTrigger(frame.context.name(trigger.event), trigger.span, predefined)
        case OutcomeTrigger(outcome=outcome):
            return ir.OutcomeTrigger(frame.ids[owner], outcome, trigger.span)
        case MonitorTrigger():
            return ir.EventTrigger(frame.context.heard[received_topic(trigger)], trigger.span)
        case TimeTrigger(delay=delay):
            return ir.TimeTrigger(lower_expression(delay, frame.context), trigger.span)
        case DoneTrigger(region=region, final=final):
            state = frame.ids[owner]
            if region is not None:
                state = f"{state}.{region.name}"
            reached = f"{state}.{final.name}" if final is not None else None
            return ir.DoneTrigger(state, reached, trigger.span)


def _effect(effect: Effect, context: Context) -> ir.Effect:
    interfaces = context.typing.interfaces
    match effect:
        case Send():
            event = effect.event.target
            type_ = event.type.type if event is not None else None
            fields = interfaces.fields(type_) if isinstance(type_, ir.Named) else None
            return ir.Send(
                context.name(effect.event),
                lower_fields(effect.arguments, fields, context),
                _address(effect.to, context) if effect.to is not None else None,
                lower_optional(effect.delay, context),
                effect.span,
            )
        case Cancel():
            return ir.Cancel(context.name(effect.event), effect.span)
    return lower_store(effect, context)


def _address(address: Address, context: Context) -> ir.Address:
    role = address.role_use
    if role is not None:
        index = lower_tree(address.index, context) if address.index is not None else None
        return ir.Address(role.name, index, origin=address.span)
    return ir.Address(id=lower_expression(address.id, context), origin=address.span)


def lower_activity(state: State, frame: Frame) -> ir.Activity | None:
    """Lower the activity of a simple state, if it has one."""
    found = next((item for item in state.items if isinstance(item, Activity)), None)
    if found is None:
        return None
    context = frame.context
    fields, _ = call_fields(found.function.target, context.typing.interfaces)
    return ir.Activity(
        function=context.function(found),
        arguments=lower_fields(found.arguments, fields, context),
        goal_callback=str(found.goal_callback) if found.goal_callback else None,
        results=tuple(
            ir.ResultMapping(str(result.field), *lower_path(result.target, context), result.span)
            for result in found.results
        ),
        result_callback=str(found.result_callback) if found.result_callback else None,
        doc=found.doc,
        origin=found.span,
    )
