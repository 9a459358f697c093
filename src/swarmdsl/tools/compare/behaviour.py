"""State machines as elements; what a submachine brings is compared where it is declared."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.base.records import dataclass
from swarmdsl.codegen.swarm_printer.reuse import Reuse, find_reuse, own_variables
from swarmdsl.ir import (
    Activity,
    Assignment,
    DoneTrigger,
    Effect,
    EventTrigger,
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
)
from swarmdsl.tools.compare.elements import (
    Element,
    Ref,
    Value,
    assigned,
    data_of,
    joined,
    said,
    state_of,
    type_of,
    with_doc,
    written,
)

VERTEX = "state"
"""The kind of all that transitions lead to or are in."""
TRANSITION = "transition"
_WORDS = {
    StateKind.SIMPLE: "simple state",
    StateKind.COMPOSITE: "composite state",
    StateKind.PARALLEL: "parallel state",
    StateKind.REGION: "region",
    StateKind.FINAL: "final state",
    StateKind.CHOICE: "choice",
    StateKind.HISTORY: "history",
}


def machine_element(machine: StateMachine, system: System) -> Element:
    """A state machine with its params, its variables and its states."""
    machines = {each.name: each for each in system.machines}
    made = _Machine(machine.name, find_reuse(machine, machines))
    data = [*_params(machine.params, machine.name)]
    data += (
        with_doc(
            Element(
                "variable",
                (variable.name,),
                said(type=type_of(variable.type), initial=written(variable.initial, machine.name)),
                ref=Ref(data_of(machine.name), variable.name),
                origin=variable.origin,
            ),
            variable.doc,
        )
        for variable in own_variables(machine, machines)
    )
    element = Element(
        "statemachine",
        (machine.name,),
        said(initial=made.state(machine.initial), endless=machine.endless),
        (*data, *map(made.element, machine.states)),
        Ref("statemachine", machine.name),
        machine.origin,
    )
    return with_doc(element, machine.doc)


def _params(params: Iterable[Param], machine: str) -> Iterator[Element]:
    for param in params:
        default = param.declared if param.declared is not None else param.default
        values = said(type=type_of(param.type), default=written(default))
        ref = Ref(data_of(machine), param.name)
        yield with_doc(Element("param", (param.name,), values, (), ref, param.origin), param.doc)


@dataclass(frozen=True)
class _Machine:
    """What the names in a machine belong to."""

    name: str
    reuse: Reuse | None

    def state(self, id_: str | None) -> Value:
        return (Ref(state_of(self.name), id_),) if id_ is not None else ()

    def element(self, state: State) -> Element:
        use = self.reuse.uses.get(state.id) if self.reuse is not None else None
        entry = use.entry if use is not None else state.entry
        values = said(
            kind=_WORDS[state.kind],
            initial=self.state(state.initial) if state.submachine is None else (),
            submachine=(Ref("statemachine", state.submachine),) if state.submachine else (),
            bindings=assigned(use.bindings, self.name) if use is not None else (),
            activity=self._activity(state.activity),
            entry_effect=self._effects(entry),
            exit_effect=self._effects(state.exit),
            deep=state.deep,
        )
        inner = state.states if state.submachine is None else ()
        children = (
            *(self._transition(each, state) for each in state.transitions),
            *map(self.element, inner),
        )
        ref = Ref(state_of(self.name), state.id)
        return with_doc(
            Element(VERTEX, (state.name,), values, children, ref, state.origin), state.doc
        )

    def _transition(self, transition: Transition, state: State) -> Element:
        guard = written(transition.guard, self.name)
        name = joined((self._trigger(each, state) for each in transition.triggers), ", ")
        if not name:
            # A branch of a choice is told from others by its guard.
            name, guard = ("when ", *guard) if guard else ("else",), ()
        values = said(
            guard=guard,
            effect=self._effects(transition.effects),
            target=self.state(transition.target) or ("none",),
            internal=transition.internal,
        )
        element = Element(TRANSITION, name, values, origin=transition.origin)
        return with_doc(element, transition.doc)

    def _trigger(self, trigger: Trigger, state: State) -> Value:
        match trigger:
            case EventTrigger(event=event):
                return "on ", Ref("event", event)
            case TimeTrigger(delay=delay):
                return "after ", *written(delay, self.name)
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
        return joined(map(self._effect, effects), ", ")

    def _effect(self, effect: Effect) -> Value:
        match effect:
            case Assignment(variable=variable, path=path, value=value):
                rest = "".join(f".{name}" for name in path)
                known = Ref(data_of(self.name), variable)
                return known, f"{rest} = ", *written(value, self.name)
            case Send(event=event, arguments=arguments):
                given = assigned(arguments, self.name)
                return "send ", Ref("event", event), *(("(", *given, ")") if given else ())

    def _activity(self, activity: Activity | None) -> Value:
        if activity is None:
            return ()
        made: Value = (Ref("function", activity.function),)
        if activity.goal_callback is not None:
            made = (*made, f"(by {activity.goal_callback})")
        elif activity.arguments:
            made = (*made, "(", *assigned(activity.arguments, self.name), ")")
        if activity.result_callback is not None:
            return *made, f" gives by {activity.result_callback}"
        results: list[Value] = [
            (
                f"{each.field} => ",
                Ref(data_of(self.name), each.variable),
                "".join(f".{name}" for name in each.path),
            )
            for each in activity.results
        ]
        return (*made, " gives (", *joined(results, ", "), ")") if results else made
