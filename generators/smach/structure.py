"""Lower a state machine to SMACH containers: each state of the model is a state in SMACH.

Its transitions become outcomes, which are bound to the label of the next state. An outcome that
leaves the state around is an outcome of that state too.
"""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.codegen import FreshNames
from swarmdsl.codegen.python import Call, Source, comments, layout
from swarmdsl.ir import State, StateKind, doc_of

from ..outcome_routes import Target, target_in
from .activities import activity_call
from .module import PREEMPTED, Container, Entry, Module
from .outcomes import ContainerOutcomes
from .statements import STEP, effect_lines
from .transitions import TransitionMaker, Transitions

Keywords = list[tuple[str, object]]
Inside = tuple[Call, Mapping[str, Target]]
"""The call that builds a container, and the outcomes that leave it."""


def build(module: Module) -> None:
    """Fill the module with the functions that build its machine, the first being `build`."""
    _Structure(module).machine()


class _Structure:
    def __init__(self, module: Module) -> None:
        self.module = module
        self.maker = TransitionMaker(module)

    def machine(self) -> None:
        """Add the function that builds the machine."""
        machine = self.module.machine
        scope = ContainerOutcomes("", {state.name for state in machine.states})
        finals = [state.name for state in machine.states if state.kind is StateKind.FINAL]
        if machine.initial in finals:
            self.module.unsupported(
                "an initial state that is final",
                machine.origin,
                "start in a state that is not final, or remove the machine",
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

    def _composite(self, state: State, transitions: Transitions, further: list[str]) -> Inside:
        """Add the StateMachine of a composite state or a region."""
        assert state.initial is not None
        slot = self.module.reserve()
        function = self.module.function_name(state.id)
        taken = {*(each.name for each in state.states), *transitions.targets, *further}
        internal = {outcome: target.label for outcome, target in transitions.internal.items()}
        scope = ContainerOutcomes(state.id, taken, internal=internal)
        for child in state.states:
            self._add_state(scope, child)
        keywords = self._keywords(state, transitions, [*scope.exits, *further])
        keywords += _initial(state.initial, scope)
        call = Call(self.module.own("containers", "StateMachine"), (), tuple(keywords))
        kind = "region" if state.kind is StateKind.REGION else "state"
        self._finish(slot, scope, function, f"Build {kind} {state.id}.", "machine", call)
        return Call(function), scope.exits

    def _parallel(self, state: State, transitions: Transitions, further: list[str]) -> Inside:
        """Add the Concurrence of a parallel state."""
        slot = self.module.reserve()
        function = self.module.function_name(state.id)
        scope = ContainerOutcomes(state.id, set())
        targets: dict[str, Target] = {}
        names = FreshNames([*transitions.targets, *further, PREEMPTED])
        outcome_map: dict[str, dict[str, str]] = {}
        for region in state.states:
            region_transitions = self.maker.of(region, ())
            call, exits = self._composite(region, region_transitions, [])
            for outcome, target in exits.items():
                name = names.new(outcome)
                targets[name] = target
                outcome_map[name] = {region.name: outcome}
            add = Call("Concurrence.add", (region.name, call))
            above = (*_comments(region), *region_transitions.comments)
            scope.entries.append(Entry(region.name, layout(add, 2, STEP * 2), above))
        keywords = self._keywords(state, transitions, further)
        keywords += [("outcome_map", outcome_map)] if outcome_map else []
        call = Call(self.module.own("containers", "Concurrence"), (), tuple(keywords))
        doc = f"Build the regions of state {state.id}."
        self._finish(slot, scope, function, doc, "concurrence", call)
        return Call(function), targets

    def _finish(
        self,
        slot: int,
        scope: ContainerOutcomes,
        function: str,
        doc: str,
        variable: str,
        call: Call,
    ) -> None:
        self.module.containers[slot] = Container(
            function=function,
            doc=doc,
            variable=variable,
            construction=layout(call, 1, f"{STEP}{variable} = "),
            entries=tuple(scope.entries),
        )

    # ---- states

    def _add_state(self, scope: ContainerOutcomes, state: State) -> None:
        """Add a state to a StateMachine, and bind its outcomes."""
        if state.kind is StateKind.HISTORY:
            siblings = self.maker.domains.parent(state).states
            labels = [each.name for each in siblings if each.kind is not StateKind.HISTORY]
            call = self._history(state, scope, labels)
            self._add(scope, state, call, {label: label for label in labels}, ())
            return
        transitions = self.maker.of(state, scope.internal)
        further = [*scope.internal]
        if state.kind is StateKind.PARALLEL:
            call, exits = self._parallel(state, transitions, further)
        elif state.kind is StateKind.COMPOSITE:
            call, exits = self._composite(state, transitions, further)
        else:
            call, exits = self._simple(state, transitions, further), {}
        targets = {**exits, **transitions.targets}
        bound = {outcome: scope.binding(target) for outcome, target in targets.items()}
        self._add(scope, state, call, {**bound, **scope.internal}, transitions.comments)

    def _simple(self, state: State, transitions: Transitions, further: list[str]) -> Call:
        keywords = tuple(self._keywords(state, transitions, further))
        if state.activity is not None:
            return activity_call(state, keywords, self.module)
        name = "Final" if state.kind is StateKind.FINAL else "State"
        return Call(self.module.own("states", name), (), keywords)

    def _history(self, state: State, scope: ContainerOutcomes, labels: list[str]) -> Call:
        default = state.transitions[0].target
        assert default is not None
        target = target_in(scope.owner, default)
        path = ".".join(filter(None, (target.label, target.inside)))
        keywords: Keywords = [("deep", True)] if state.deep else []
        return Call(self.module.own("states", "History"), (path, labels), tuple(keywords))

    def _keywords(self, state: State, transitions: Transitions, outcomes: list[str]) -> Keywords:
        """Return the keyword arguments that all states share."""
        keywords: Keywords = []
        if transitions.on:
            keywords.append(("on", [*transitions.on]))
        if outcomes:
            keywords.append(("outcomes", outcomes))
        if transitions.after:
            keywords.append(("after", dict(transitions.after)))
        if state.deferred:
            events = [Source(self.module.event(trigger.event)) for trigger in state.deferred]
            keywords.append(("defer", events))
        for word, effects in (("entry", state.entry), ("exit", state.exit)):
            if effects:
                lines = effect_lines(effects, 1, self.module)
                above = comments(effects[0].origin, doc_of(state.docs, word))
                name = self.module.add_function((state.id, word), "userdata", lines, above)
                keywords.append((f"on_{word}", Source(name)))
        return keywords

    def _add(
        self,
        scope: ContainerOutcomes,
        state: State,
        call: Call,
        bound: Mapping[str, str],
        above: tuple[str, ...],
    ) -> None:
        bound = {**bound, PREEMPTED: PREEMPTED}
        class_ = self.module.own("containers", "StateMachine")
        add = Call(f"{class_}.add", (state.name, call), (("transitions", bound),))
        entry = Entry(state.name, layout(add, 2, STEP * 2), (*_comments(state), *above))
        scope.entries.append(entry)


def _initial(initial: str, scope: ContainerOutcomes) -> Keywords:
    """Return the initial state, unless it is the one that is added first."""
    path = initial[len(scope.owner) + 1 :] if scope.owner else initial
    first = scope.entries[0].label if scope.entries else None
    return [("initial", path)] if path != first else []


def _comments(state: State) -> tuple[str, ...]:
    """Return the place of a state in the model, and the comments there on it and its activity."""
    does = state.activity
    activity = comments(does.origin, does.doc) if does is not None and does.doc else ()
    return (*comments(state.origin, state.doc), *activity)
