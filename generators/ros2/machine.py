"""Table of a state machine: a row for each state, with its transitions."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.codegen import dataclass
from swarmdsl.codegen.python import Call, Source, comments, layout, source_place
from swarmdsl.codegen.shared import (
    Events,
    delays,
    entered_region,
    region_transitions,
    timed_states,
)
from swarmdsl.ir import (
    Binary,
    Expression,
    State,
    StateKind,
    StateMachine,
    Transition,
)

from .activities import activity_of
from .effects import effects_of, whole_delay
from .expressions import python_expression
from .imports import WIDTH
from .module import BOTH, STEP, Module

_LOGIC = ("and", "or")
_KINDS = {
    StateKind.PARALLEL: "Kind.PARALLEL",
    StateKind.FINAL: "Kind.FINAL",
}


@dataclass(frozen=True)
class Row:
    """A state in the table: its expression, and the comments above it."""

    comments: tuple[str, ...]
    text: str


class Table:
    """Makes the rows of a machine, and adds the functions that they use to its module."""

    def __init__(self, machine: StateMachine, module: Module) -> None:
        self._module = module
        self._events = Events(machine, {state.id: state.id for state in machine.walk()})
        self._timed = timed_states(machine)
        around: dict[str, State] = {}
        for state in machine.walk():
            around.update((child.id, state) for child in state.states)
        self.rows = [self._row(state, around.get(state.id)) for state in machine.walk()]

    # ---- rows

    def _row(self, state: State, around: State | None) -> Row:
        self._module.imports.own("engine", "State")
        call = (
            self._history(state) if state.kind is StateKind.HISTORY else self._state(state, around)
        )
        return Row(comments(state.origin, state.doc), layout(call, 1, STEP, ",", WIDTH))

    def _history(self, state: State) -> Call:
        kind = Source("Kind.DEEP_HISTORY" if state.deep else "Kind.HISTORY")
        self._module.imports.own("engine", "Kind")
        default = self._transition_call((), _targets(state.transitions[0]), ())
        return Call("State", (state.id, kind), (("transitions", (default,)),))

    def _state(self, state: State, around: State | None) -> Call:
        transitions = [self._transition(each, state) for each in state.transitions]
        if around is not None and around.kind is StateKind.PARALLEL:
            transitions += self._inward(state, around)
        entry, leave = self._on_entry(state, around), self._on_exit(state)
        arguments: list[object] = [state.id]
        if state.kind in _KINDS:
            self._module.imports.own("engine", "Kind")
            arguments.append(Source(_KINDS[state.kind]))
        keywords: list[tuple[str, object]] = []
        if state.initial is not None:
            keywords.append(("initial", (state.initial,)))
        if transitions:
            keywords.append(("transitions", tuple(transitions)))
        if entry:
            keywords.append(("entry", tuple(entry)))
        if leave:
            keywords.append(("exit", tuple(leave)))
        if state.activity is not None:
            keywords.append(("activity", activity_of(state, state.activity, self._module)))
        if state.deferred:
            keywords.append(("deferred", tuple(trigger.event for trigger in state.deferred)))
        if state.id in self._timed:
            keywords.append(("timed", True))
        return Call("State", tuple(arguments), tuple(keywords))

    def _on_entry(self, state: State, around: State | None) -> list[Source]:
        found = []
        final = state.kind is StateKind.FINAL
        if final and around is not None and around.id in self._events.by_final_state:
            event = self._module.new_event(self._events.final(state.id))
            line = f"{STEP}machine.raise_event({event})"
            found.append(self._module.function("tell", state.id, BOTH, [line], state.origin))
        if state.entry:
            found.append(effects_of("enter", state.id, state.entry, self._module))
        timed = delays(state)
        if timed:
            lines = []
            for delay in timed:
                name = self._events.timer(state, delay)
                whole = whole_delay(delay, self._module)
                call = Call(
                    "machine.send_after",
                    (Source(self._module.new_event(name)), Source(whole), name),
                )
                lines.append(layout(call, 1, STEP, width=WIDTH))
            found.append(self._module.function("wait", state.id, BOTH, lines, timed[0].origin))
        return found

    def _on_exit(self, state: State) -> list[Source]:
        found = []
        timed = delays(state)
        if timed:
            lines = [
                f"{STEP}machine.cancel({self._events.timer(state, delay)!r})" for delay in timed
            ]
            found.append(
                self._module.function("stop_waiting", state.id, BOTH, lines, timed[0].origin)
            )
        if state.exit:
            found.append(effects_of("leave", state.id, state.exit, self._module))
        return found

    # ---- transitions

    def _transition(self, transition: Transition, state: State) -> Call:
        events = (e for t in transition.triggers for e in self._events.of_trigger(t, state))
        there = entered_region(transition, state) is not None
        return self._transition_call(
            tuple(dict.fromkeys(events)),
            () if there else _targets(transition),
            self._condition(state.id, transition.guard)
            + (() if there else self._effect_of(state.id, transition))
            + ((("internal", True),) if transition.internal and not there else ())
            + (("origin", source_place(transition.origin)),),
        )

    def _inward(self, region: State, around: State) -> Iterable[Call]:
        """Yield the internal transitions of a parallel state that its region takes."""
        for event, guard, transition, number in region_transitions(region, around, self._events):
            yield self._transition_call(
                (event,) if event else (),
                _targets(transition),
                self._condition(around.id, guard)
                + self._effect_of(around.id, transition)
                + (
                    ("internal", True),
                    ("origin", source_place(transition.origin)),
                    ("around", number),
                ),
            )

    def _transition_call(
        self,
        events: tuple[str, ...],
        targets: tuple[str, ...],
        keywords: tuple[tuple[str, object], ...],
    ) -> Call:
        self._module.imports.own("engine", "Transition")
        return Call("Transition", (events, targets), keywords)

    def _condition(self, state: str, guard: Expression | None) -> tuple[tuple[str, object], ...]:
        if guard is None:
            return ()
        lines = self._returned(guard)
        return (("guard", self._module.function("guard", state, BOTH, lines, guard.origin)),)

    def _returned(self, guard: Expression) -> list[str]:
        """Return the `return` statement of a condition, split into lines if it is too long."""
        line = f"{STEP}return {python_expression(guard, self._module.imports)}"
        if len(line) <= WIDTH or not isinstance(guard, Binary) or guard.operator not in _LOGIC:
            return [line]
        parts: list[Expression] = []
        rest: Expression = guard
        while isinstance(rest, Binary) and rest.operator == guard.operator:
            parts.insert(0, rest.right)
            rest = rest.left
        texts = [python_expression(each, self._module.imports) for each in (rest, *parts)]
        operands = [
            f"({text})" if isinstance(each, Binary) and each.operator in _LOGIC else text
            for each, text in zip((rest, *parts), texts, strict=True)
        ]
        joined = [operands[0], *(f"{guard.operator} {operand}" for operand in operands[1:])]
        return [f"{STEP}return (", *(f"{STEP * 2}{each}" for each in joined), f"{STEP})"]

    def _effect_of(self, state: str, transition: Transition) -> tuple[tuple[str, object], ...]:
        if not transition.effects:
            return ()
        return (("effect", effects_of("effect", state, transition.effects, self._module)),)


def _targets(transition: Transition) -> tuple[str, ...]:
    return (transition.target,) if transition.target is not None else ()
