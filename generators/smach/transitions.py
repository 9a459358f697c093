"""The transitions of a state as `On(...)` calls, its delays, and where its outcomes lead."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from swarmdsl.codegen import dataclass, fresh
from swarmdsl.codegen.python import Call, Source, comments
from swarmdsl.codegen.shared import Events, delays, entered_region, region_transitions
from swarmdsl.ir import (
    DoneTrigger,
    EventTrigger,
    Expression,
    OutcomeTrigger,
    State,
    StateKind,
    TimeTrigger,
    Transition,
    Trigger,
)

from .expressions import python_expression
from .module import PREEMPTED, Module
from .statements import STEP, effect_lines
from .ways import Way, Ways, named, way_into

_SHORT = 48
"""How long an expression may be that stands in the line of its transition."""


@dataclass(frozen=True)
class Transitions:
    """What SMACH is told of the transitions of a state.

    `on` are the calls; `ways` says where each outcome leads, `internal` the same of those of
    states inside; `said` are the lines of the model about those without a function of their own.
    """

    on: tuple[Call, ...]
    after: Mapping[str, Source]
    ways: Mapping[str, Way]
    internal: Mapping[str, Way]
    said: tuple[str, ...]


@dataclass(frozen=True)
class _Taken:
    """A transition by one of its triggers, as text and as a word for the outcome."""

    trigger: str
    word: str
    transition: Transition
    guard: Expression | None
    way: Way | None
    is_internal: bool = False
    has_effects: bool = True


class TransitionMaker:
    """Makes those of the states of one machine."""

    def __init__(self, module: Module) -> None:
        self.module = module
        self.ways = Ways(module.machine)
        self._events = Events(
            module.machine, {state.id: state.id for state in module.machine.walk()}
        )

    def of(self, state: State, taken_names: Iterable[str]) -> Transitions:
        """What SMACH is told of a state; some names of outcomes are taken."""
        timers = _timers(state)
        taken = list(self._inward(state)) if state.kind is StateKind.REGION else []
        taken += self._own(state, timers)
        outcomes = named(((each.word, each.way) for each in taken), taken_names)
        on = []
        ways: dict[str, Way] = {}
        internal: dict[str, Way] = {}
        made: dict[int, tuple[tuple[str, object], ...]] = {}
        for each, outcome in zip(taken, outcomes, strict=True):
            if outcome is not None and each.is_internal:
                outcome = f"{state.name}_{outcome}"
            key = id(each.transition)
            if key not in made:
                made[key] = self._keywords(each, state)
            on.append(_on(each, outcome, made[key]))
            if outcome is not None and each.way is not None:
                (internal if each.is_internal else ways)[outcome] = each.way
        after = {name: self._delay(delay, state, name) for delay, name in timers.items()}
        return Transitions(tuple(on), after, ways, internal, tuple(_said(taken)))

    def _own(self, state: State, timers: Mapping[Expression, str]) -> Iterator[_Taken]:
        for transition in state.transitions:
            inside = entered_region(transition, state) is not None
            has_way = transition.target is not None and not inside
            way = self.ways.of(transition, state) if has_way else None
            is_internal = transition.internal and way is not None and way.domain == state.id
            for trigger, word in self._triggers(transition, state, timers, way):
                yield _Taken(
                    trigger, word, transition, transition.guard, way, is_internal, not inside
                )

    def _inward(self, region: State) -> Iterator[_Taken]:
        """The internal transitions of a parallel state that its region takes."""
        around = self.ways.around(region)
        timers = _timers(around)
        for event, guard, transition, _ in region_transitions(region, around, self._events):
            assert transition.target is not None
            way = way_into(region.id, transition.target)
            for trigger in transition.triggers or (None,):
                texts = self._texts(trigger, around, timers)
                events = self._events.of_trigger(trigger, around) if trigger else [""]
                for text, heard in zip(texts, events, strict=True):
                    if heard == event:
                        if isinstance(trigger, TimeTrigger):
                            name = timers[trigger.delay]
                            text = repr(f"after.{around.id}.{name}")
                        word = _word(trigger, timers, way)
                        yield _Taken(text, word, transition, guard, way, is_internal=True)

    def _triggers(
        self,
        transition: Transition,
        state: State,
        timers: Mapping[Expression, str],
        way: Way | None,
    ) -> Iterator[tuple[str, str]]:
        """Each trigger of a transition as text, with the word for its outcome."""
        for trigger in transition.triggers or (None,):
            for text in self._texts(trigger, state, timers):
                yield text, _word(trigger, timers, way)

    def _texts(
        self, trigger: Trigger | None, state: State, timers: Mapping[Expression, str]
    ) -> list[str]:
        match trigger:
            case EventTrigger(event=event):
                return [self.module.event(event)]
            case OutcomeTrigger(outcome=outcome):
                return [repr(outcome)]
            case TimeTrigger(delay=delay):
                return [repr(timers[delay])]
            case DoneTrigger():
                return [repr(event) for event in self._events.of_trigger(trigger, state)]
        return [self.module.own("states", "AT_ONCE")]

    def _keywords(self, taken: _Taken, state: State) -> tuple[tuple[str, object], ...]:
        """The guard, the effects and the rest of what a transition is told with."""
        self.module.own("states", "On")
        transition = taken.transition
        found: list[tuple[str, object]] = []
        if taken.guard is not None:
            found.append(("guard", self._guard(taken, state)))
        if transition.effects and taken.has_effects:
            lines = effect_lines(transition.effects, 1, self.module)
            said = comments(transition.origin, transition.doc)
            words = (state.id, taken.word, "effect")
            name = self.module.add_function(words, "userdata, event", lines, said)
            found.append(("effect", Source(name)))
        if taken.way is not None and taken.way.into:
            found.append(("into", taken.way.into))
        if taken.is_internal:
            found.append(("internal", True))
        return tuple(found)

    def _guard(self, taken: _Taken, state: State) -> Source:
        assert taken.guard is not None
        parameters = "userdata, event"
        text = python_expression(taken.guard, self.module.imports)
        if len(text) <= _SHORT:
            return Source(f"lambda {parameters}: {text}")
        words = (state.id, taken.word, "guard")
        return self._function(words, parameters, text, taken.guard)

    def _delay(self, delay: Expression, state: State, name: str) -> Source:
        text = python_expression(delay, self.module.imports)
        if len(text) <= _SHORT:
            return Source(f"lambda userdata: {text}")
        return self._function((state.id, name), "userdata", text, delay)

    def _function(self, words: Iterable[str], parameters: str, text: str, at: Expression) -> Source:
        said = comments(at.origin)
        return Source(self.module.add_function(words, parameters, [f"{STEP}return {text}"], said))


def _on(taken: _Taken, outcome: str | None, keywords: tuple[tuple[str, object], ...]) -> Call:
    same = taken.word if taken.trigger.startswith("events.") else taken.trigger.strip("'")
    arguments = (Source(taken.trigger), *([outcome] if outcome != same else []))
    return Call("On", arguments, keywords)


def _timers(state: State) -> dict[Expression, str]:
    """The name of each delay of a state."""
    names: dict[Expression, str] = {}
    for delay in delays(state):
        names[delay] = fresh("timeout", names.values())
    return names


def _word(trigger: Trigger | None, timers: Mapping[Expression, str], way: Way | None) -> str:
    """What an outcome is called that a trigger has brought about."""
    match trigger:
        case EventTrigger(event=event):
            return event
        case OutcomeTrigger(outcome=outcome):
            return outcome if outcome != PREEMPTED else "cancelled"
        case TimeTrigger(delay=delay):
            return timers[delay]
        case DoneTrigger(final=final):
            return final.rpartition(".")[2] if final is not None else "done"
    return way.label if way is not None else "stays"


def _said(taken: Iterable[_Taken]) -> Iterator[str]:
    """What the model says of transitions that have no function to say it in."""
    found = dict.fromkeys(
        (each.transition.origin, each.transition.doc)
        for each in taken
        if each.transition.doc and not each.transition.effects
    )
    for origin, doc in found:
        yield from comments(origin, doc)
