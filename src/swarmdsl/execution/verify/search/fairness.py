"""Fairness of a swarm: what is running, and what is over after a step.

What is running is over some time: each activity and delay ends or is cancelled, each event that a
robot has sent to itself is handled, and each message arrives or is lost.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from swarmdsl.execution.verify.swarm.groups import Step
from swarmdsl.execution.verify.swarm.network import Network


class Fairness:
    """Tasks of the robots of a network, as sets of bits.

    A run is unfair if a task is running in all of its states from some time on, and is over after
    none of its steps. Of robots that only their number tells apart, this finds some unfair runs:
    those in which no robot of a group, or no robot at a place, ends a task.
    """

    def __init__(self, network: Network) -> None:
        self._network = network
        self._bits: dict[Any, int] = {}
        self._running: dict[int, int] = {}

    def running(self, state: int) -> int:
        """Return what is running in a state."""
        found = 0
        for place, _ in self._network.present(state):
            found |= self._at(place)
        return found

    def load(self, state: int) -> int:
        """Return the number of tasks and messages of all robots in a state."""
        network = self._network
        return sum(len(self._tasks(place)) * count for place, count in network.present(state))

    def over(self, state: int, step: Step) -> int:
        """Return what is over after a step from a state."""
        network = self._network
        group, _, bag = network.places[step.place]
        automaton = network.groups[group].automaton
        move = step.move
        tasks: list[Any] = []
        if move is None:
            tasks.append(step.lost)
        else:
            tasks += move.ended
            if move.given.kind == "hear":
                tasks.append(move.given.choice)
            if automaton.ended(network.places[step.target].state):
                tasks += bag
        found = 0
        for task in tasks:
            found |= self._bit((group, task))
        if len(network.groups[group].robots) > 1 and (tasks or step.target != step.place):
            found |= self._bit(step.place)
        heard = network.heard(step)
        if heard:
            for place, _ in network.present(state):
                if network.shift_of(place, heard, group):
                    found |= self._bit(place)
        return found

    def _at(self, place: int) -> int:
        """Return what is running at a place: tasks, and messages that are on their way."""
        found = self._running.get(place)
        if found is None:
            found = 0
            group = self._network.places[place].group
            for task in self._tasks(place):
                found |= self._bit((group, task))
            if found and len(self._network.groups[group].robots) > 1:
                found |= self._bit(place)
            self._running[place] = found
        return found

    def _tasks(self, place: int) -> Sequence[Any]:
        """Return the tasks of a robot at a place, and the messages on their way to it."""
        group, state, bag = self._network.places[place]
        automaton = self._network.groups[group].automaton
        messages = map(self._network.message, bag)
        # A deferred event waits as long as the robot defers it.
        return (
            *automaton.tasks(state),
            *(each for each in messages if not automaton.is_late(state, each)),
        )

    def _bit(self, key: Any) -> int:
        return self._bits.setdefault(key, 1 << len(self._bits))
