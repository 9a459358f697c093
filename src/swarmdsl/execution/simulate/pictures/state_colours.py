"""Colour of each state of a machine, by meaning; the same in every picture and page.

A state with an activity works and has a strong colour, one without waits and has a pale one, and a
final state is grey. States of a machine differ in hue, in document order. Colours depend on the
machine alone: a machine looks the same in every run and beside any other machines.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum

from swarmdsl.execution.engine import Kind, Machine, State

# Colour scheme "light" for areas below dark text, distinguishable by colour-blind people: Paul
# Tol, Colour Schemes, SRON/EPS/TN/09-002, issue 3.2. Neighbours differ.
_HUES = ("77aadd", "ee8866", "eedd88", "44bb99", "ffaabb", "99ddff", "bbcc33", "aaaa00")
_FINAL = "c3c7ce"


class Meaning(Enum):
    """Meaning of a state for a robot that is in it."""

    WORKS = "works"
    WAITS = "waits"
    ENDED = "has ended"


# Mix with this level of grey, by this share: one pair for each round through the hues.
_TONES = {
    Meaning.WORKS: ((255, 0.0), (0, 0.12), (255, 0.28)),
    Meaning.WAITS: ((255, 0.52), (255, 0.72), (255, 0.4)),
    Meaning.ENDED: ((255, 0.0), (255, 0.35), (0, 0.1)),
}


def meaning_of(state: State) -> Meaning:
    """Return the meaning of a state without states in it."""
    if state.kind is Kind.FINAL:
        return Meaning.ENDED
    return Meaning.WORKS if state.activity is not None else Meaning.WAITS


def state_colours(machine: Machine) -> Mapping[str, str]:
    """Return the colours of the innermost states of a machine, by id: `#77aadd`."""
    found = {}
    seen = {True: 0, False: 0}
    for state in machine.states[1:]:
        if state.states or state.kind in (Kind.HISTORY, Kind.DEEP_HISTORY):
            continue
        meaning = meaning_of(state)
        ended = meaning is Meaning.ENDED
        found[state.id] = nth_colour(seen[ended], meaning)
        seen[ended] += 1
    return found


def nth_colour(number: int, meaning: Meaning = Meaning.WORKS) -> str:
    """Return a colour of a meaning; hues repeat in other tones."""
    hues = (_FINAL,) if meaning is Meaning.ENDED else _HUES
    tones = _TONES[meaning]
    hue = hues[number % len(hues)]
    towards, share = tones[number // len(hues) % len(tones)]
    parts = (int(hue[at : at + 2], 16) for at in (0, 2, 4))
    return "#" + "".join(f"{round(part + (towards - part) * share):02x}" for part in parts)
