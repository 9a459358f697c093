"""Random turns of walkers, computed for some turns ahead.

To compute one turn takes NumPy as long as to compute hundreds, and in most steps somebody turns.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from swarmdsl.execution.space.arrays import Flags, Floats, Rows
from swarmdsl.execution.space.hashing import key, mixed, numbered
from swarmdsl.execution.space.turning import direction

if TYPE_CHECKING:
    from swarmdsl.execution.space.stage import Stage

_AHEAD = 16
"""Number of turns that are computed at a time."""
_AT_ONCE = 512
"""Number of robots for which they are computed at a time, which bounds the memory that it takes."""


class Turns:
    """Turns of each robot, by an angle of an interval or by any, and lengths of legs.

    They depend on the robot and the number of its turn alone.
    """

    def __init__(self, name: str, stage: Stage) -> None:
        questions = [[key(name, "direction")], [key(name, "length")]]
        self._asked = mixed(stage.keys ^ np.array(questions, dtype=np.uint64))
        self._taken = np.zeros(stage.rows, dtype=np.int64)
        """Number of turns that each robot has taken."""
        self._next = np.full(stage.rows, _AHEAD)
        """Place of the next one among those that have been computed."""
        self._width = np.zeros(stage.rows)
        self._cosine, self._sine = np.zeros((2, 2, stage.rows, _AHEAD))
        self._length = np.zeros((stage.rows, _AHEAD))

    def begin(self, who: Rows, width: Floats | float) -> None:
        """Let robots turn by angles of an interval of this width from now on."""
        self._width[who] = width
        self._next[who] = _AHEAD

    def take(self, who: Rows, freely: Flags) -> tuple[Floats, Floats, Floats]:
        """Return cosine and sine of the next turns, and a number up to 1 for the lengths of legs.

        Robots turn `freely` to any direction.
        """
        out = who[self._next[who] == _AHEAD]
        for first in range(0, len(out), _AT_ONCE):
            self._compute(out[first : first + _AT_ONCE])
        place, kind = self._next[who], freely.astype(np.int64)
        self._next[who] = place + 1
        self._taken[who] += 1
        return (
            self._cosine[kind, who, place],
            self._sine[kind, who, place],
            self._length[who, place],
        )

    def _compute(self, who: Rows) -> None:
        counts = self._taken[who][:, None] + np.arange(1, _AHEAD + 1)
        turn, self._length[who] = numbered(self._asked[:, who, None], counts)
        for kind, width in enumerate((self._width[who][:, None], 2 * math.pi)):
            cosine, sine = direction((width * (turn - 0.5)).ravel())
            self._cosine[kind, who] = cosine.reshape(turn.shape)
            self._sine[kind, who] = sine.reshape(turn.shape)
        self._next[who] = 0
