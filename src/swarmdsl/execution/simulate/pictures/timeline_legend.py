"""Legend of a timeline: signs and their meanings, then the states of each machine."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from typing import NamedTuple

from swarmdsl.execution.engine import Kind, Machine
from swarmdsl.execution.simulate.pictures.state_colours import Meaning, meaning_of, nth_colour
from swarmdsl.execution.simulate.pictures.svg import LETTER, Drawing
from swarmdsl.execution.simulate.pictures.timeline_arrows import Fate

HATCHED = "url(#lost)"
"""Filling of a lost member."""
MERGED = "#8a8f98"
"""Filling of stays that are too short to see."""
_ROW = 18
_ARROWS = {Fate.TAKEN: "swarm event", Fate.IGNORED: "ignored", Fate.LOST: "lost on its way"}


class Shown(NamedTuple):
    """Contents of a timeline that its legend explains: entered states, fates of swarm events."""

    entered: Mapping[Machine, Collection[str]]
    colours: Mapping[Machine, Mapping[str, str]]
    fates: Collection[Fate]
    bundled: bool
    lost: bool
    merged: bool


class _Item(NamedTuple):
    """Sign and word of a legend; without a sign, the name of a machine."""

    x: float
    y: float
    word: str
    colour: str = ""
    fate: Fate | None = None
    comb: bool = False


class Legend:
    """Rows of a legend in a width, below a height."""

    def __init__(self, shown: Shown, width: float, top: float) -> None:
        self._width = width
        self._items: list[_Item] = []
        longest = max((len(machine.name) for machine in shown.colours), default=0)
        self._indent = 32 + 1.15 * LETTER * longest
        self._y = top
        self._row("", self._signs(shown))
        for machine, colours in shown.colours.items():
            entered = [state for state in colours if state in shown.entered[machine]]
            self._row(machine.name, (_Item(0, 0, state, colours[state]) for state in entered))
        self.bottom = self._y - 4

    def draw(self, drawing: Drawing) -> None:
        """Draw all rows."""
        for x, y, word, colour, fate, comb in self._items:
            if colour:
                drawing.bar(x, y, 11, 11, colour, word)
            elif comb:
                marks = [(x + 6, y + 12, True, Fate.TAKEN.value)]
                drawing.comb([(x + 6, y, y + 12)], marks, "spine", 3, word)
            elif fate is not None:
                drawing.arrow(x - 10, y + 6, x + 9, y + 6, fate.value, 1, word)
            else:
                drawing.text(16, y + 10, word, "machine")
                continue
            drawing.text(x + 16, y + 10, word, "legend")

    def _row(self, name: str, items: Iterable[_Item]) -> None:
        """Place items side by side, in one line or more."""
        if name:
            self._items.append(_Item(16, self._y, name))
        x = self._indent
        for item in items:
            width = 34 + LETTER * len(item.word)
            if x + width > self._width and x > self._indent:
                x, self._y = self._indent, self._y + _ROW
            self._items.append(item._replace(x=x, y=self._y))
            x += width
        self._y += _ROW + 4

    def _signs(self, shown: Shown) -> list[_Item]:
        """Return the signs that occur."""
        meanings = {
            meaning_of(state)
            for machine, entered in shown.entered.items()
            for state in machine.states
            if state.id in entered and state.kind is not Kind.HISTORY
        }
        found = [
            _Item(0, 0, meaning.value, nth_colour(0, meaning))
            for meaning in Meaning
            if meaning in meanings
        ]
        if shown.lost:
            found.append(_Item(0, 0, "lost member", HATCHED))
        if shown.merged:
            found.append(_Item(0, 0, "several short stays", MERGED))
        found += [
            _Item(0, 0, word, fate=fate) for fate, word in _ARROWS.items() if fate in shown.fates
        ]
        if shown.bundled:
            found.append(_Item(0, 0, "several from one sender", comb=True))
        return found
