"""Functions without a model, which the world ends as the scenario says."""

from __future__ import annotations

from collections import Counter

from swarmdsl.execution.engine import Run
from swarmdsl.execution.simulate.scenario.clock import Alarm, Clock
from swarmdsl.execution.simulate.scenario.random_source import RandomSource
from swarmdsl.execution.simulate.scenario.scenario import Robot, Scenario
from swarmdsl.execution.simulate.scenario.space import Ended


class Scripted:
    """Calls of functions that have a duration or outcomes in the scenario, as in a simulation."""

    def __init__(self, clock: Clock, scenario: Scenario, chance: RandomSource) -> None:
        self._clock = clock
        self._scenario = scenario
        self._chance = chance
        self._calls: Counter[tuple[Robot, str]] = Counter()
        self._ends: dict[Run, Alarm | None] = {}

    def says(self, function: str, robot: Robot) -> bool:
        """Return True if the scenario says how a function of a robot ends."""
        said = self._scenario.model(function, robot)
        return said is not None and said.model is None

    def start(self, run: Run, robot: Robot, ended: Ended) -> bool:
        """Start a function that is not in space, if the scenario says how it ends."""
        function = run.activity.name
        if not self.says(function, robot):
            return False
        self._calls[robot, function] += 1
        call = self._calls[robot, function]
        answer = self._scenario.behavior(function, robot).draw(
            lambda: self._chance.stream(robot.name, function, call)
        )
        self._ends[run] = None
        outcome = answer.outcome
        if outcome is not None:
            self._ends[run] = self._clock.schedule(
                answer.duration, lambda: ended(run, outcome, answer.result)
            )
        return True

    def stop(self, run: Run) -> None:
        """Stop a function that was started here."""
        alarm = self._ends.pop(run, None)
        if alarm is not None:
            self._clock.unschedule(alarm)
