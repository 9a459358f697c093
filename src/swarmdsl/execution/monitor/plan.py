"""Properties and measures with the facts that they are about, without those of a run."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Sequence
from dataclasses import replace
from itertools import chain

from .automaton import Automaton, Move, State
from .claims import Measure, Property
from .facts import ActorLike, Facts, Kind, can_hold
from .meters import Gauge
from .truth import Claims, is_momentary


class Rule:
    """A property with its automaton."""

    def __init__(self, property_: Property, facts: Facts) -> None:
        self.property = property_
        self.each = property_.each
        self.claims = Claims(property_.each, facts)
        self.facts = facts
        claims, scope = property_.claims, property_.scope
        self._truths = [self.claims.truth(each) for each in (*claims, *scope)]
        sentence = replace(property_.sentence, momentary=is_momentary(claims[0]))
        self.automaton = Automaton(sentence, len(claims), len(scope))

    def move(self, state: State, key: int) -> Move:
        """Return the step of a state at a moment with this key, and remember it."""
        truths = [truth(key) for truth in self._truths]
        found = state.moves[key] = self.automaton.step(state, truths)
        return found


class Plan:
    """Properties and measures with the facts that they are about, for any number of runs."""

    def __init__(self, properties: Iterable[Property], measures: Iterable[Measure] = ()) -> None:
        self.facts = Facts()
        self.rules = [Rule(each, self.facts) for each in properties]
        self.gauges = [Gauge(each, self.facts) for each in measures]
        claims = [each.claims for each in self.rules], [each.claims for each in self.gauges]
        self._masks = [[each.mask for each in some] for some in claims]
        self.shared = 0
        """Facts of which the number of robots matters."""
        for each in chain(*claims):
            self.shared |= each.shared
        self._kinds: dict[Hashable, Kind] = {}
        self._bits: dict[int, tuple[int, ...]] = {}
        self._about: dict[int, tuple[Sequence[int], Sequence[int]]] = {}

    def kind(self, actor: ActorLike) -> Kind:
        """Return the facts that the lines of a machine can change."""
        key = (actor.robot.role, tuple(actor.states), can_hold("has", actor))
        if key not in self._kinds:
            self._kinds[key] = self.facts.kind_of(actor)
        return self._kinds[key]

    def about(self, facts: int) -> tuple[Sequence[int], Sequence[int]]:
        """Return the numbers of the properties and of the measures that some facts can change."""
        found = self._about.get(facts)
        if found is None:
            sentences, gauges = (
                [number for number, mask in enumerate(masks) if mask & facts]
                for masks in self._masks
            )
            found = self._about[facts] = sentences, gauges
        return found

    def shared_bits(self, facts: int) -> tuple[int, ...]:
        """Return the bits of those facts of which the number of robots matters."""
        found = self._bits.get(facts)
        if found is None:
            shared = facts & self.shared
            bits = (1 << number for number in range(shared.bit_length()))
            found = self._bits[facts] = tuple([bit for bit in bits if bit & shared])
        return found
