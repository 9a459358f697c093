"""Reason why a robot has too many states: what its states differ in, and what to bound."""

from __future__ import annotations

from swarmdsl.execution.verify.automata.automaton import Automaton
from swarmdsl.execution.verify.swarm.model import Model

_MOST = 3
"""Number of parts that are named."""


def explain(large: Automaton, model: Model) -> str:
    """Return `: bound X` for a variable that grows, or else in what the states differ, or ""."""
    growing = _growing(large, model)
    if growing is not None:
        return f": bound `{growing}`"
    names = sorted({name for names in large.deferred for name in names})
    deferred = ", ".join(f"`{name}`" for name in names)
    active, waiting = map(set, zip(*large.parts(), strict=True))
    parts = [
        (len(active), "combinations of active states"),
        (len(waiting), f"combinations of deferred events ({deferred})"),
        *((n, f"values of `{name}`") for name, n in large.numbers_of_values().items()),
    ]
    largest = sorted((each for each in parts if each[0] > 1), reverse=True)[:_MOST]
    return ": " + ", ".join(f"{number} {what}" for number, what in largest) if largest else ""


def _growing(large: Automaton, model: Model) -> str | None:
    """Return the variable with the most values, if it is one of those that can grow without end.

    In other variables, and in other robots, there may be copies of one that grows.
    """
    growing: dict[str, int] = {}
    for automaton in model.kinds:
        for name, number in automaton.numbers_of_values().items():
            if name in model.demands.growing:
                growing[name] = max(number, growing.get(name, 0))
    best = max(growing, key=growing.__getitem__, default=None)
    most = max(large.numbers_of_values().values(), default=1)
    return best if best is not None and growing[best] >= max(most, 2) else None
