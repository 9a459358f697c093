"""From a state machine to SMACH containers: which states stand in which, and how they are bound.

What a state does and what may interrupt it run together in a Concurrence, which ends with
the first of them. A transition out of a composite state becomes an outcome of each container
it leaves.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from swarmdsl.ir import EventTrigger, State, StateKind, TimeTrigger, doc_of
from swarmdsl.source import Span

from .activities import activity_call
from .concurrence import built_by, concurrence
from .module import PREEMPTED, Container, Entry, Module, fresh
from .python import Call, Source, comments, layout, place
from .routes import Branch, Content, Leave, Route, branches, done, ended, is_total
from .scopes import Scope, Targets
from .statements import STEP, effect_lines
from .triggers import decision, eventless, triggers_of


def build(module: Module) -> None:
    """Fill the module with the functions that build its machine, the first being `build`."""
    machine = module.machine
    structure = _Structure(module)
    scope = Scope("", {state.name for state in machine.states})
    initial = structure.initial(machine.initial, scope, machine.origin)
    doc = f"Build state machine {machine.name}."
    structure.machine(scope, "build", doc, initial, machine.states)


class _Structure:
    def __init__(self, module: Module) -> None:
        self.module = module
        self.targets = Targets(module)

    # ---- containers

    def machine(
        self, scope: Scope, function: str, doc: str, initial: str | None, states: Iterable[State]
    ) -> None:
        """A StateMachine of these states."""
        slot = self.module.reserve()
        for state in states:
            self._add_state(scope, state)
        self._finish(slot, scope, function, doc, initial)

    def _finish(
        self, slot: int, scope: Scope, function: str, doc: str, initial: str | None = None
    ) -> None:
        class_ = self.module.own("containers", "StateMachine")
        call = Call(class_, (scope.outcomes, Source("userdata")))
        first = scope.entries[0].label if scope.entries else None
        self.module.containers[slot] = Container(
            function=function,
            doc=doc,
            variable="machine",
            construction=layout(call, 1, f"{STEP}machine = "),
            entries=tuple(scope.entries),
            initial=initial if initial != first else None,
        )

    def initial(self, initial: str | None, scope: Scope, at: Span | None) -> str | None:
        """The label of the state entered first."""
        assert initial is not None
        found = self.targets.states[initial]
        if found.kind is StateKind.FINAL:
            self.module.unsupported("an initial state that is final", at)
            return None
        return found.name

    def _composite(self, state: State, word: str) -> Content:
        """The StateMachine inside a composite state or a region."""
        function = self.module.function_name(state.id, word)
        scope = Scope(state.id, {inside.name for inside in state.states})
        initial = self.initial(state.initial, scope, state.origin)
        what = "region" if state.kind is StateKind.REGION else "state"
        self.machine(scope, function, f"Build {what} {state.id}.", initial, state.states)
        routes: dict[str, Route] = {
            outcome: branches(state, done(state.id, final.id))
            for outcome, final in scope.finals.items()
        }
        routes |= _leaving(scope)
        return Content(built_by(function), routes)

    def _parallel(self, state: State, word: str) -> Content:
        """The Concurrence of the regions of a parallel state."""
        slot = self.module.reserve()
        function = self.module.function_name(state.id, word)
        members: dict[str, Content] = {}
        all_may_complete = True
        for region in state.states:
            inside = self._composite(region, "")
            names = {s.name: s.id for s in region.states if s.kind is StateKind.FINAL}
            routes: dict[str, Route] = {}
            may_complete = False
            for outcome, route in inside.routes.items():
                if isinstance(route, Leave):
                    routes[outcome] = route
                elif ending := branches(state, done(region.id, names[outcome])):
                    self._check_completion(ending, state)
                    routes[outcome] = ending
                else:
                    may_complete = True
            all_may_complete = all_may_complete and may_complete
            members[region.name] = Content(inside.call, routes)
        default = branches(state, done(state.id, None)) if all_may_complete else None
        doc = f"Build the regions of state {state.id}."
        return concurrence(
            self.module, slot, function, doc, members, _origins(state.states), default
        )

    def _check_completion(self, ending: Sequence[Branch], state: State) -> None:
        """A region whose completion is waited for ends all regions at once, whatever follows."""
        at = ending[0].transition.origin
        if not is_total(ending):
            self.module.unsupported(
                "a guard on the completion of a region without a transition for when it is false",
                at,
                "add a transition on the same trigger without a guard",
            )
        elif len(ending) > 1 and any(inside.exit for inside in state.walk()):
            self.module.unsupported(
                "a guard on the completion of a region of a state with effects on exit", at
            )
        elif any(branch.transition.target is None for branch in ending):
            self.module.unsupported(
                "a transition without a target on the completion of a region", at
            )

    def _interrupted(
        self, slot: int, function: str, state: State, content: Content | None
    ) -> Content:
        """The Concurrence of what a state does and what may interrupt it."""
        members: dict[str, Content] = {}
        places = _origins([state])
        if content is not None:
            members[state.name] = self._deciding(state, content)
        for trigger in triggers_of(state, self.targets, self.module):
            label = fresh(trigger.label, members)
            members[label] = Content(trigger.call, trigger.routes)
            places[label] = place(trigger.origin)
        if not members:
            members[state.name] = Content(self._wait(), {})
        keywords: list[tuple[str, object]] = []
        for word, effects in (("entry", state.entry), ("exit", state.exit)):
            if effects:
                lines = effect_lines(effects, 1, self.module)
                said = comments(effects[0].origin, doc_of(state.docs, word))
                name = self.module.add_function((state.id, word), "userdata", lines, said)
                keywords.append((f"on_{word}", Source(name)))
        doc = f"Build state {state.id}, with what begins and ends it."
        return concurrence(self.module, slot, function, doc, members, places, keywords=keywords)

    # ---- states

    def _add_state(self, scope: Scope, state: State) -> None:
        if state.kind is StateKind.FINAL:
            return
        at_once = [Branch(transition) for transition in eventless(state)]
        does_something = state.kind is not StateKind.SIMPLE or state.activity is not None
        has_effects = bool(state.entry or state.exit)
        if state.kind is StateKind.CHOICE or (is_total(at_once) and not has_effects):
            said = (*_comments(state), *_said(at_once))
            self._add_decision(scope, state.name, (state.id,), at_once, None, said)
            return
        if at_once and state.states:
            self.module.unsupported(
                "a transition without a trigger from a state with states inside",
                at_once[0].transition.origin,
            )
        awaited = {
            trigger
            for transition in state.transitions
            for trigger in transition.triggers
            if isinstance(trigger, (EventTrigger, TimeTrigger))
        }
        waits = len(awaited) + bool(at_once)
        if has_effects or (waits and does_something) or waits > 1:
            slot = self.module.reserve()
            function = self.module.function_name(state.id)
            inside = self._content(state, ("states", "regions"))
            content = self._interrupted(slot, function, state, inside)
        elif waits:
            (trigger,) = triggers_of(state, self.targets, self.module)
            content = Content(trigger.call, trigger.routes)
        else:
            content = self._content(state, ("", "")) or Content(self._wait(), {})
        self._add(scope, state, content)

    def _content(self, state: State, words: tuple[str, str]) -> Content | None:
        """What a state does, without what may interrupt it."""
        if state.kind is StateKind.COMPOSITE:
            return self._composite(state, words[0])
        if state.kind is StateKind.PARALLEL:
            return self._parallel(state, words[1])
        if state.activity is None:
            return None
        call, outcomes = activity_call(state, self.module)
        return Content(
            call, {outcome: branches(state, ended(state, outcome)) for outcome in outcomes}
        )

    def _deciding(self, state: State, content: Content) -> Content:
        """The same, in a StateMachine that decides what comes next, or waits.

        Guards are for before the effects on exit: those come when this has ended.
        """
        if not (content.may_stay or (state.exit and content.is_guarded)):
            return content
        slot = self.module.reserve()
        function = self.module.function_name(state.id, "stays")
        scope = Scope(state.id)
        self._add(scope, state, content)
        doc = f"Build what state {state.id} does, and the decision what comes next."
        self._finish(slot, scope, function, doc)
        return Content(built_by(function), _leaving(scope))

    def _add(self, scope: Scope, state: State, content: Content) -> None:
        """Add a state, with what has to be decided or done when it ends."""
        scope.labels.add(state.name)
        waiting = scope.label(f"{state.name}_waiting") if content.may_stay else None
        transitions: dict[str, str] = {}
        taken: list[Branch] = []
        later: list[tuple[str, str, list[Branch]]] = []
        for outcome, route in content.routes.items():
            ways = [route.branch] if isinstance(route, Leave) else route
            if not ways:
                assert waiting is not None
                transitions[outcome] = waiting
            elif self._is_step(scope, ways[0]):
                label = scope.label(f"{state.name}_{outcome}")
                transitions[outcome] = label
                later.append((label, outcome, ways))
            else:
                transitions[outcome] = self.targets.bind(scope, ways[0])
                if route is ways:
                    taken.append(ways[0])
        said = (*_comments(state), *_said(taken))
        self._add_entry(scope, state.name, content.call, transitions, said)
        for label, outcome, ways in later:
            said = tuple(
                line for w in ways for line in comments(w.transition.origin, w.transition.doc)
            )
            self._add_decision(scope, label, (state.id, "on", outcome), ways, waiting, said)
        if waiting is not None:
            self._add_entry(scope, waiting, self._wait(), {}, ())

    def _is_step(self, scope: Scope, way: Branch) -> bool:
        """Whether there is something to decide or to do here, before the target comes."""
        if way.transition.guard is not None:
            return True
        return bool(way.transition.effects) and self.targets.is_inside(scope, way)

    def _add_decision(
        self,
        scope: Scope,
        label: str,
        words: Iterable[str],
        ways: Sequence[Branch],
        waiting: str | None,
        comments: tuple[str, ...],
    ) -> None:
        """A Decision between `ways`, for each of which it has an outcome; else it is waited."""
        outcomes: list[str] = []
        for way in ways:
            if way.transition.target is None:
                assert waiting is not None
                outcomes.append(waiting)
            else:
                outcomes.append(self.targets.bind(scope, way))
        here = [w if self.targets.is_inside(scope, w) else w.without_effects for w in ways]
        otherwise = None if is_total(ways) else waiting
        call = decision(words, here, outcomes, otherwise, self.module)
        bound = [*outcomes, *([otherwise] if otherwise is not None else [])]
        self._add_entry(scope, label, call, {target: target for target in bound}, comments)

    def _add_entry(
        self,
        scope: Scope,
        label: str,
        call: Call,
        transitions: Mapping[str, str],
        comments: tuple[str, ...],
    ) -> None:
        bound = {**transitions, PREEMPTED: PREEMPTED}
        add = Call("StateMachine.add", (label, call), (("transitions", bound),))
        scope.entries.append(Entry(label, layout(add, 2, STEP * 2), comments))

    def _wait(self) -> Call:
        return Call(self.module.own("states", "Wait"))


def _leaving(scope: Scope) -> dict[str, Route]:
    return {**scope.exits}


def _origins(states: Iterable[State]) -> dict[str, str]:
    return {state.name: place(state.origin) for state in states}


def _comments(state: State) -> tuple[str, ...]:
    """Where a state stands in the model, and what is said of it and of its activity there."""
    does = state.activity
    activity = comments(does.origin, does.doc) if does is not None and does.doc else ()
    return (*comments(state.origin, state.doc), *activity)


def _said(branches: Iterable[Branch]) -> Iterator[str]:
    """What is said in the model of these transitions, each once, if anything is."""
    found = dict.fromkeys((way.transition.origin, way.transition.doc) for way in branches)
    for origin, doc in found:
        if doc:
            yield from comments(origin, doc)
