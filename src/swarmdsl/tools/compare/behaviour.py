"""State machines as elements.

The content of a submachine is compared only where it is declared.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.base.records import dataclass
from swarmdsl.codegen.diagram.local_variables import without_first_values
from swarmdsl.codegen.swarm_printer.reuse import Reuse, find_reuse, own_variables
from swarmdsl.ir import (
    Activity,
    Address,
    Assignment,
    Call,
    Cancel,
    DoneTrigger,
    Effect,
    EventTrigger,
    Expression,
    OutcomeTrigger,
    Param,
    Send,
    State,
    StateKind,
    StateMachine,
    System,
    TimeTrigger,
    Transition,
    Trigger,
    Variable,
)
from swarmdsl.tools.compare.elements import (
    Element,
    Ref,
    Value,
    argument_values,
    expression_value,
    join_values,
    properties,
    state_kind,
    type_value,
    variable_kind,
    with_doc,
)

VERTEX_KIND = "state"
"""Element kind of all states and pseudostates."""
TRANSITION_KIND = "transition"
_KIND_NAMES = {
    StateKind.SIMPLE: "simple state",
    StateKind.COMPOSITE: "composite state",
    StateKind.PARALLEL: "parallel state",
    StateKind.REGION: "region",
    StateKind.FINAL: "final state",
    StateKind.CHOICE: "choice",
    StateKind.HISTORY: "history",
}


def machine_element(machine: StateMachine, system: System) -> Element:
    """Element of a state machine with its params, variables and states."""
    machines = system.machines_by_name
    builder = _Machine(machine.name, find_reuse(machine, machines), machine.variables)
    data = [*param_elements(machine.params, machine.name)]
    data += (
        with_doc(
            Element(
                "variable",
                (declared_name(variable),),
                properties(
                    type=type_value(variable.type),
                    initial=expression_value(variable.initial, machine.name),
                ),
                ref=Ref(variable_kind(machine.name), variable.name),
                origin=variable.origin,
            ),
            variable.doc,
        )
        for variable in own_variables(machine, machines)
    )
    element = Element(
        "statemachine",
        (machine.name,),
        properties(initial=builder.state(machine.initial), endless=machine.endless),
        (*data, *map(builder.element, machine.states)),
        Ref("statemachine", machine.name),
        machine.origin,
    )
    return with_doc(element, machine.doc, machine.docs)


def param_elements(params: Iterable[Param], machine: str = "") -> Iterator[Element]:
    """Yield the elements of params; expressions in `machine` can refer to them."""
    for param in params:
        default = param.declared if param.declared is not None else param.default
        values = properties(type=type_value(param.type), default=expression_value(default))
        ref = Ref(variable_kind(machine), param.name) if machine else None
        yield with_doc(Element("param", (param.name,), values, (), ref, param.origin), param.doc)


def declared_name(variable: Variable) -> str:
    """Name of a variable in the model; `State.variable` for one of a state."""
    return f"{variable.owner}.{variable.local}" if variable.local else variable.name


def declared_names(machines: Iterable[StateMachine]) -> dict[Ref, Ref]:
    """Map the variables of states to their names in the model."""
    return {
        Ref(kind, each.name): Ref(kind, declared_name(each))
        for machine in machines
        for kind in [variable_kind(machine.name)]
        for each in machine.variables
        if each.local
    }


@dataclass(frozen=True)
class _Machine:
    """Element builder that resolves the names of one state machine."""

    name: str
    reuse: Reuse | None
    variables: tuple[Variable, ...]

    def state(self, id_: str | None) -> Value:
        return (Ref(state_kind(self.name), id_),) if id_ is not None else ()

    def element(self, state: State) -> Element:
        use = self.reuse.uses.get(state.id) if self.reuse is not None else None
        entry = use.entry if use is not None else state.entry
        values = properties(
            kind=_KIND_NAMES[state.kind],
            initial=self.state(state.initial) if state.submachine is None else (),
            submachine=(Ref("statemachine", state.submachine),) if state.submachine else (),
            bindings=argument_values(use.bindings, self.name) if use is not None else (),
            activity=self._activity(state.activity),
            entry_effect=self._effects(without_first_values(entry, self.variables)),
            exit_effect=self._effects(state.exit),
            deferred=join_values((self._trigger(each, state) for each in state.deferred), ", "),
            deep=state.deep,
        )
        inner = state.states if state.submachine is None else ()
        children = (
            *(self._transition(each, state) for each in state.transitions),
            *map(self.element, inner),
        )
        ref = Ref(state_kind(self.name), state.id)
        activity = state.activity
        return with_doc(
            Element(VERTEX_KIND, (state.name,), values, children, ref, state.origin),
            state.doc,
            (*state.docs, *((("activity", activity.doc),) if activity is not None else ())),
        )

    def _transition(self, transition: Transition, state: State) -> Element:
        guard = expression_value(transition.guard, self.name)
        name = join_values((self._trigger(each, state) for each in transition.triggers), ", ")
        if not name:
            # The guard identifies a branch of a choice.
            name, guard = ("when ", *guard) if guard else ("else",), ()
        values = properties(
            guard=guard,
            effect=self._effects(transition.effects),
            target=self.state(transition.target) or ("none",),
            internal=transition.internal,
        )
        element = Element(TRANSITION_KIND, name, values, origin=transition.origin)
        return with_doc(element, transition.doc)

    def _trigger(self, trigger: Trigger, state: State) -> Value:
        match trigger:
            case EventTrigger(event=event):
                return "on ", Ref("event", event)
            case TimeTrigger(delay=delay):
                return "after ", *expression_value(delay, self.name)
            case OutcomeTrigger(state=owner, outcome=outcome):
                of = self.state(owner) if owner != state.id else ()
                return f"on {outcome}", *((" of ", *of) if of else ())
            case DoneTrigger(state=owner, final=final):
                of = self.state(owner) if owner != state.id else ()
                ended = self.state(final)
                return (
                    "on done",
                    *((" of ", *of) if of else ()),
                    *((" in ", *ended) if ended else ()),
                )

    def _effects(self, effects: Iterable[Effect]) -> Value:
        return join_values(map(self._effect, effects), ", ")

    def _effect(self, effect: Effect) -> Value:
        match effect:
            case Assignment(variable=variable, path=path, value=value):
                rest = "".join(f".{name}" for name in path)
                known = Ref(variable_kind(self.name), variable)
                return self._store((known, rest), value)
            case Send(event=event, arguments=arguments, to=to, delay=delay):
                given = argument_values(arguments, self.name)
                sent: Value = ("send ", Ref("event", event), *(("(", *given, ")") if given else ()))
                if to is not None:
                    sent = *sent, " to ", *self._address(to)
                if delay is not None:
                    sent = *sent, " after ", *expression_value(delay, self.name)
                return sent
            case Cancel(event=event):
                return "cancel ", Ref("event", event)

    def _store(self, target: Value, value: Expression) -> Value:
        """Return an assignment, or the effect on an array that it stands for."""
        parts = [expression_value(part, self.name) for part in getattr(value, "arguments", ())]
        match value:
            case Call(function="append"):
                return "append ", *parts[1], " to ", *target
            case Call(function="remove"):
                return "remove ", *target, "[", *parts[1], "]"
            case Call(function="replace"):
                return *target, "[", *parts[1], "] = ", *parts[2]
            case Call(function="empty"):
                return "clear ", *target
        return *target, " = ", *expression_value(value, self.name)

    def _address(self, address: Address) -> Value:
        if address.id is not None:
            return expression_value(address.id, self.name)
        if address.index is None:
            return (address.role,)
        return address.role, "[", *expression_value(address.index, self.name), "]"

    def _activity(self, activity: Activity | None) -> Value:
        if activity is None:
            return ()
        made: Value = (Ref("function", activity.function),)
        if activity.goal_callback is not None:
            made = (*made, f"(by {activity.goal_callback})")
        elif activity.arguments:
            made = (*made, "(", *argument_values(activity.arguments, self.name), ")")
        if activity.result_callback is not None:
            return *made, f" gives by {activity.result_callback}"
        results: list[Value] = [
            (
                f"{each.field} => ",
                Ref(variable_kind(self.name), each.variable),
                "".join(f".{name}" for name in each.path),
            )
            for each in activity.results
        ]
        return (*made, " gives (", *join_values(results, ", "), ")") if results else made
