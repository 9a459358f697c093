"""State machines: ids, submachines put in place, references by id."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from swarmdsl import ir
from swarmdsl.inheritance import all_items
from swarmdsl.link_machines import regions, vertices
from swarmdsl.lower.context import Context
from swarmdsl.lower.expressions import lower_expression, lower_optional, lower_path
from swarmdsl.lower.interfaces import lower_params
from swarmdsl.naming import snake_case
from swarmdsl.syntax import (
    Activity,
    Argument,
    Assignment,
    Branch,
    Choice,
    Component,
    Container,
    DoneTrigger,
    Effect,
    Entry,
    EventTrigger,
    Exit,
    FinalState,
    History,
    Initial,
    Member,
    MonitorTrigger,
    NameUse,
    OutcomeTrigger,
    Parallel,
    Param,
    Part,
    Ref,
    Region,
    Send,
    State,
    StateMachine,
    TimeTrigger,
    Transition,
    Trigger,
    Variable,
    Vertex,
    walk,
)


def lower_machine(machine: StateMachine, context: Context) -> ir.StateMachine:
    """A machine as a behaviour of its own, the machines it reuses in place."""
    params = _params(machine, context)
    builder = _Builder({param.name for param in params})
    frame = _Frame(_ids(machine, ""), context)
    initial = frame.ids[_initial(machine)]
    builder.add_variables(machine, "", context)
    states = builder.states(machine, frame)
    return ir.StateMachine(
        name=context.names[machine],
        initial=initial,
        states=states,
        variables=tuple(builder.variables),
        params=params,
        endless=machine.endless,
        doc=machine.doc,
        origin=machine.name.span,
    )


@dataclass(frozen=True)
class _Frame:
    """One use of a machine: the ids of its states there, and what its names mean."""

    ids: Mapping[Vertex | Region, str]
    context: Context


class _Builder:
    """Builds the states of one machine and gathers the variables of those it reuses."""

    def __init__(self, taken: set[str]) -> None:
        self.variables: list[ir.Variable] = []
        self._taken = taken

    def add_variables(
        self, machine: StateMachine, prefix: str, context: Context
    ) -> dict[Variable, str]:
        """Add a machine's variables, named after the state that reuses it; return the names."""
        names: dict[Variable, str] = {}
        for item in machine.items:
            if isinstance(item, Variable):
                name = prefix + item.name
                while name in self._taken:
                    name += "_"
                self._taken.add(name)
                names[item] = name
                self.variables.append(
                    ir.Variable(
                        name,
                        context.type_of(item.type),
                        lower_optional(item.initial, context),
                        item.doc,
                        item.name.span,
                    )
                )
        return names

    def states(self, container: Container, frame: _Frame) -> tuple[ir.State, ...]:
        """The states directly inside a container."""
        return tuple(self._state(state, frame) for state in vertices(container))

    def _state(self, state: Vertex, frame: _Frame) -> ir.State:
        made = ir.State(
            id=frame.ids[state],
            name=str(state.name),
            kind=ir.StateKind.SIMPLE,
            doc=state.doc,
            origin=state.name.span,
        )
        match state:
            case FinalState():
                return replace(made, kind=ir.StateKind.FINAL)
            case History():
                assert state.target.target is not None
                target = frame.ids[state.target.target]
                resume = ir.Transition((), None, (), target, origin=state.span)
                return replace(
                    made, kind=ir.StateKind.HISTORY, deep=state.deep, transitions=(resume,)
                )
            case Choice():
                branches = tuple(_branch(branch, frame) for branch in state.branches)
                return replace(made, kind=ir.StateKind.CHOICE, transitions=branches)
            case Parallel():
                return replace(
                    made,
                    kind=ir.StateKind.PARALLEL,
                    states=tuple(
                        self._region(item, frame)
                        for item in state.items
                        if isinstance(item, Region)
                    ),
                    transitions=_transitions(state, frame),
                    entry=_effects(state, Entry, frame),
                    exit=_effects(state, Exit, frame),
                )
            case State():
                made = replace(
                    made,
                    transitions=_transitions(state, frame),
                    entry=_effects(state, Entry, frame),
                    exit=_effects(state, Exit, frame),
                )
                if state.machine is not None:
                    return self._submachine(made, state, frame)
                if any(True for _ in vertices(state)):
                    return replace(
                        made,
                        kind=ir.StateKind.COMPOSITE,
                        initial=frame.ids[_initial(state)],
                        states=self.states(state, frame),
                    )
                return replace(made, activity=_activity(state, frame))

    def _region(self, region: Region, frame: _Frame) -> ir.State:
        return ir.State(
            id=frame.ids[region],
            name=str(region.name),
            kind=ir.StateKind.REGION,
            initial=frame.ids[_initial(region)],
            states=self.states(region, frame),
            doc=region.doc,
            origin=region.name.span,
        )

    def _submachine(self, made: ir.State, state: State, frame: _Frame) -> ir.State:
        assert state.machine is not None
        machine = state.machine.target
        assert machine is not None
        names = self.add_variables(machine, snake_case(made.id) + "_", frame.context)
        bound = {str(binding.name): binding.value for binding in state.bindings}
        values = {}
        for item in machine.items:
            if isinstance(item, Param):
                value = bound.get(str(item.name), item.default)
                assert value is not None
                values[item] = lower_expression(value, frame.context)
        inner = _Frame(_ids(machine, made.id), frame.context.reusing(names, values))
        return replace(
            made,
            kind=ir.StateKind.COMPOSITE,
            initial=inner.ids[_initial(machine)],
            states=self.states(machine, inner),
            # Its variables start anew each time: a counter of tries, for instance.
            entry=(*_first_values(names, frame.context), *made.entry),
            submachine=frame.context.names[machine],
        )


