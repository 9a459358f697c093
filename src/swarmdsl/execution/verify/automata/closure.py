"""Search for all states of the automata of some robots."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.execution.verify.abstraction.alphabet import Alphabet
from swarmdsl.execution.verify.automata.automaton import Automaton
from swarmdsl.execution.verify.automata.limits import Budget, LimitReachedError


def close(
    automata: Sequence[Automaton], alphabet: Alphabet, states: int, moves: int, budget: Budget
) -> bool:
    """Find all states of some automata; return False if there are more.

    Each robot hears each message at any time: this includes whatever happens in a swarm. The
    search in an automaton ends at a number of states or moves, or with the time or memory.
    """
    try:
        complete = _closed(automata, alphabet, states, moves, budget)
    except LimitReachedError:
        complete = False
    for automaton in automata:
        automaton.bodies.clear()
    return complete


def _closed(
    automata: Sequence[Automaton], alphabet: Alphabet, states: int, moves: int, budget: Budget
) -> bool:
    changed = True
    complete = True
    while changed:
        changed = False
        for automaton in automata:
            number = 0
            while number < len(automaton.steps):
                is_known = automaton.steps[number] is not None
                automaton.is_too_large |= number >= states or automaton.replays >= moves
                if automaton.is_too_large or not (is_known or budget.allows(0)):
                    complete = False
                    break
                if not is_known:
                    automaton.expand(number)
                    changed = True
                for message in range(len(alphabet.messages)):
                    known = message in automaton.heard[number] or message in automaton.late[number]
                    if not known and automaton.listens(message):
                        budget.check()
                        automaton.hear(number, message)
                        changed = True
                number += 1
    return complete
