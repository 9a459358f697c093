"""Automata of sentences, made from their monitors as runs need them.

Its states are monitors without times: a clock is only running or not. All robots, and all runs,
share an automaton.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import NamedTuple

from .monitor import Monitor, Sentence, Verdict

NEVER = 1 << 62
"""Time at which the clock of a state is due; a clock that has just begun is due earlier."""
MOST_CLAIMS = 6
"""Number of claims up to which all combinations of their truth are tried."""


class Move(NamedTuple):
    """Step to a state; with `begins`, its clock begins then."""

    target: State
    begins: bool


class State:
    """State of an automaton; `moves` are the known steps, by the facts that hold then."""

    def __init__(self, monitor: Monitor) -> None:
        self.monitor = monitor
        self.is_violated = monitor.violated is not None
        self.is_timed = monitor.clock is not None
        """True if a clock is running."""
        self.verdict: Verdict = monitor.state
        self.moves: dict[int, Move] = {}
        self.stay = Move(self, begins=False)
        self.ends: dict[bool, tuple[Verdict, State]] = {}


class Automaton:
    """Deterministic automaton of a sentence with a number of claims, and claims of the scope."""

    def __init__(self, sentence: Sentence, claims: int, scope: int) -> None:
        self.within = sentence.within or 0
        self._claims = claims
        self._scope = scope
        self._states: dict[tuple[object, ...], State] = {}
        self._final: dict[State, bool] = {}
        self.first = self._reached(Monitor(sentence)).target

    def step(self, state: State, truths: Sequence[bool]) -> Move:
        """Return the step of a state, with the truth of the claims and of those of the scope."""
        monitor = state.monitor.copy()
        number = self._claims
        monitor.step(0, truths[:number], truths[number:])
        move = self._reached(monitor)
        return state.stay if move == state.stay else move

    def late(self, state: State) -> State:
        """Return the state after the time of the clock has passed."""
        monitor = state.monitor.copy()
        monitor.advance(NEVER + 1)
        return self._reached(monitor).target

    def end(self, state: State, *, ended: bool) -> tuple[Verdict, State]:
        """Return the verdict at the end of a run, and the state then."""
        if ended not in state.ends:
            monitor = state.monitor.copy()
            verdict = monitor.finish(0, ended=ended)
            state.ends[ended] = verdict, self._reached(monitor).target
        return state.ends[ended]

    def is_final(self, state: State) -> bool:
        """Return True if it is known that no step leads out of a state."""
        found = self._final.get(state)
        if found is None:
            number = self._claims + self._scope
            found = state.monitor.decided
            if not found and not state.is_timed and number <= MOST_CLAIMS:
                every = product((False, True), repeat=number)
                found = all(self.step(state, truths) is state.stay for truths in every)
            self._final[state] = found
        return found

    def _reached(self, monitor: Monitor) -> Move:
        begins = monitor.clock not in (None, NEVER)
        monitor.forget_times(NEVER)
        key = (monitor.memory, monitor.history)
        state = self._states.get(key)
        if state is None:
            state = self._states[key] = State(monitor)
        return Move(state, begins)