def _first_values(names: Mapping[Variable, str], context: Context) -> Iterator[ir.Assignment]:
    for variable, name in names.items():
        if variable.initial is not None:
            value = lower_expression(variable.initial, context)
            yield ir.Assignment(name, (), value, variable.name.span)


def _ids(container: Container, prefix: str) -> dict[Vertex | Region, str]:
    """Paths of all states of a machine below `prefix`, those of reused machines left out."""
    found: dict[Vertex | Region, str] = {}
    for inside in (*vertices(container), *regions(container)):
        path = f"{prefix}.{inside.name}" if prefix else str(inside.name)
        found[inside] = path
        if isinstance(inside, (State, Parallel, Region)):
            found |= _ids(inside, path)
    return found


def _initial(container: Container) -> Vertex:
    found = next(item for item in container.items if isinstance(item, Initial))
    assert found.target.target is not None
    return found.target.target


def _params(machine: StateMachine, context: Context) -> tuple[ir.Param, ...]:
    """The params a machine runs with: its own, and those of its members that it uses.

    A default is that of the members and components which behave so, where they agree.
    """
    own = [item for item in machine.items if isinstance(item, Param)]
    used = {
        node.target
        for node in walk(machine)
        if isinstance(node, NameUse) and isinstance(node.target, Param)
    }
    given = [
        values for owner in context.behaving.get(machine, []) for values in _values(owner, context)
    ]
    found = []
    for param in lower_params(
        [*own, *sorted(used - set(own), key=lambda p: p.span.start)], context
    ):
        values = [params.get(param.name, param.default) for params in given] or [param.default]
        agreed = values[0] if all(value == values[0] for value in values) else None
        found.append(replace(param, default=agreed))
    return tuple(found)


def _values(
    owner: Member | Component, context: Context
) -> Iterator[dict[str, ir.Expression | None]]:
    """The values of an owner's params: for a component, in each part that is one."""
    defaults = {
        param.name: param.default for param in lower_params(all_items(owner, Param), context)
    }
    parts = [
        part
        for member in context.names
        if isinstance(member, Member)
        for part in all_items(member, Part)
        if part.component.target is owner
    ]
    for part in parts:
        given = {str(v.name): lower_expression(v.value, context) for v in part.values}
        yield {**defaults, **given}
    if not parts:
        yield defaults


def _effects(
    state: State | Parallel, kind: type[Entry] | type[Exit], frame: _Frame
) -> tuple[ir.Effect, ...]:
    return tuple(
        _effect(effect, frame.context)
        for item in state.items
        if isinstance(item, kind)
        for effect in item.effects
    )


