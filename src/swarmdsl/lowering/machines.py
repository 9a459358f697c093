"""Lower state machines: ids, expanded submachines, references by id."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial

from swarmdsl import ir
from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.analysis.resolve.states import regions, variables_of, vertices
from swarmdsl.base.naming import snake_case
from swarmdsl.base.records import replace
from swarmdsl.lowering.context import Context
from swarmdsl.lowering.docs import lower_docs
from swarmdsl.lowering.expressions import lower_expression, lower_optional
from swarmdsl.lowering.interfaces import lower_params, lower_values
from swarmdsl.lowering.transitions import (
    Frame,
    lower_activity,
    lower_branch,
    lower_deferred,
    lower_effects,
    lower_transitions,
)
from swarmdsl.syntax.ast import (
    Choice,
    Component,
    Container,
    Entry,
    Exit,
    FinalState,
    History,
    Initial,
    Member,
    NameUse,
    Parallel,
    Param,
    Region,
    State,
    StateMachine,
    Variable,
    Vertex,
    nodes_of,
)
from swarmdsl.syntax.types import FLOATS, Primitive


def lower_machine(machine: StateMachine, context: Context) -> ir.StateMachine:
    """Lower a machine as a behaviour, with the machines that it reuses expanded."""
    params = _params(machine, context)
    builder = _Builder({param.name for param in params})
    ids = _ids(machine, "")
    initial = ids[_initial(machine)]
    builder.add_variables(machine, "", context)
    frame = Frame(ids, builder.with_states(machine, ids, context))
    states = builder.states(machine, frame)
    return ir.StateMachine(
        name=context.names[machine],
        initial=initial,
        states=states,
        variables=tuple(builder.variables),
        params=params,
        endless=machine.endless,
        doc=machine.doc,
        docs=lower_docs(machine.items),
        origin=machine.name.span,
    )


def names_of_variables(machine: StateMachine, lowered: ir.StateMachine) -> dict[Variable, str]:
    """Return the names that the variables of a machine and of its states have when lowered."""
    # Those of machines that it reuses, and blank values, come after its own.
    names = {each.origin: each.name for each in reversed(lowered.variables)}
    return {each: names[each.name.span] for each in nodes_of(machine, Variable)}


def inside(machine: StateMachine, lowered: ir.StateMachine, context: Context) -> Context:
    """Return the context of an expression that is written into a machine after it was lowered."""
    variables = {**context.variables, **names_of_variables(machine, lowered)}
    return replace(context, variables=variables, states=_ids(machine, ""))


class _Builder:
    """Builder of one machine's states, which collects variables of reused machines."""

    def __init__(self, taken: set[str]) -> None:
        self.variables: list[ir.Variable] = []
        self._taken = taken

    def add_variables(
        self, machine: StateMachine, state: str, context: Context
    ) -> dict[Variable, str]:
        """Add the variables of a machine that a state reuses; return the names."""
        return {item: self._add(item, state, context) for item in variables_of(machine)}

    def with_states(
        self, machine: StateMachine, ids: Mapping[Vertex | Region, str], context: Context
    ) -> Context:
        """Return the context with the states of a machine.

        Their variables are added, named after the states.
        """
        names: dict[Variable, str] = {}
        for state, path in ids.items():
            if isinstance(state, (State, Parallel, Region)):
                for item in variables_of(state):
                    names[item] = self._add(item, path, context)
        return replace(context, variables={**context.variables, **names}, states=ids)

    def _add(self, item: Variable, state: str, context: Context) -> str:
        """Add a variable, of a state if it has an id, after which it is named; return its name."""
        made = ir.Variable(
            self._new(f"{snake_case(state)}_{item.name}" if state else str(item.name)),
            context.type_of(item.type),
            lower_optional(item.initial, context, item.type.type),
            item.doc,
            item.name.span,
            state,
            str(item.name) if state else "",
        )
        self.variables.append(made)
        return made.name

    def _new(self, name: str) -> str:
        while name in self._taken:
            name += "_"
        self._taken.add(name)
        return name

    def _entry(self, state: State | Parallel, frame: Frame) -> tuple[ir.Effect, ...]:
        """Return the effects on entry, after the initial values of the state's variables."""
        owners = (state, *regions(state))
        own = (item for owner in owners for item in variables_of(owner))
        values = [self._first_value(item, frame.context) for item in own]
        return (*values, *lower_effects(state, Entry, frame))

    def _first_value(self, variable: Variable, context: Context) -> ir.Assignment:
        name, type_ = context.variables[variable], context.type_of(variable.type)
        value = lower_optional(variable.initial, context, variable.type.type) or _zero(type_)
        if value is None:
            # A message has no literal: a variable that nothing writes has its zero.
            blank = self._new(f"{name}_blank")
            self.variables.append(ir.Variable(blank, type_, None, "", variable.name.span))
            value = ir.VariableRef(blank, type_, variable.name.span)
        return ir.Assignment(name, (), value, variable.name.span)

    def states(self, container: Container, frame: Frame) -> tuple[ir.State, ...]:
        """Return the states directly inside a container."""
        return tuple(self._state(state, frame) for state in vertices(container))

    def _state(self, state: Vertex, frame: Frame) -> ir.State:
        made = partial(
            ir.State,
            id=frame.ids[state],
            name=str(state.name),
            doc=state.doc,
            origin=state.name.span,
        )
        match state:
            case FinalState():
                return made(kind=ir.StateKind.FINAL)
            case History():
                assert state.default is not None
                target = frame.ids[state.default]
                resume = ir.Transition((), None, (), target, origin=state.span)
                return made(kind=ir.StateKind.HISTORY, deep=state.deep, transitions=(resume,))
            case Choice():
                branches = tuple(lower_branch(branch, frame) for branch in state.branches)
                return made(kind=ir.StateKind.CHOICE, transitions=branches)
            case Parallel():
                return made(
                    kind=ir.StateKind.PARALLEL,
                    states=tuple(
                        self._region(item, frame)
                        for item in state.items
                        if isinstance(item, Region)
                    ),
                    transitions=lower_transitions(state, frame),
                    entry=self._entry(state, frame),
                    exit=lower_effects(state, Exit, frame),
                    deferred=lower_deferred(state, frame),
                    docs=lower_docs(state.items),
                )
            case State():
                made = partial(
                    made,
                    transitions=lower_transitions(state, frame),
                    exit=lower_effects(state, Exit, frame),
                    deferred=lower_deferred(state, frame),
                    docs=lower_docs(state.items),
                )
                entry = self._entry(state, frame)
                if state.machine is not None:
                    return self._submachine(made, entry, state, frame)
                if vertices(state):
                    return made(
                        kind=ir.StateKind.COMPOSITE,
                        initial=frame.ids[_initial(state)],
                        states=self.states(state, frame),
                        entry=entry,
                    )
                activity = lower_activity(state, frame)
                return made(kind=ir.StateKind.SIMPLE, activity=activity, entry=entry)

    def _region(self, region: Region, frame: Frame) -> ir.State:
        return ir.State(
            id=frame.ids[region],
            name=str(region.name),
            kind=ir.StateKind.REGION,
            initial=frame.ids[_initial(region)],
            states=self.states(region, frame),
            doc=region.doc,
            docs=lower_docs(region.items),
            origin=region.name.span,
        )

    def _submachine(
        self,
        made: partial[ir.State],
        entry: tuple[ir.Effect, ...],
        state: State,
        frame: Frame,
    ) -> ir.State:
        assert state.machine is not None
        machine = state.machine.target
        assert machine is not None
        names = self.add_variables(machine, frame.ids[state], frame.context)
        bound = {str(binding.name): binding.value for binding in state.bindings}
        values = {}
        for item in machine.items:
            if isinstance(item, Param):
                value = bound.get(str(item.name), item.default)
                assert value is not None
                values[item] = lower_expression(value, frame.context, item.type.type)
        ids = _ids(machine, frame.ids[state])
        context = frame.context.reusing(names, values)
        inner = Frame(ids, self.with_states(machine, ids, context))
        return made(
            kind=ir.StateKind.COMPOSITE,
            initial=inner.ids[_initial(machine)],
            states=self.states(machine, inner),
            # Its variables are initialized each time: a counter of tries, for instance.
            entry=(*_first_values(names, frame.context), *entry),
            submachine=frame.context.names[machine],
        )


