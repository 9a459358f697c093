"""Print state machines."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from swarmdsl.base.records import dataclass, replace
from swarmdsl.codegen.swarm_printer.actions import activity_text, arguments, effect_text
from swarmdsl.codegen.swarm_printer.expressions import default, delay, expression
from swarmdsl.codegen.swarm_printer.interfaces import print_params
from swarmdsl.codegen.swarm_printer.layout import UnprintableError, block, documented
from swarmdsl.codegen.swarm_printer.names import Names
from swarmdsl.codegen.swarm_printer.paths import Level, Place, level, top, with_tested_paths
from swarmdsl.codegen.swarm_printer.reuse import Reuse
from swarmdsl.ir import (
    DoneTrigger,
    Effect,
    EventTrigger,
    OutcomeTrigger,
    State,
    StateKind,
    StateMachine,
    TimeTrigger,
    Transition,
    Trigger,
    Variable,
    doc_of,
)


def print_machine(machine: StateMachine, reuse: Reuse, names: Names) -> list[str]:
    """Print a machine; states that reuse another one name it."""
    place = top(machine)
    endless = "endless " if machine.endless else ""
    printer = _Printer(reuse, names)
    return documented(
        machine.doc,
        block(
            f"{endless}statemachine {machine.name}",
            [
                *print_params(machine.params, names),
                *(line for each in reuse.variables for line in _variable(each, names)),
            ],
            _initial(machine, place.path(machine.initial, place.outer)),
            printer.states(machine.states, place),
        ),
    )


def _initial(owner: StateMachine | State, name: str) -> list[str]:
    return documented(doc_of(owner.docs, "initial"), [f"initial {name}"])


def _variable(variable: Variable, names: Names) -> list[str]:
    line = f"var {variable.name} : {names.type(variable.type)}{default(variable.initial)}"
    return documented(variable.doc, [line])


@dataclass(frozen=True)
class _Printer:
    """Printer of the states of one machine."""

    reuse: Reuse
    names: Names

    def states(
        self, states: Iterable[State], place: Place, initial: str | None = None
    ) -> list[str]:
        """Return states in one container, in which `initial` is the id of the initial state."""
        return [
            line
            for state in states
            for line in documented(state.doc, self._state(state, place, initial))
        ]

    def _state(self, state: State, place: Place, initial: str | None) -> list[str]:
        state = with_tested_paths(state, place)
        match state.kind:
            case StateKind.FINAL:
                return [f"final {state.name}"]
            case StateKind.HISTORY:
                deep = "deep " if state.deep else ""
                (resume,) = state.transitions
                assert resume.target is not None
                if resume.target == initial:
                    return [f"{deep}history {state.name}"]
                target = place.path(resume.target, place.outer[:1])
                return [f"{deep}history {state.name} -> {target}"]
            case StateKind.CHOICE:
                branches = [
                    line
                    for each in state.transitions
                    for line in documented(each.doc, [_branch(each, place)])
                ]
                return block(f"choice {state.name}", branches)
            case StateKind.REGION:
                return block(f"region {state.name}", *self._content(state, place))
            case StateKind.PARALLEL:
                regions = self.states(state.states, place.inside(state))
                return block(
                    f"parallel state {state.name}",
                    self._own(state),
                    regions,
                    self._transitions(state, place),
                )
        transitions = self._transitions(state, place)
        if state.submachine is not None:
            head = f"state {state.name} = {state.submachine}"
            use = self.reuse.uses[state.id]
            if use.bindings:
                head += f"({arguments(use.bindings)})"
            lines = [*self._own(replace(state, entry=use.entry)), *transitions]
            return block(head, lines) if lines else [head]
        if state.kind is StateKind.COMPOSITE:
            content = self._content(state, place)
            return block(f"state {state.name}", self._own(state), *content, transitions)
        return block(f"state {state.name}", [*self._own(state), *transitions])

    def _content(self, state: State, place: Place) -> tuple[list[str], list[str]]:
        """Return the initial state and the states of a composite state or region."""
        assert state.initial is not None
        initial = place.path(state.initial, (level(state),))
        inside = self.states(state.states, place.inside(state), state.initial)
        return _initial(state, initial), inside

    def _own(self, state: State) -> list[str]:
        """Return the activity, the deferred events and the effects on entry and exit."""
        lines = []
        if state.activity is not None:
            function = self.names.function(state.activity.function)
            text = f"do {activity_text(state.activity, function)}"
            lines += documented(state.activity.doc, [text])
        if state.deferred:
            events = ", ".join(trigger.event for trigger in state.deferred)
            lines += documented(doc_of(state.docs, "defer"), [f"defer {events}"])
        for word, effects in (("entry", state.entry), ("exit", state.exit)):
            if effects:
                lines += documented(doc_of(state.docs, word), [f"{word} / {_effects(effects)}"])
        return lines

    def _transitions(self, state: State, place: Place) -> list[str]:
        levels = place.from_state(state)
        regions = {each.id: each for each in state.states if each.kind is StateKind.REGION}
        lines: list[str] = []
        before: Transition | None = None
        for each in state.transitions:
            line = _transition(each, state, regions, place, levels)
            if line.startswith("[") and _stays(before):
                lines[-1] += ";"  # else the guard would belong to the outcome
            lines += documented(each.doc, [line])
            before = each
        return lines


def _stays(transition: Transition | None) -> bool:
    """Return True for a transition that only handles outcomes."""
    return transition is not None and transition.target is None and not transition.effects


def _transition(
    transition: Transition,
    state: State,
    regions: Mapping[str, State],
    place: Place,
    levels: tuple[Level, ...],
) -> str:
    guard, effects, target = transition.guard, transition.effects, transition.target
    parts = ["internal"] if transition.internal else []
    if transition.triggers:
        parts.append(_triggers(transition.triggers, state, regions))
    elif guard is None or target is None:
        # A state without activity and content is complete at once.
        if state.kind is not StateKind.SIMPLE or state.activity is not None:
            raise UnprintableError(f"a transition of `{state.id}` waits for nothing")
        parts.append("on done")
    if guard is not None:
        parts.append(f"[{expression(guard)}]")
    if effects:
        parts.append(f"/ {_effects(effects)}")
    elif target is None and not _handles_outcomes(transition):
        raise UnprintableError(f"a transition of `{state.id}` has no effect")
    if target is not None:
        parts.append(f"-> {place.path(target, levels)}")
    return " ".join(parts)


def _handles_outcomes(transition: Transition) -> bool:
    """Return True if a transition can stand without effects and target."""
    triggers = transition.triggers
    return transition.guard is None and all(isinstance(each, OutcomeTrigger) for each in triggers)


def _branch(branch: Transition, place: Place) -> str:
    assert branch.target is not None
    parts = ["else" if branch.guard is None else f"[{expression(branch.guard)}]"]
    if branch.effects:
        parts.append(f"/ {_effects(branch.effects)}")
    return " ".join([*parts, f"-> {place.path(branch.target, place.from_choice())}"])


def _triggers(triggers: tuple[Trigger, ...], state: State, regions: Mapping[str, State]) -> str:
    timed = [trigger for trigger in triggers if isinstance(trigger, TimeTrigger)]
    if not timed:
        return "on " + ", ".join(_trigger(trigger, state, regions) for trigger in triggers)
    if len(timed) < len(triggers):
        raise UnprintableError(f"a transition of `{state.id}` waits for a time and for more")
    return ", ".join(f"after {delay(trigger.delay)}" for trigger in timed)


def _trigger(trigger: Trigger, owner: State, regions: Mapping[str, State]) -> str:
    match trigger:
        case EventTrigger(event=event):
            return event
        case OutcomeTrigger(state=owner.id, outcome=outcome):
            return outcome
        case DoneTrigger(state=state, final=final):
            region = regions.get(state)
            if state == owner.id or region is not None:
                done = "done" if region is None else f"{region.name}.done"
                return done if final is None else f"{done}.{final.removeprefix(f'{state}.')}"
    raise UnprintableError(f"a transition of `{owner.id}` waits for another state")


def _effects(effects: tuple[Effect, ...]) -> str:
    return ", ".join(map(effect_text, effects))