def _transitions(state: State | Parallel, frame: _Frame) -> tuple[ir.Transition, ...]:
    items = [item for item in state.items if isinstance(item, Transition)]
    return tuple(made for item in items for made in _transition(item, state, frame))


def _transition(
    transition: Transition, owner: State | Parallel, frame: _Frame
) -> Iterator[ir.Transition]:
    """One transition; two where one of the triggers is the completion of a simple state.

    A state that does nothing and has nothing in it is complete at once (UML 2.5.1, 14.2.3.4):
    a transition on that is one without trigger.
    """
    context = frame.context
    types = [_message_type(trigger, context) for trigger in transition.triggers]
    if types and types[0] is not None:
        context = context.with_event(types[0])
    waiting = [t for t in transition.triggers if not _at_once(t, owner)]
    triggers = tuple(_trigger(trigger, owner, frame) for trigger in waiting)
    made = ir.Transition(
        triggers=triggers,
        guard=lower_optional(transition.guard, context),
        effects=tuple(_effect(effect, context) for effect in transition.effects),
        target=_target(transition.target, frame) if transition.target is not None else None,
        # Without a target a transition is internal anyway.
        internal=transition.internal and transition.target is not None,
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


def _at_once(trigger: Trigger, owner: State | Parallel) -> bool:
    if not (isinstance(trigger, DoneTrigger) and trigger.region is None):
        return False
    return (
        isinstance(owner, State)
        and owner.machine is None
        and not any(isinstance(item, (Activity, Vertex)) for item in owner.items)
    )


def _branch(branch: Branch, frame: _Frame) -> ir.Transition:
    return ir.Transition(
        triggers=(),
        guard=lower_optional(branch.guard, frame.context),
        effects=tuple(_effect(effect, frame.context) for effect in branch.effects),
        target=_target(branch.target, frame),
        origin=branch.span,
    )


def _target(ref: Ref[Vertex], frame: _Frame) -> str:
    assert ref.target is not None
    return frame.ids[ref.target]


def _trigger(trigger: Trigger, owner: State | Parallel, frame: _Frame) -> ir.Trigger:
    match trigger:
        case EventTrigger():
            return ir.EventTrigger(frame.context.name(trigger.event), trigger.span)
        case OutcomeTrigger(outcome=outcome):
            return ir.OutcomeTrigger(frame.ids[owner], outcome, trigger.span)
        case MonitorTrigger():
            return ir.EventTrigger(frame.context.monitor(trigger).name, trigger.span)
        case TimeTrigger(delay=delay):
            return ir.TimeTrigger(lower_expression(delay, frame.context), trigger.span)
        case DoneTrigger(region=region, final=final):
            state = frame.ids[owner]
            if region is not None:
                state = f"{state}.{region.name}"
            reached = f"{state}.{final.name}" if final is not None else None
            return ir.DoneTrigger(state, reached, trigger.span)


def _effect(effect: Effect, context: Context) -> ir.Effect:
    match effect:
        case Assignment():
            variable, path = lower_path(effect.target, context)
            value = lower_expression(effect.value, context)
            return ir.Assignment(variable, path, value, effect.span)
        case Send():
            return ir.Send(
                context.name(effect.event), _arguments(effect.arguments, context), effect.span
            )


def _activity(state: State, frame: _Frame) -> ir.Activity | None:
    found = next((item for item in state.items if isinstance(item, Activity)), None)
    if found is None:
        return None
    context = frame.context
    return ir.Activity(
        function=context.name(found.function),
        arguments=_arguments(found.arguments, context),
        goal_callback=str(found.goal_callback) if found.goal_callback else None,
        results=tuple(
            ir.ResultMapping(str(result.field), *lower_path(result.target, context), result.span)
            for result in found.results
        ),
        result_callback=str(found.result_callback) if found.result_callback else None,
        origin=found.span,
    )


def _arguments(
    arguments: list[Argument], context: Context
) -> tuple[tuple[str, ir.Expression], ...]:
    return tuple((str(a.name), lower_expression(a.value, context)) for a in arguments)
