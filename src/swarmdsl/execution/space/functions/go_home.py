"""Go home: to the place where the robot started, or to another one."""

from __future__ import annotations

from swarmdsl.execution.space.arrays import Rows
from swarmdsl.execution.space.functions.base import Arguments
from swarmdsl.execution.space.functions.go_to import GoTo


class GoHome(GoTo):
    """Go to a place; fields of a goal are 0 if nothing is said, and then it is the first place."""

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Find the way home."""
        to, stage = arguments["to"], self.stage
        for number, row in enumerate(who.tolist()):
            home = float(stage.home_x[row]), float(stage.home_y[row]), 0.0
            place = to if to is not None and any(to) else home
            super().start(who[number : number + 1], {**arguments, "to": place})
            if arguments["end"] is not None and stage.flies[row]:
                self._way[row].append((place[0], place[1], arguments["end"]))
                self._turns[row] = True
