"""Strategies for state machines: nested states, and every kind of transition."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

from hypothesis import strategies as st

from swarmdsl.ir import (
    Action,
    Activity,
    Assignment,
    Docs,
    DoneTrigger,
    Effect,
    Event,
    EventTrigger,
    Expression,
    Field,
    Function,
    Interface,
    Message,
    Named,
    OutcomeTrigger,
    Param,
    ParamRef,
    ResultMapping,
    Send,
    Service,
    State,
    StateKind,
    StateMachine,
    TimeTrigger,
    Transition,
    Variable,
    VariableRef,
)
from swarmdsl.syntax.types import BOOL, DURATION, FLOAT, INT, STRING, Type

from .expressions import delay, event_leaves, expressions, literals

STATES = ["A", "B", "C", "s", "count", "steps", "x", "_1", "Done_", "goal", "min", "by"]
VARIABLES = ["a", "b", "s", "ms", "h", "min", "by", "of", "x1", "_y", "world", "trues", "E"]
PLAIN = [BOOL, STRING, DURATION, INT, FLOAT]

SIMPLE, FINAL, CHOICE, HISTORY = (
    StateKind.SIMPLE,
    StateKind.FINAL,
    StateKind.CHOICE,
    StateKind.HISTORY,
)
COMPOSITE, PARALLEL, REGION = StateKind.COMPOSITE, StateKind.PARALLEL, StateKind.REGION


@dataclass
class World:
    """Declarations that a machine can use."""

    interfaces: dict[Named, Interface]
    events: list[Event]
    functions: list[Function]
    docs: st.SearchStrategy[str]
    types: list[Type]
    callbacks: dict[str, str] = field(default_factory=dict)


@dataclass
class Data:
    """Data that a machine can read and write."""

    leaves: list[Expression]
    variables: list[Variable]


def machines(draw: st.DrawFn, name: str, world: World) -> StateMachine:
    names = list(draw(st.permutations(VARIABLES)))
    params = [
        Param(names.pop(), type_, draw(st.none() | literals(type_)), draw(world.docs))
        for type_ in draw(st.lists(st.sampled_from(PLAIN), max_size=2))
    ]
    variables = [
        Variable(
            names.pop(),
            type_,
            draw(st.none() | literals(type_)) if type_ in PLAIN else None,
            draw(world.docs),
        )
        for type_ in draw(st.lists(st.sampled_from([*PLAIN, *world.types]), max_size=4))
    ]
    data = Data(
        [ParamRef(each.name, each.type) for each in params]
        + [VariableRef(each.name, each.type) for each in variables],
        variables,
    )
    states = _skeleton(draw, "", 2, world.docs)
    first = draw(st.sampled_from([each for each in states if _enterable(each)]))
    states = tuple(_Filler(draw, world, data, states).filled(state, ()) for state in states)
    ends = any(state.kind is FINAL for state in states)
    return StateMachine(
        name,
        first.id,
        states,
        tuple(variables),
        tuple(params),
        endless=not ends or draw(st.booleans()),
        doc=draw(world.docs),
        docs=docs_of(draw, world.docs, "initial"),
    )


def docs_of(draw: st.DrawFn, docs: st.SearchStrategy[str], *names: str) -> Docs:
    """Return documentation of lines without nodes."""
    drawn = [(name, draw(docs)) for name in sorted(names)]
    return tuple((name, doc) for name, doc in drawn if doc)


def _skeleton(
    draw: st.DrawFn, prefix: str, depth: int, docs: st.SearchStrategy[str]
) -> tuple[State, ...]:
    """Return states without transitions; the first can be entered."""
    kinds = [SIMPLE, FINAL, FINAL, CHOICE]
    if depth:
        kinds += [COMPOSITE, PARALLEL, PARALLEL]
    if prefix:
        kinds.append(HISTORY)
    names = draw(st.permutations(STATES))
    chosen = [SIMPLE, *draw(st.lists(st.sampled_from(kinds), max_size=3))]
    states = []
    for name, kind in zip(names, chosen, strict=False):
        path = f"{prefix}.{name}" if prefix else name
        state = State(path, name, kind, doc=draw(docs))
        if kind is COMPOSITE:
            state = _with_content(draw, state, depth, docs)
        elif kind is PARALLEL:
            parts = draw(st.permutations(STATES))[: draw(st.integers(1, 2))]
            regions = (
                State(f"{path}.{part}", part, REGION, doc=draw(docs)) for part in sorted(parts)
            )
            state = replace(
                state,
                states=tuple(_with_content(draw, region, depth, docs) for region in regions),
            )
        elif kind is HISTORY:
            target = f"{prefix}.{names[0]}"
            resume = Transition((), None, (), target)
            state = replace(state, deep=draw(st.booleans()), transitions=(resume,))
        states.append(state)
    return tuple(draw(st.permutations(states)))


def _with_content(draw: st.DrawFn, state: State, depth: int, docs: st.SearchStrategy[str]) -> State:
    states = _skeleton(draw, state.id, depth - 1, docs)
    first = draw(st.sampled_from([each for each in states if _enterable(each)]))
    return replace(state, states=states, initial=first.id, docs=docs_of(draw, docs, "initial"))


def _enterable(state: State) -> bool:
    return state.kind in (SIMPLE, COMPOSITE, PARALLEL)


def _content(state: State) -> Sequence[State]:
    if state.kind is PARALLEL:
        return [inner for region in state.states for inner in region.states]
    return state.states


def _below(state: State) -> Iterator[State]:
    """Return the targets of a path that begins with the name of a state."""
    yield state
    content = _content(state)
    names = [inner.name for inner in content]
    for inner in content:
        if names.count(inner.name) == 1:
            yield from _below(inner)


@dataclass
class _Filler:
    """Fill states with activities, effects and transitions."""

    draw: st.DrawFn
    world: World
    data: Data
    top: tuple[State, ...]

    def filled(self, state: State, around: tuple[State, ...]) -> State:
        inner = tuple(self.filled(each, (*around, state)) for each in state.states)
        if state.kind in (FINAL, HISTORY, REGION):
            return replace(state, states=inner)
        targets = self._targets(state, around)
        if state.kind is CHOICE:
            quiet = [each for each in targets if self._quiet(each)]
            if quiet:
                return replace(state, transitions=self._branches(quiet))
            state = replace(state, kind=SIMPLE)
        activity = self._activity() if state.kind is SIMPLE else None
        transitions = [
            self._transition(state, targets, activity) for _ in range(self.draw(st.integers(0, 2)))
        ]
        if activity is not None:
            transitions += [
                Transition(
                    (OutcomeTrigger(state.id, each),),
                    None,
                    (),
                    self._one(targets).id,
                    doc=self.draw(self.world.docs),
                )
                for each in ("succeeded", "aborted")
            ]
        effects = {word: self._effects(self.data.leaves) for word in ("entry", "exit")}
        documented = [word for word, each in effects.items() if each]
        docs = {*state.docs, *docs_of(self.draw, self.world.docs, *documented)}
        return replace(
            state,
            states=inner,
            activity=activity,
            **effects,
            transitions=tuple(transitions),
            docs=tuple(sorted(docs)),
        )

    def _one(self, targets: Sequence[State]) -> State:
        return self.draw(st.sampled_from(targets))

    def _quiet(self, state: State) -> bool:
        """Return True if the state is not left at once, whatever its content."""
        return state.kind is FINAL

    def _targets(self, state: State, around: tuple[State, ...]) -> list[State]:
        """Return the states that a transition can name, nearer ones before hidden ones."""
        levels: list[Sequence[State]] = [self.top]
        for each in around:
            if each.kind is not PARALLEL:
                levels.insert(0, _content(each))
        found: dict[str, list[State]] = {}
        for level in levels:
            for each in level:
                found.setdefault(each.name, list(_below(each)))
        return [
            target
            for targets in found.values()
            for target in targets
            if self._same_region(target, around)
        ]

    @staticmethod
    def _same_region(target: State, around: tuple[State, ...]) -> bool:
        """Return True if no enclosing parallel state separates the target."""
        return all(
            target.id.startswith(f"{region.id}.")
            for outer, region in pairwise(around)
            if outer.kind is PARALLEL and target.id.startswith(f"{outer.id}.")
        )

    def _branches(self, targets: list[State]) -> tuple[Transition, ...]:
        guards = [self._guard(self.data.leaves) for _ in range(self.draw(st.integers(0, 2)))]
        return tuple(
            Transition(
                (),
                guard,
                self._effects(self.data.leaves),
                self._one(targets).id,
                doc=self.draw(self.world.docs),
            )
            for guard in [*guards, None]
        )

    def _guard(self, leaves: Sequence[Expression]) -> Expression | None:
        return expressions(self.draw, BOOL, leaves)

    def _transition(
        self, state: State, targets: list[State], activity: Activity | None
    ) -> Transition:
        leaves = self.data.leaves
        kinds = ["event", "events", "time"]
        ends = self._ends(state)
        if activity is not None:
            kinds.append("outcome")
        elif ends:
            kinds += ["done"] * 3
        quiet = [each for each in targets if self._quiet(each)]
        if quiet:
            kinds += ["eventless", "at once"] if state.kind is SIMPLE else ["eventless"]
        kind = self.draw(st.sampled_from(kinds))
        target: State | None = self._one(targets)
        guard = self.draw(st.booleans())
        match kind:
            case "event":
                event = self.draw(st.sampled_from(self.world.events))
                known = self.world.interfaces.get(event.type)
                if isinstance(known, Message):
                    fields = [(each.name, each.type) for each in known.fields]
                    leaves = [*leaves, *event_leaves(known.type, fields)]
                triggers: tuple = (EventTrigger(event.name),)
            case "events":
                events = self.draw(st.permutations(self.world.events))[:2]
                triggers = tuple(EventTrigger(each.name) for each in events)
            case "time":
                delays = [delay(self.draw, leaves) for _ in range(self.draw(st.integers(1, 2)))]
                triggers = tuple(map(TimeTrigger, delays))
            case "outcome":
                triggers = (OutcomeTrigger(state.id, "preempted"),)
            case "done":
                triggers = (self.draw(st.sampled_from(ends)),)
            case "eventless":
                triggers, target, guard = (), self._one(quiet), True
            case "at once":
                if activity is not None:
                    triggers, target, guard = (), self._one(quiet), True
                else:
                    triggers, target = (), self._one(quiet)
        effects = self._effects(leaves)
        if effects and triggers and self.draw(st.integers(0, 3)) == 0:
            target = None
        inside = [each for each in targets if each.id.startswith(f"{state.id}.")]
        internal = bool(triggers and inside) and self.draw(st.booleans())
        if internal:
            target = self._one(inside)
        return Transition(
            triggers,
            self._guard(leaves) if guard else None,
            effects,
            target.id if target is not None else None,
            internal,
            self.draw(self.world.docs),
        )

    def _ends(self, state: State) -> list[DoneTrigger]:
        """Return the ways in which a state can be done."""
        containers = state.states if state.kind is PARALLEL else [state]
        found = []
        complete = bool(containers)
        for container in containers:
            finals = [each for each in container.states if each.kind is FINAL]
            complete = complete and bool(finals)
            if finals and container is not state:
                found.append(DoneTrigger(container.id, None))
            found += [DoneTrigger(container.id, each.id) for each in finals]
        return [DoneTrigger(state.id, None), *found] if complete else found

    def _effects(self, leaves: Sequence[Expression]) -> tuple[Effect, ...]:
        found: list[Effect] = []
        for _ in range(self.draw(st.sampled_from([0, 0, 1, 2]))):
            if self.data.variables and self.draw(st.booleans()):
                variable = self.draw(st.sampled_from(self.data.variables))
                path, type_ = self._place(variable.type)
                value = expressions(self.draw, type_, leaves)
                if value is not None:
                    found.append(Assignment(variable.name, path, value))
            elif self.world.events:
                event = self.draw(st.sampled_from(self.world.events))
                known = self.world.interfaces.get(event.type)
                fields = known.fields if isinstance(known, Message) else ()
                found.append(Send(event.name, self._arguments(fields, leaves, some=True)))
        return tuple(found)

    def _place(self, type_: Type) -> tuple[tuple[str, ...], Type]:
        """Return a field of a variable, or the variable itself."""
        known = self.world.interfaces.get(type_) if isinstance(type_, Named) else None
        if isinstance(known, Message) and known.fields and self.draw(st.booleans()):
            chosen = self.draw(st.sampled_from(known.fields))
            return (chosen.name,), chosen.type
        return (), type_

    def _arguments(
        self, fields: Sequence[Field], leaves: Sequence[Expression], *, some: bool
    ) -> tuple[tuple[str, Expression], ...]:
        chosen = [each for each in fields if not some or self.draw(st.booleans())]
        values = [(each.name, expressions(self.draw, each.type, leaves)) for each in chosen]
        return tuple((name, value) for name, value in values if value is not None)

    def _activity(self) -> Activity | None:
        if not self.world.functions or self.draw(st.booleans()):
            return None
        function = self.draw(st.sampled_from(self.world.functions))
        known = self.world.interfaces.get(function.communication.type)
        sent: Sequence[Field] = ()
        received: Sequence[Field] = ()
        match known:
            case Action():
                sent, received = known.goal, known.result
            case Service():
                sent, received = known.request, known.response
        arguments = self._arguments(sent, self.data.leaves, some=False)
        by = None
        if len(arguments) < len(sent) or self.draw(st.integers(0, 3)) == 0:
            arguments, by = (), f"fill_{function.name}"
        results = tuple(
            ResultMapping(each.name, variable.name, ())
            for each in received
            for variable in [v for v in self.data.variables if v.type == each.type][:1]
        )
        gives = None
        if not results and self.draw(st.booleans()):
            gives = f"store_{function.name}"
        doc = self.draw(self.world.docs)
        return Activity(function.name, arguments, by, results, gives, doc)
