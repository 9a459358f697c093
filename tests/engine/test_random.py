"""Any machine comes to rest or is reported, in a legal configuration."""

from __future__ import annotations

import random

from hypothesis import event as seen
from hypothesis import given, settings
from hypothesis import strategies as st

from swarmdsl.execution.engine import Event, Instance, Kind, LoopError, Machine, State, Transition
from swarmdsl.execution.engine.table import members

from .world import StillWorld

EVENTS = ("a", "b", "c")
QUICK = settings(max_examples=300)


class Maker:
    """Makes a machine by throwing dice."""

    def __init__(self, dice: random.Random) -> None:
        self.dice = dice
        self.count = 0
        self.ids: list[str] = []
        self.shape = [self.tree(3) for _ in range(dice.randrange(2, 5))]

    def tree(self, depth: int, region: bool = False) -> tuple[str, Kind, list[object]]:
        self.count += 1
        name = f"s{self.count}"
        self.ids.append(name)
        chance = self.dice.random()
        if not region and depth < 3 and chance < 0.08:
            return name, Kind.FINAL, []
        if depth == 0 or (chance < 0.4 and not region):
            return name, Kind.STATE, []
        parallel = chance > 0.7 and not region
        inner = [self.tree(depth - 1, parallel) for _ in range(self.dice.randrange(1, 4))]
        return name, Kind.PARALLEL if parallel else Kind.STATE, inner

    def machine(self) -> Machine:
        return Machine("m", [self.state(*each) for each in self.shape], limit=300)

    def state(self, name: str, kind: Kind, inner: list[object]) -> State:
        states = [self.state(*each) for each in inner]  # type: ignore[misc]
        if inner and self.dice.random() < 0.4:
            deep = Kind.DEEP_HISTORY if self.dice.random() < 0.5 else Kind.HISTORY
            # What is below a parallel state is entered with all its regions.
            default = Transition(targets=(self.dice.choice(states).id,))
            states.append(State(f"h{name}", deep, transitions=(default,)))
            self.ids.append(f"h{name}")
        transitions = [self.transition() for _ in range(self.dice.randrange(1, 5))]
        entry = (self.raising(),) if self.dice.random() < 0.06 else ()
        return State(
            name,
            kind,
            tuple(states),
            transitions=() if kind is Kind.FINAL else tuple(transitions),
            entry=entry,  # type: ignore[arg-type]
        )

    def raising(self) -> object:
        name = self.dice.choice(EVENTS)
        return lambda instance, event: instance.raise_event(Event(name))

    def transition(self) -> Transition:
        chance = self.dice.random()
        events: tuple[str, ...] = (self.dice.choice(EVENTS),)
        if chance < 0.03:
            events = ()
        elif chance < 0.1:
            events = (self.dice.choice(["done.state.*", "*"]),)
        targets = (self.dice.choice(self.ids),) if self.dice.random() < 0.9 else ()
        guard = None
        if self.dice.random() < 0.4:
            state, wanted = self.dice.choice(self.ids), self.dice.random() < 0.5
            guard = lambda instance, event: instance.active(state) is wanted  # noqa: E731
        return Transition(events, targets, guard, internal=self.dice.random() < 0.3)


def is_legal(machine: Machine, active: int) -> bool:
    """SCXML 1.0, 3.11: what makes a set of states a configuration."""
    if len([n for n in machine.children[0] if active >> n & 1]) != 1:
        return False
    for number in members(active):
        state = machine.states[number]
        inside = [n for n in machine.children[number] if active >> n & 1]
        parent = machine.parents[number]
        if state.kind in (Kind.HISTORY, Kind.DEEP_HISTORY) or (parent and not active >> parent & 1):
            return False
        expected = len(machine.children[number])
        if state.kind is not Kind.PARALLEL:
            expected = min(expected, 1)
        if len(inside) != expected:
            return False
    return True


def run(machine: Machine, events: list[str]) -> list[object]:
    """The configurations that events lead to; a loop or the end as the last."""
    found: list[object] = []
    instance = Instance(machine, StillWorld())
    try:
        instance.start()
        for name in events:
            found.append(instance.configuration.active)
            assert not instance.running or is_legal(machine, instance.configuration.active)
            instance.receive(Event(name))
    except LoopError as error:
        return [*found, error.states]
    return [*found, instance.final]


@QUICK
@given(st.integers(0, 10**6), st.lists(st.sampled_from(EVENTS), min_size=1, max_size=25))
def test_configurations_are_legal(seed: int, events: list[str]) -> None:
    machine = Maker(random.Random(seed)).machine()
    found = run(machine, events)
    if isinstance(found[-1], list):
        assert found[-1]
        assert set(found[-1]) <= set(machine.numbers)
    seen(f"ends with {type(found[-1]).__name__}")
    seen(f"configurations: {min(len(set(map(str, found))), 6)}")

    # What a machine has worked out for one instance is right for the next, and for a new one.
    assert run(machine, events) == found
    assert run(Maker(random.Random(seed)).machine(), events[::-1]) == run(machine, events[::-1])
