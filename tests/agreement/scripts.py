"""Scripts of events that take every transition of a machine, found by trying.

The engine over the tables of the model makes them: what it does after each step is what the
others are compared with.
"""

from __future__ import annotations

import random
import re
from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from swarmdsl import ir
from swarmdsl.codegen.exchange.scxml.ids import data_ids, state_ids
from swarmdsl.codegen.shared.events import Events, delays
from swarmdsl.execution.engine import Event, Instance, LoopError, Observer, Transition
from swarmdsl.execution.simulate.machines.machine_data import first_data
from swarmdsl.execution.simulate.machines.table import OUTCOMES, table
from swarmdsl.ir import EventTrigger, StateKind, System
from swarmdsl.syntax.types import DURATION, STRING

from .engines import Ours, Step
from .values import Values

DRAWS = 10
"""Number of messages tried per event, and of results per activity."""
SITUATIONS = 400
"""Maximum number of situations of a machine to continue from."""
DEEP = {"Patrol": 700}
"""The same for machines whose variables have many values."""
WALKS, STEPS = 10, 40
"""Number of random walks, and steps in each."""

APART = 50_000_000
"""Minimum time between the ends of delays, in ns; documents use milliseconds."""

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
MORE = {
    *("agriculture", "cpswarm", "crazyflies", "emergency_exit", "flocking", "meadow", "minimal"),
    "turtlebots",
}
"""Examples whose machines use nothing that those of other models do not use."""
NEVER = {
    ("everything", "Work"): ["on done   -> Stop"],
    ("language", "Market"): ["on F [offers[1].price > 2] / clear offers -> Open"],
    ("language", "B"): ["[n > 3 and mine < self.count and self.role != self.id] -> A"],
}
"""Transitions of models that no script takes, because they cannot be."""


def titled(path: Path) -> str:
    """Return the name of a model in a folder of its own."""
    return (path.parent if path.suffix else path).name


def params(paths: Iterable[Path]) -> list[Any]:
    """Models as parameters of a test: those of most examples for a thorough one."""
    return [
        pytest.param(
            path,
            id=titled(path),
            marks=[pytest.mark.thorough] if path.parent == EXAMPLES and path.name in MORE else [],
        )
        for path in paths
    ]


@dataclass(frozen=True)
class Script:
    """Steps, and the active states before the first one and after each."""

    steps: tuple[Step, ...]
    expected: tuple[frozenset[str], ...]


class Subject:
    """A machine of a model, what its params are, and what can happen to it."""

    def __init__(self, machine: ir.StateMachine, system: System) -> None:
        values = Values(machine, system)
        self.machine = machine
        self.system = system
        self.table = table(machine, system)
        self.params = {
            # Whatever is counted up to a param is over soon.
            p.name: values.value(p.type) if p.default is None else 2
            for p in machine.params
            if p.default is None or re.fullmatch("u?int[0-9]+", str(p.type))
        }
        names = data_ids(machine)
        self.given = {
            names[p.name]: self.params[p.name] // 1_000_000
            if p.type == DURATION  # milliseconds in a document
            else self.params[p.name]
            for p in machine.params
            if p.name in self.params
        }
        self.ids = state_ids(machine, set(names.values()))
        there = Events(machine, {state: state for state in self.ids})
        here = Events(machine, self.ids)
        self.timers = {
            there.timer(state, delay): here.timer(state, delay)
            for state in machine.walk()
            for delay in delays(state)
        }
        heard = {
            trigger.event
            for state in machine.walk()
            for transition in state.transitions
            for trigger in transition.triggers
            if isinstance(trigger, EventTrigger)
        }
        self.events: list[Step] = []
        for event in [each for each in system.events if each.name in heard]:
            steps = [self._step(event, values) for _ in range(DRAWS)]
            self.events += [step for i, step in enumerate(steps) if step not in steps[:i]]
        self.ends: dict[str, list[Step]] = {}
        for state in machine.walk():
            if state.activity is not None:
                results = [values.result(state.activity) for _ in range(DRAWS)]
                ways = [("succeeded", each) for each in results]
                ways += [(outcome, {}) for outcome in OUTCOMES[1:]]
                self.ends[state.id] = [
                    Step(here.outcome(state, outcome), data, (state.id, outcome))
                    for i, (outcome, data) in enumerate(ways)
                    if (outcome, data) not in ways[:i]
                ]

    def _step(self, event: ir.Event, values: Values) -> Step:
        """An event with a message; headers of the message tell who sent it and when."""
        message = values.message(event)
        if not event.swarm or not values.asks:
            return Step(event.name, message)
        about = values.value(STRING), values.value(DURATION)
        sender, sent = as_headers_say(event, message, self.system, *about)
        return Step(event.name, message, sender=sender, sent=sent)

    @property
    def transitions(self) -> dict[int, ir.Transition]:
        """Those that states and choices have, by identity: some are equal."""
        return {
            id(transition): transition
            for state in self.machine.walk()
            if state.kind is not StateKind.HISTORY
            for transition in state.transitions
        }

    def scripts(self, left: int = 0) -> tuple[list[Script], list[ir.Transition]]:
        """Scripts that take every transition that can be taken, and the transitions left over.

        Of these, `left` are not searched for. Raises LoopError for a machine that does not come to
        rest at first.
        """
        missing = self.transitions
        found: list[tuple[Step, ...]] = []

        def note(model: Model, steps: tuple[Step, ...]) -> None:
            new = missing.keys() & model.seen
            for each in new:
                del missing[each]
            if new:
                found.append(steps)

        walks = self.walks()
        for steps in walks:
            note(self.after(steps), steps)
        found.clear()
        known = {Model(self).situation}
        most = DEEP.get(self.machine.name, SITUATIONS)
        waiting: deque[tuple[Step, ...]] = deque([()])
        while waiting and len(missing) > left:
            before = waiting.popleft()
            for choice in self.after(before).choices:
                model = self.after(before)
                try:
                    steps = (*before, model.happen(choice))
                except LoopError:
                    continue
                if model.gave_up:
                    continue
                note(model, steps)
                if model.situation not in known and len(known) < most:
                    known.add(model.situation)
                    waiting.append(steps)
        whole = [s for s in found if not any(o != s and o[: len(s)] == s for o in found)]
        return [self.script(steps) for steps in (*whole, *walks)], list(missing.values())

    def after(self, steps: tuple[Step, ...]) -> Model:
        """The model after some steps."""
        model = Model(self)
        for step in steps:
            model.take(step)
        return model

    def walks(self) -> list[tuple[Step, ...]]:
        """Some walks by chance; the same each time."""
        return [self.walk(random.Random(seed)) for seed in range(WALKS)]

    def walk(self, dice: random.Random) -> tuple[Step, ...]:
        """Things that happen by chance.

        Up to where the machine would not come to rest, or something happens by itself.
        """
        model = Model(self)
        steps: tuple[Step, ...] = ()
        while len(steps) < STEPS and (choices := model.choices):
            try:
                step = model.happen(dice.choice(choices))
            except LoopError:
                break
            if model.gave_up:
                break
            steps += (step,)
        return steps

    def script(self, steps: tuple[Step, ...]) -> Script:
        """The script of these steps."""
        model = Model(self)
        expected = [model.active]
        for step in steps:
            model.take(step)
            expected.append(model.active)
        return Script(steps, tuple(expected))


