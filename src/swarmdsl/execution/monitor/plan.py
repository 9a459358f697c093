"""Properties and measures with the facts that they are about, without those of a run."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Sequence
from itertools import chain

from .claims import Measure, Property
from .facts import ActorLike, Facts, Kind, can_hold
from .joint import Joint
from .meters import Gauge
from .rule import Rule


class Plan:
    """Properties and measures with the facts that they are about, for any number of runs."""

    def __init__(self, properties: Iterable[Property], measures: Iterable[Measure] = ()) -> None:
        self.facts = Facts()
        self.rules = [Rule(each, self.facts) for each in properties]
        self.gauges = [Gauge(each, self.facts) for each in measures]
        self.shared = 0
        """Facts of which the number of robots matters."""
        for claims in chain(
            (each.claims for each in self.rules), (each.claims for each in self.gauges)
        ):
            self.shared |= claims.shared
        self._joints: dict[str, Joint] = {}
        self.swarm_rules = [n for n, each in enumerate(self.rules) if not _is_alone(each)]
        """Numbers of the properties that are not in a joint automaton."""
        self._kinds: dict[Hashable, Kind] = {}
        self._bits: dict[int, tuple[int, ...]] = {}
        self.known: dict[int, tuple[Sequence[int], Sequence[int]]] = {}
        """Results of `about`, by facts."""

    def kind(self, actor: ActorLike) -> Kind:
        """Return the facts that the lines of a machine can change."""
        functions = tuple(actor.functions)
        key = (actor.robot.role, tuple(actor.states), functions, can_hold("has", actor))
        if key not in self._kinds:
            self._kinds[key] = self.facts.kind_of(actor)
        return self._kinds[key]

    def joint(self, role: str) -> Joint:
        """Return the joint automaton of the properties about each robot of a role alone."""
        found = self._joints.get(role)
        if found is None:
            rules = [(n, each) for n, each in enumerate(self.rules) if each.each == role]
            alone = [(number, rule) for number, rule in rules if _is_alone(rule)]
            found = self._joints[role] = Joint(alone, self.facts.momentary, self.shared_bits)
        return found

    def about(self, facts: int) -> tuple[Sequence[int], Sequence[int]]:
        """Return the numbers of the properties and of the measures that some facts can change.

        Those in joint automata are left out.
        """
        found = self.known.get(facts)
        if found is None:
            sentences = [n for n in self.swarm_rules if self.rules[n].claims.mask & facts]
            gauges = [n for n, each in enumerate(self.gauges) if each.claims.mask & facts]
            found = self.known[facts] = sentences, gauges
        return found

    def shared_bits(self, facts: int) -> tuple[int, ...]:
        """Return the bits of those facts of which the number of robots matters."""
        found = self._bits.get(facts)
        if found is None:
            shared = facts & self.shared
            bits = (1 << number for number in range(shared.bit_length()))
            found = self._bits[facts] = tuple([bit for bit in bits if bit & shared])
        return found


def _is_alone(rule: Rule) -> bool:
    """Return True if a property is about each robot, and nothing of the others matters."""
    return rule.each is not None and not rule.claims.shared
