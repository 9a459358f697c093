"""Transitions of a state as `On(...)` calls, with its delays and targets of outcomes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from swarmdsl.codegen import dataclass
from swarmdsl.codegen.python import Call, Source, comments
from swarmdsl.codegen.shared import reads_envelope
from swarmdsl.ir import (
    Effect,
    EventTrigger,
    Expression,
    OutcomeTrigger,
    State,
    TimeTrigger,
    Trigger,
)

from ..outcome_routes import OutcomeRoute, Target, TransitionDomains, outcome_word, timer_names
from .expressions import ENVELOPE, python_expression
from .module import PREEMPTED, Module
from .outcomes import outcome_names
from .statements import STEP, effect_lines

_SHORT = 48
"""Length up to which an expression is in the line of its transition."""


@dataclass(frozen=True)
class Transitions:
    """The transitions of a state in SMACH.

    `on` are the calls of `On`, `after` the delays by their names. `targets` has the target of each
    outcome of the state, `internal` of each outcome of the states inside. `comments` are from the
    model, for transitions without a function that has them.
    """

    on: tuple[Call, ...]
    after: Mapping[str, Source]
    targets: Mapping[str, Target]
    internal: Mapping[str, Target]
    comments: tuple[str, ...]


@dataclass(frozen=True)
class _On:
    """A route by one of its triggers: the trigger in Python, and the word for the outcome."""

    trigger: str
    word: str
    route: OutcomeRoute


class TransitionMaker:
    """Makes the transitions of the states of one machine."""

    def __init__(self, module: Module) -> None:
        self.module = module
        self.domains = TransitionDomains(module.machine)

    def of(self, state: State, taken_names: Iterable[str]) -> Transitions:
        """Return the transitions of a state; outcomes avoid the names given."""
        # A region tries the transitions of the parallel state around it first.
        routes = sorted(self.domains.routes(state), key=lambda route: not route.inherited)
        calls = [each for route in routes for each in self._calls(route)]
        outcomes = outcome_names(((each.word, each.route.target) for each in calls), taken_names)
        on = []
        targets: dict[str, Target] = {}
        internal: dict[str, Target] = {}
        made: dict[int, tuple[tuple[str, object], ...]] = {}
        for each, outcome in zip(calls, outcomes, strict=True):
            route = each.route
            if outcome is not None and route.internal:
                outcome = f"{state.name}_{outcome}"
            key = id(route.transition)
            if key not in made:
                made[key] = self._keywords(each, state)
            on.append(_on(each, outcome, made[key]))
            if outcome is not None and route.target is not None:
                (internal if route.internal else targets)[outcome] = route.target
        after = {
            name: self._delay(delay, state, name) for delay, name in timer_names(state).items()
        }
        return Transitions(tuple(on), after, targets, internal, tuple(_comments(routes)))

    def _calls(self, route: OutcomeRoute) -> Iterator[_On]:
        """Yield the calls of `On` for a route, one for each trigger."""
        for trigger, event in route.triggers:
            # `aborted` may also stand for the event of `preempted`; in SMACH one `On` covers both.
            if isinstance(trigger, OutcomeTrigger) and not event.endswith(f".{trigger.outcome}"):
                continue
            yield _On(self._trigger(trigger, event, route), _word(trigger, route), route)

    def _trigger(self, trigger: Trigger | None, event: str, route: OutcomeRoute) -> str:
        """Return a trigger in Python; `event` is its name in the engine."""
        match trigger:
            case None:
                return self.module.own("states", "AT_ONCE")
            case EventTrigger(event=name):
                return self.module.event(name)
            case OutcomeTrigger(outcome=outcome):
                return repr(outcome)
            case TimeTrigger(delay=delay):
                name = route.timers[delay]
                return repr(f"after.{route.owner.id}.{name}" if route.inherited else name)
        return repr(event)

    def _keywords(self, call: _On, state: State) -> tuple[tuple[str, object], ...]:
        """Return the keyword arguments of `On`: guard, effects, target inside, internal."""
        self.module.own("states", "On")
        route = call.route
        transition = route.transition
        found: list[tuple[str, object]] = []
        if route.guard is not None:
            found.append(("guard", self._guard(route.guard, call.word, state)))
        if transition.effects and not route.delegated:
            lines = effect_lines(transition.effects, 1, self.module)
            above = comments(transition.origin, transition.doc)
            words = (state.id, call.word, "effect")
            name = self.module.add_function(words, _parameters(transition.effects), lines, above)
            found.append(("effect", Source(name)))
        if route.target is not None and route.target.inside:
            found.append(("into", route.target.inside))
        if route.internal:
            found.append(("internal", True))
        return tuple(found)

    def _guard(self, guard: Expression, word: str, state: State) -> Source:
        parameters = _parameters([guard])
        text = python_expression(guard, self.module.imports)
        if len(text) <= _SHORT:
            return Source(f"lambda {parameters}: {text}")
        return self._function((state.id, word, "guard"), parameters, text, guard)

    def _delay(self, delay: Expression, state: State, name: str) -> Source:
        text = python_expression(delay, self.module.imports)
        if len(text) <= _SHORT:
            return Source(f"lambda userdata: {text}")
        return self._function((state.id, name), "userdata", text, delay)

    def _function(self, words: Iterable[str], parameters: str, text: str, at: Expression) -> Source:
        body = [f"{STEP}return {text}"]
        return Source(self.module.add_function(words, parameters, body, comments(at.origin)))


def _parameters(content: Iterable[Expression | Effect]) -> str:
    return f"userdata, event, {ENVELOPE}" if reads_envelope(content) else "userdata, event"


def _on(call: _On, outcome: str | None, keywords: tuple[tuple[str, object], ...]) -> Call:
    default = call.word if call.trigger.startswith("events.") else call.trigger.strip("'")
    arguments = (Source(call.trigger), *([outcome] if outcome != default else []))
    return Call("On", arguments, keywords)


def _word(trigger: Trigger | None, route: OutcomeRoute) -> str:
    """Return the word for an outcome; `preempted` has a meaning of its own in SMACH."""
    word = outcome_word(trigger, route) or "stays"
    if isinstance(trigger, OutcomeTrigger) and word == PREEMPTED:
        return "cancelled"
    return word


def _comments(routes: Iterable[OutcomeRoute]) -> Iterator[str]:
    """Yield the comments of the model on transitions that have no function with them."""
    found = dict.fromkeys(
        (each.transition.origin, each.transition.doc)
        for each in routes
        if each.transition.doc and not each.transition.effects
    )
    for origin, doc in found:
        yield from comments(origin, doc)