def _first_values(names: Mapping[Variable, str], context: Context) -> Iterator[ir.Assignment]:
    for variable, name in names.items():
        if variable.initial is not None:
            value = lower_expression(variable.initial, context, variable.type.type)
            yield ir.Assignment(name, (), value, variable.name.span)


def _zero(type_: ir.Type) -> ir.Literal | None:
    """Return the zero of a type; None for one without literals, such as a message."""
    match type_:
        case Primitive(name="bool"):
            return ir.Literal(False, type_)
        case Primitive(name="string" | "wstring"):
            return ir.Literal("", type_)
        case Primitive(name=name) if name != "time":
            return ir.Literal(0.0 if name in FLOATS else 0, type_)
    return None


def _ids(container: Container, prefix: str) -> dict[Vertex | Region, str]:
    """Return the paths of a machine's states below `prefix`, without reused machines."""
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
    """Return the params of a machine: its own, and those of its members that it uses.

    A default is that of the members and components with this behaviour, if they agree.
    """
    own = [item for item in machine.items if isinstance(item, Param)]
    used = {use.target for use in nodes_of(machine, NameUse) if isinstance(use.target, Param)}
    given = [
        values for owner in context.behaving.get(machine, []) for values in _values(owner, context)
    ]
    found = []
    for param in lower_params(
        [*own, *sorted(used - set(own), key=lambda p: p.span.absolute.start)], context
    ):
        values = [params.get(param.name, param.default) for params in given] or [param.default]
        agreed = values[0] if all(value == values[0] for value in values) else None
        found.append(replace(param, default=agreed, declared=param.default))
    return tuple(found)


def _values(
    owner: Member | Component, context: Context
) -> Iterator[dict[str, ir.Expression | None]]:
    """Yield the values of an owner's params: for a component, in each of its parts.

    A value that depends on params of the robot is None: each robot has its own.
    """
    defaults = {
        param.name: param.default for param in lower_params(all_items(owner, Param), context)
    }
    parts = context.parts.get(owner, []) if isinstance(owner, Component) else []
    for part in parts:
        given = {
            name: None
            if any(isinstance(each, ir.ParamRef) for each in ir.subexpressions(value))
            else value
            for name, value in lower_values(part.values, owner, context)
        }
        yield {**defaults, **given}
    if not parts:
        yield defaults