def as_headers_say(
    event: ir.Event, message: dict[str, Any], system: System, sender: str, sent: int
) -> tuple[str, int]:
    """Return the sender and the time of an event, which headers of its message tell first."""
    known = system.known_interface(event.type)
    for field in known.fields if isinstance(known, ir.Message) else ():
        header = message.get(field.name, {})
        if str(field.type) == "swarmros/EventHeader":
            sender = header.get("node", sender)
        elif str(field.type) == "std_msgs/Header":
            sent = header.get("stamp", sent)
    return sender, sent


class Watch(Observer):
    """Notes the transitions that are taken, and the events that are looked at."""

    def __init__(self) -> None:
        self.transitions: set[int] = set()
        self.events: list[str] = []

    def taken(self, instance: Instance, transition: Transition) -> None:
        self.transitions.add(id(transition.origin))

    def received(self, instance: Instance, event: Event) -> None:
        self.events.append(event.name)


class Model(Ours):
    """Our engine over the table of a model; ids and events are those of the document."""

    def __init__(self, subject: Subject, watch: Watch | None = None) -> None:
        self.subject = subject
        self.watch = watch or Watch()
        data = first_data(subject.machine, subject.system, subject.params)
        super().__init__(subject.table, data, self.watch)

    @property
    def active(self) -> frozenset[str]:
        return frozenset(self.subject.ids[state] for state in super().active)

    @property
    def seen(self) -> set[int]:
        """The transitions that were taken, by identity."""
        return self.watch.transitions

    def take(self, step: Step) -> None:
        if step.run is None:
            super().take(step)
            return
        state, outcome = step.run
        number = self.subject.table.numbers[state]
        (run,) = [each for each in self.world.going if each.state == number]
        self.world.going.remove(run)
        run.end(outcome, step.data)

    @property
    def choices(self) -> list[Step]:
        """Return the steps that are possible now."""
        if not self.instance.running:
            return []
        found = list(self.subject.events)
        for run in self.world.going:
            found += self.subject.ends[self.subject.table.states[run.state].id]
        due = sorted(time for _, time in self.pending)
        if due and not 0 < due[min(1, len(due) - 1)] - due[0] < APART:
            found.append(Step("", time=True))
        return found

    def happen(self, step: Step) -> Step:
        """Take a step; the same step, with the name of the event if time brings it."""
        self.watch.events.clear()
        self.take(step)
        if not step.time:
            return step
        name = self.watch.events[0]
        # The end of a delayed sending is no event for engines of others.
        return Step(self.subject.timers.get(name, name), time=True)

    @property
    def gave_up(self) -> bool:
        """True if something happened by itself in the last step.

        That is an activity that is aborted because its goal has no value, which is the business
        of the host to make, or a delay of no time, which engines without time do not know.
        """
        return any(map(self._is_from_outside, self.watch.events[1:]))

    @property
    def went_on(self) -> bool:
        """True if a delay of zero length has passed at the start."""
        return any(map(self._is_from_outside, self.watch.events))

    def _is_from_outside(self, event: str) -> bool:
        return event.startswith("do.") or event in self.subject.timers

    @property
    def pending(self) -> list[tuple[str, int]]:
        """The delays that run: their events, and when they end."""
        ends = {alarm: time for time, _, alarm in self.world.clock._alarms}
        return [(each.event.name, ends[each.handle]) for each in self.instance._timers or ()]

    @property
    def situation(self) -> Any:
        """All that decides about what comes next."""
        now = self.world.clock.now
        return (
            self.active,
            self.instance.configuration.histories,
            repr(self.instance.data),
            tuple(sorted((name, time - now) for name, time in self.pending)),
            tuple(event.name for event in self.instance._deferred or ()),
            tuple(run.state for run in self.world.going),
        )
