"""One state machine as a module: its table, and a function for each thing that it does."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from keyword import iskeyword

from swarmdsl.dataclass import dataclass
from swarmdsl.exchange.scxml.events import Events, delays
from swarmdsl.exchange.scxml.inward import inward, region_entered
from swarmdsl.ir import (
    Activity,
    Assignment,
    Binary,
    Effect,
    Expression,
    Literal,
    Named,
    Send,
    State,
    StateKind,
    StateMachine,
    System,
    Transition,
)
from swarmdsl.naming import snake_case
from swarmdsl.python_source import Call, Source, comments, layout, place
from swarmdsl.source import Span

from .expressions import DATA, EVENT, attribute, python_expression, stored
from .imports import WIDTH, Imports
from .names import fresh

STEP = "    "
_BOTH = "machine, event"
_LOGIC = ("and", "or")
_KINDS = {
    StateKind.PARALLEL: "Kind.PARALLEL",
    StateKind.FINAL: "Kind.FINAL",
}


@dataclass(frozen=True)
class Function:
    """A function of the module: `parameters`, `comments` and `body` are text."""

    name: str
    parameters: str
    comments: tuple[str, ...]
    body: tuple[str, ...]


@dataclass(frozen=True)
class Row:
    """A state in the table: comments above it, and its expression."""

    comments: tuple[str, ...]
    text: str


class Table:
    """Makes the rows of a machine and the functions that they name."""

    def __init__(self, machine: StateMachine, system: System, imports: Imports) -> None:
        self.functions: list[Function] = []
        self.callbacks: list[tuple[str, str, Span | None]] = []
        self._system = system
        self._imports = imports
        self._events = Events(machine, {state.id: state.id for state in machine.walk()})
        self._used: set[str] = set()
        around: dict[str, State] = {}
        for state in machine.walk():
            around.update((child.id, state) for child in state.states)
        self.rows = [self._row(state, around.get(state.id)) for state in machine.walk()]

    # ---- rows

    def _row(self, state: State, around: State | None) -> Row:
        self._imports.own("engine", "State")
        call = (
            self._history(state) if state.kind is StateKind.HISTORY else self._state(state, around)
        )
        return Row(comments(state.origin, state.doc), layout(call, 1, STEP, ",", WIDTH))

    def _history(self, state: State) -> Call:
        kind = Source("Kind.DEEP_HISTORY" if state.deep else "Kind.HISTORY")
        self._imports.own("engine", "Kind")
        default = self._transition_call((), _targets(state.transitions[0]), ())
        return Call("State", (state.id, kind), (("transitions", (default,)),))

    def _state(self, state: State, around: State | None) -> Call:
        transitions = [self._transition(each, state) for each in state.transitions]
        if around is not None and around.kind is StateKind.PARALLEL:
            transitions += self._inward(state, around)
        entry, leave = self._on_entry(state, around), self._on_exit(state)
        arguments: list[object] = [state.id]
        if state.kind in _KINDS:
            self._imports.own("engine", "Kind")
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
            keywords.append(("activity", self._activity(state, state.activity)))
        return Call("State", tuple(arguments), tuple(keywords))

    def _on_entry(self, state: State, around: State | None) -> list[Source]:
        found = []
        final = state.kind is StateKind.FINAL
        if final and around is not None and around.id in self._events.told_apart:
            event = self._new_event(self._events.final(state.id))
            line = f"{STEP}machine.raise_event({event})"
            found.append(self._function("tell", state.id, _BOTH, [line], state.origin))
        if state.entry:
            found.append(self._effects("enter", state.id, state.entry))
        timed = delays(state)
        if timed:
            lines = []
            for delay in timed:
                name = self._events.timer(state, delay)
                length = python_expression(delay, self._imports)
                whole = length
                if not isinstance(delay, Literal):
                    self._imports.module("math")
                    whole = f"math.ceil({length})"
                call = Call(
                    "machine.send_after", (Source(self._new_event(name)), Source(whole), name)
                )
                lines.append(layout(call, 1, STEP, width=WIDTH))
            found.append(self._function("wait", state.id, _BOTH, lines, timed[0].origin))
        return found

    def _on_exit(self, state: State) -> list[Source]:
        found = []
        timed = delays(state)
        if timed:
            lines = [
                f"{STEP}machine.cancel({self._events.timer(state, delay)!r})" for delay in timed
            ]
            found.append(self._function("stop_waiting", state.id, _BOTH, lines, timed[0].origin))
        if state.exit:
            found.append(self._effects("leave", state.id, state.exit))
        return found

    # ---- transitions

    def _transition(self, transition: Transition, state: State) -> Call:
        events = (e for t in transition.triggers for e in self._events.of_trigger(t, state))
        there = region_entered(transition, state) is not None
        return self._transition_call(
            tuple(dict.fromkeys(events)),
            () if there else _targets(transition),
            self._condition(state.id, transition.guard)
            + (() if there else self._effect_of(state.id, transition))
            + ((("internal", True),) if transition.internal and not there else ())
            + (("origin", place(transition.origin)),),
        )

    def _inward(self, region: State, around: State) -> Iterable[Call]:
        """The transitions of a parallel state that its region takes."""
        for event, guard, transition in inward(region, around, self._events):
            yield self._transition_call(
                (event,) if event else (),
                _targets(transition),
                self._condition(around.id, guard)
                + self._effect_of(around.id, transition)
                + (("internal", True), ("origin", place(transition.origin))),
            )

    def _transition_call(
        self,
        events: tuple[str, ...],
        targets: tuple[str, ...],
        keywords: tuple[tuple[str, object], ...],
    ) -> Call:
        self._imports.own("engine", "Transition")
        return Call("Transition", (events, targets), keywords)

    def _condition(self, state: str, guard: Expression | None) -> tuple[tuple[str, object], ...]:
        if guard is None:
            return ()
        lines = self._returned(guard)
        return (("guard", self._function("guard", state, _BOTH, lines, guard.origin)),)

    def _returned(self, guard: Expression) -> list[str]:
        """The statement that returns a condition, its parts on lines of their own if need be."""
        line = f"{STEP}return {python_expression(guard, self._imports)}"
        if len(line) <= WIDTH or not isinstance(guard, Binary) or guard.operator not in _LOGIC:
            return [line]
        parts: list[Expression] = []
        rest: Expression = guard
        while isinstance(rest, Binary) and rest.operator == guard.operator:
            parts.insert(0, rest.right)
            rest = rest.left
        texts = [python_expression(each, self._imports) for each in (rest, *parts)]
        operands = [
            f"({text})" if isinstance(each, Binary) and each.operator in _LOGIC else text
            for each, text in zip((rest, *parts), texts, strict=True)
        ]
        joined = [operands[0], *(f"{guard.operator} {operand}" for operand in operands[1:])]
        return [f"{STEP}return (", *(f"{STEP * 2}{each}" for each in joined), f"{STEP})"]

    def _effect_of(self, state: str, transition: Transition) -> tuple[tuple[str, object], ...]:
        if not transition.effects:
            return ()
        return (("effect", self._effects("effect", state, transition.effects)),)

    # ---- effects

    def _effects(self, what: str, state: str, effects: Sequence[Effect]) -> Source:
        lines = [line for each in effects for line in self._effect(each)]
        return self._function(what, state, _BOTH, lines, effects[0].origin)

    def _effect(self, effect: Effect) -> list[str]:
        match effect:
            case Assignment(variable=variable, path=path, value=value):
                return [self._store(variable, path, value)]
            case Send(event=name, arguments=arguments):
                type_ = self._system.event(name).type
                assert isinstance(type_, Named)
                message = self._filled(self._imports.interface(type_, "msg"), arguments)
                self._imports.own("engine", "Event")
                call = Call("machine.emit", (Call("Event", (name, message)),))
                return [layout(call, 1, STEP, width=WIDTH)]

    def _store(self, variable: str, path: tuple[str, ...], value: Expression) -> str:
        if not path:
            return f"{STEP}{DATA}.{variable} = {stored(value, self._imports)}"
        return self._put(variable, path, python_expression(value, self._imports))

    def _put(self, variable: str, path: tuple[str, ...], value: str) -> str:
        self._imports.own("values", "put")
        base = f"{DATA}.{variable}"
        for field in path[:-1]:
            base = attribute(base, field)
        call = Call("put", (Source(base), path[-1], Source(value)))
        return layout(call, 1, STEP, width=WIDTH)

    def _filled(self, type_: str, arguments: Iterable[tuple[str, Expression]]) -> Call:
        values = [(name, python_expression(value, self._imports)) for name, value in arguments]
        if not values:
            return Call(type_)
        self._imports.own("values", "filled")
        # What Python has a keyword for is no name of an argument.
        odd = [Source(f"**{{{name!r}: {value}}}") for name, value in values if iskeyword(name)]
        plain = [(name, Source(value)) for name, value in values if not iskeyword(name)]
        return Call("filled", (Call(type_), *odd), tuple(plain))

    # ---- activities

    def _activity(self, state: State, activity: Activity) -> Call:
        self._imports.own("engine", "Activity")
        self._imports.own("host", "outcomes")
        call = self._system.function(activity.function).communication
        keywords: list[tuple[str, object]] = []
        empty = (
            f"{self._imports.interface(call.type, 'action')}.Goal"
            if call.paradigm == "action"
            else f"{self._imports.interface(call.type, 'srv')}.Request"
        )
        if activity.goal_callback is not None:
            word = "goal" if call.paradigm == "action" else "request"
            value = self._by_user(activity, activity.goal_callback, word, f"{empty}()")
            keywords.append(("goal", self._goal(state, value, activity)))
        elif activity.arguments:
            goal = self._filled(empty, activity.arguments)
            keywords.append(("goal", self._goal(state, goal, activity)))
        if activity.result_callback is not None:
            word = "result" if call.paradigm == "action" else "response"
            value = self._by_user(activity, activity.result_callback, word, f"{EVENT}.data")
            line = layout(value, 1, STEP, width=WIDTH)
            keywords.append(
                ("finalize", self._function("result", state.id, _BOTH, [line], activity.origin))
            )
        elif activity.results:
            lines = []
            for result in activity.results:
                self._imports.own("values", "get")
                value_text = f"get({EVENT}.data, {result.field!r})"
                if result.path:
                    lines.append(self._put(result.variable, result.path, value_text))
                else:
                    self._imports.name("copy", "deepcopy")
                    lines.append(f"{STEP}{DATA}.{result.variable} = deepcopy({value_text})")
            keywords.append(
                ("finalize", self._function("result", state.id, _BOTH, lines, activity.origin))
            )
        arguments = (activity.function, call.name, Call("outcomes", (state.id,)))
        return Call("Activity", arguments, tuple(keywords))

    def _goal(self, state: State, value: object, activity: Activity) -> Source:
        lines = [layout(value, 1, f"{STEP}return ", width=WIDTH)]
        return self._function("goal", state.id, "machine", lines, activity.origin)

    def _by_user(self, activity: Activity, name: str, word: str, value: str) -> Call:
        self.callbacks.append((name, f"data, {word}", activity.origin))
        self._imports.name(".", "callbacks")
        self._imports.own("host", "by_user")
        return Call("by_user", (Source(f"callbacks.{name}"), Source(DATA), Source(value)))

    # ---- functions

    def _new_event(self, name: str) -> str:
        self._imports.own("engine", "Event")
        return f"Event({name!r})"

    def _function(
        self, what: str, state: str, parameters: str, lines: Iterable[str], origin: Span | None
    ) -> Source:
        name = fresh(f"{what}_{snake_case(state.replace('.', '_'))}", self._used)
        self._used.add(name)
        self.functions.append(Function(name, parameters, comments(origin), tuple(lines)))
        return Source(name)


def _targets(transition: Transition) -> tuple[str, ...]:
    return (transition.target,) if transition.target is not None else ()
