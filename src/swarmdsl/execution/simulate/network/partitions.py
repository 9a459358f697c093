"""Partitions of the network of a simulation: groups of robots that do not reach one another."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from swarmdsl.execution.simulate.scenario.scenario import Robot

Groups = Sequence[tuple[str, ...]]
"""Groups of robots, each by the words that select them."""
_Partition = tuple[Groups, dict[str | None, int]]
"""Groups, and the number of its group for each robot in one, by its name."""


class Partitions:
    """The partitions at present; several may overlap."""

    def __init__(self) -> None:
        self.active: list[_Partition] = []

    def separate(self, one: Robot, other: Robot) -> bool:
        """Return True if two robots are in different groups of a partition."""
        for _, parted in self.active:
            mine, yours = parted.get(one.name), parted.get(other.name)
            if mine is not None and yours is not None and mine != yours:
                return True
        return False

    def begin(self, groups: Groups, robots: Iterable[Robot]) -> list[Robot]:
        """Begin a partition; return the robots in its groups."""
        found = [(robot, _group(robot, groups)) for robot in robots]
        parted = {robot.name: group for robot, group in found if group is not None}
        self.active.append((groups, parted))
        return [robot for robot, group in found if group is not None]

    def members(self, groups: Groups, robots: Iterable[Robot]) -> list[Robot]:
        """Return the robots in the groups of a partition."""
        _, parted = self._find(groups)
        return [robot for robot in robots if robot.name in parted]

    def end(self, groups: Groups) -> None:
        """End a partition."""
        self.active.remove(self._find(groups))

    def _find(self, groups: Groups) -> _Partition:
        return next(each for each in self.active if each[0] == groups)


def _group(robot: Robot, groups: Groups) -> int | None:
    """Return the group of a robot, by the most specific word that selects it."""
    for word in reversed(robot.words):
        for number, words in enumerate(groups):
            if word in words:
                return number
    return None
