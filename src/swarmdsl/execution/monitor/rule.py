"""A property with its automaton, without anything of a run."""

from __future__ import annotations

from dataclasses import replace

from .automaton import Automaton, Move, State
from .claims import Property
from .facts import Facts
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
