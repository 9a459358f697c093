"""From a state machine to SMACH containers: a state of the model is a state of SMACH.

Its transitions are outcomes, bound to the label of the state that comes next. One that leads out
of the state around it is an outcome of that too.
"""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.codegen import fresh
from swarmdsl.codegen.python import Call, Source, comments, layout
from swarmdsl.ir import State, StateKind, doc_of

from .activities import activity_call
from .module import PREEMPTED, Container, Entry, Module
from .statements import STEP, effect_lines
from .transitions import TransitionMaker, Transitions
from .ways import Scope, Way, way_into

Keywords = list[tuple[str, object]]
Inside = tuple[Call, Mapping[str, Way]]
"""The call that builds a container, and the ways that lead out of it."""


def build(module: Module) -> None:
    """Fill the module with the functions that build its machine, the first being `build`."""
    _Structure(module).machine()


class _Structure:
    def __init__(self, module: Module) -> None:
        self.module = module
        self.maker = TransitionMaker(module)

    def machine(self) -> None:
        """The whole machine."""
        machine = self.module.machine
        scope = Scope("", {state.name for state in machine.states})
        finals = [state.name for state in machine.states if state.kind is StateKind.FINAL]
        if machine.initial in finals:
            self.module.unsupported(
                "an initial state that is final",
                machine.origin,
                "a machine that ends as soon as it begins needs no node",
            )
        slot = self.module.reserve()
        for state in machine.states:
            if state.kind is not StateKind.FINAL:
                self._add_state(scope, state)
        call = Call(
            self.module.own("containers", "Machine"),
            (finals, Source("userdata")),
            tuple(_initial(machine.initial, scope)),
        )
        self._finish(slot, scope, "build", f"Build state machine {machine.name}.", "machine", call)

    # ---- containers

    def _composite(self, state: State, told: Transitions, further: list[str]) -> Inside:
        """The StateMachine that a composite state or a region is."""
        assert state.initial is not None
        slot = self.module.reserve()
        function = self.module.function_name(state.id)
        taken = {*(each.name for each in state.states), *told.ways, *further}
        internal = {outcome: way.label for outcome, way in told.internal.items()}
        scope = Scope(state.id, taken, internal=internal)
        for child in state.states:
            self._add_state(scope, child)
        keywords = self._told(state, told, [*scope.exits, *further])
        keywords += _initial(state.initial, scope)
        call = Call(self.module.own("containers", "StateMachine"), (), tuple(keywords))
        what = "region" if state.kind is StateKind.REGION else "state"
        self._finish(slot, scope, function, f"Build {what} {state.id}.", "machine", call)
        return Call(function), scope.exits

    def _parallel(self, state: State, told: Transitions, further: list[str]) -> Inside:
        """The Concurrence that a parallel state is."""
        slot = self.module.reserve()
        function = self.module.function_name(state.id)
        scope = Scope(state.id, set())
        ways: dict[str, Way] = {}
        outcome_map: dict[str, dict[str, str]] = {}
        for region in state.states:
            told_of_region = self.maker.of(region, ())
            call, exits = self._composite(region, told_of_region, [])
            for outcome, way in exits.items():
                name = fresh(outcome, {*ways, *told.ways, *further, PREEMPTED})
                ways[name] = way
                outcome_map[name] = {region.name: outcome}
            add = Call("Concurrence.add", (region.name, call))
            said = (*_comments(region), *told_of_region.said)
            scope.entries.append(Entry(region.name, layout(add, 2, STEP * 2), said))
        keywords = self._told(state, told, further)
        keywords += [("outcome_map", outcome_map)] if outcome_map else []
        call = Call(self.module.own("containers", "Concurrence"), (), tuple(keywords))
        doc = f"Build the regions of state {state.id}."
        self._finish(slot, scope, function, doc, "concurrence", call)
        return Call(function), ways

    def _finish(
        self, slot: int, scope: Scope, function: str, doc: str, variable: str, call: Call
    ) -> None:
        self.module.containers[slot] = Container(
            function=function,
            doc=doc,
            variable=variable,
            construction=layout(call, 1, f"{STEP}{variable} = "),
            entries=tuple(scope.entries),
        )

    # ---- states

    def _add_state(self, scope: Scope, state: State) -> None:
        """A state in a StateMachine, with where its outcomes lead."""
        if state.kind is StateKind.HISTORY:
            siblings = self.maker.ways.around(state).states
            labels = [each.name for each in siblings if each.kind is not StateKind.HISTORY]
            call = self._history(state, scope, labels)
            self._add(scope, state, call, {label: label for label in labels}, ())
            return
        told = self.maker.of(state, scope.internal)
        further = [*scope.internal]
        if state.kind is StateKind.PARALLEL:
            call, exits = self._parallel(state, told, further)
        elif state.kind is StateKind.COMPOSITE:
            call, exits = self._composite(state, told, further)
        else:
            call, exits = self._simple(state, told, further), {}
        ways = {**exits, **told.ways}
        bound = {outcome: scope.bound(way) for outcome, way in ways.items()}
        self._add(scope, state, call, {**bound, **scope.internal}, told.said)

    def _simple(self, state: State, told: Transitions, further: list[str]) -> Call:
        keywords = tuple(self._told(state, told, further))
        if state.activity is not None:
            return activity_call(state, keywords, self.module)
        name = "Final" if state.kind is StateKind.FINAL else "State"
        return Call(self.module.own("states", name), (), keywords)

    def _history(self, state: State, scope: Scope, labels: list[str]) -> Call:
        default = state.transitions[0].target
        assert default is not None
        way = way_into(scope.owner, default)
        path = ".".join(filter(None, (way.label, way.into)))
        keywords: Keywords = [("deep", True)] if state.deep else []
        return Call(self.module.own("states", "History"), (path, labels), tuple(keywords))

    def _told(self, state: State, told: Transitions, outcomes: list[str]) -> Keywords:
        """What a state is told besides what it does."""
        keywords: Keywords = []
        if told.on:
            keywords.append(("on", [*told.on]))
        if outcomes:
            keywords.append(("outcomes", outcomes))
        if told.after:
            keywords.append(("after", dict(told.after)))
        for word, effects in (("entry", state.entry), ("exit", state.exit)):
            if effects:
                lines = effect_lines(effects, 1, self.module)
                said = comments(effects[0].origin, doc_of(state.docs, word))
                name = self.module.add_function((state.id, word), "userdata", lines, said)
                keywords.append((f"on_{word}", Source(name)))
        return keywords

    def _add(
        self,
        scope: Scope,
        state: State,
        call: Call,
        bound: Mapping[str, str],
        said: tuple[str, ...],
    ) -> None:
        transitions = {**bound, PREEMPTED: PREEMPTED}
        class_ = self.module.own("containers", "StateMachine")
        add = Call(f"{class_}.add", (state.name, call), (("transitions", transitions),))
        entry = Entry(state.name, layout(add, 2, STEP * 2), (*_comments(state), *said))
        scope.entries.append(entry)


def _initial(initial: str, scope: Scope) -> Keywords:
    """Which state is entered first, where that is not the one that is added first."""
    path = initial[len(scope.owner) + 1 :] if scope.owner else initial
    first = scope.entries[0].label if scope.entries else None
    return [("initial", path)] if path != first else []


def _comments(state: State) -> tuple[str, ...]:
    """Where a state stands in the model, and what is said of it and of its activity there."""
    does = state.activity
    activity = comments(does.origin, does.doc) if does is not None and does.doc else ()
    return (*comments(state.origin, state.doc), *activity)
