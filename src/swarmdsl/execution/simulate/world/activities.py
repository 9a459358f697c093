"""Calls of functions in a simulated world: their outcomes, response times and silences."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from typing import Any

from swarmdsl.codegen.shared.default_values import default_result
from swarmdsl.execution.engine import InstanceLike, Run
from swarmdsl.execution.simulate.scenario.clock import Alarm, Clock
from swarmdsl.execution.simulate.scenario.durations import draw
from swarmdsl.execution.simulate.scenario.random_source import RandomSource
from swarmdsl.execution.simulate.scenario.scenario import (
    EVERY_FUNCTION,
    FunctionBehavior,
    Robot,
    Scenario,
)
from swarmdsl.execution.simulate.scenario.space import ABSTRACT, Space
from swarmdsl.ir import System


class Activities:
    """Running activities of all machines; `robot_of` returns the robot of one."""

    def __init__(
        self,
        clock: Clock,
        scenario: Scenario,
        chance: RandomSource,
        system: System | None,
        robot_of: Callable[[Run], Robot],
        space: Space = ABSTRACT,
    ) -> None:
        self._space = space
        self.outcomes: Counter[tuple[str, str]] = Counter()
        """Outcomes by function and outcome."""
        self._clock = clock
        self._scenario = scenario
        self._chance = chance
        self._system = system
        self._robot_of = robot_of
        self._calls: Counter[tuple[str | None, str]] = Counter()
        self._ends: dict[Run, Alarm | None] = {}
        self._silent: Counter[tuple[Robot, str]] = Counter()
        """Number of current silences of a function."""
        self._unheard: list[Run] = []
        """Runs that were cancelled during a silence."""
        self._behaviors: dict[tuple[str, str | None], FunctionBehavior] = {}
        self._blanks: dict[str, Mapping[str, Any]] = {}

    def of(self, instance: InstanceLike) -> list[Run]:
        """Return the running activities of an instance."""
        return [run for run in self._ends if run.instance is instance]

    def start(self, run: Run) -> None:
        """Start an activity, with a random end."""
        robot, function = self._robot_of(run), run.activity.name
        self._calls[robot.name, function] += 1
        call = self._calls[robot.name, function]
        if self._space.start(run, robot):
            self._ends[run] = None
            return
        answer = self._behavior(function, robot).draw(
            lambda: self._chance.stream(robot.name, function, call)
        )
        self._ends[run] = None
        if answer.outcome is None or self._is_silent(robot, function):
            return
        data = None
        if answer.outcome == "succeeded":
            data = {**self._blank(function), **answer.result}
        name = run.activity.events[answer.outcome]
        self._ends[run] = self._clock.schedule(answer.duration, lambda: self.end(run, name, data))

    def cancel(self, run: Run) -> None:
        """Stop an activity, after the time given in the scenario."""
        robot, function = self._robot_of(run), run.activity.name
        self.outcomes[function, "cancelled"] += 1
        self._leave(run)
        if self._is_silent(robot, function):
            self._unheard.append(run)
        else:
            self._stop(run)

    def end(self, run: Run, event: str, data: Any) -> None:
        """End an activity with one of its events."""
        if data is None and event == run.activity.events["succeeded"]:
            data = self._blank(run.activity.name)
        outcome = self._outcome(run, event, data)
        self.outcomes[run.activity.name, outcome] += 1
        self._leave(run)
        run.end(outcome, data)

    def end_as(self, run: Run, outcome: str, fields: Mapping[str, Any]) -> None:
        """End an activity as a space says, unless it answers no more."""
        robot, function = self._robot_of(run), run.activity.name
        if run not in self._ends or self._is_silent(robot, function):
            return
        data = None
        if outcome == "succeeded":
            given = self._behavior(function, robot).results
            data = {**self._blank(function), **(given[0] if given else {}), **fields}
        self.end(run, run.activity.events[outcome], data)

    def silence(self, robot: Robot, function: str, lasts: int | None) -> None:
        """Let a function of a robot answer no more, for a time."""
        self._silent[robot, function] += 1
        for run, alarm in self._ends.items():
            if self._robot_of(run) is robot and self._is_silent(robot, run.activity.name):
                if alarm is not None:
                    self._clock.unschedule(alarm)
                self._ends[run] = None
                self._space.stop(run)
        if lasts is not None:
            self._clock.schedule(lasts, lambda: self._answer(robot, function))

    def forget(self, robot: Robot) -> None:
        """Remove the activities of a lost robot."""
        for run in [run for run in self._ends if self._robot_of(run) is robot]:
            self._leave(run)

    def _answer(self, robot: Robot, function: str) -> None:
        """End a silence, and stop the runs that were cancelled during it."""
        self._silent[robot, function] -= 1
        unheard, self._unheard = self._unheard, []
        for run in unheard:
            if self._is_silent(self._robot_of(run), run.activity.name):
                self._unheard.append(run)
            else:
                self._stop(run)

    def _leave(self, run: Run) -> None:
        alarm = self._ends.pop(run)
        self._space.stop(run)
        if alarm is not None:
            self._clock.unschedule(alarm)

    def _is_silent(self, robot: Robot, function: str) -> bool:
        return bool(self._silent) and any(
            self._silent[robot, name] for name in (function, EVERY_FUNCTION)
        )

    def _stop(self, run: Run) -> None:
        robot, function = self._robot_of(run), run.activity.name
        call = self._calls[robot.name, function]
        delay = draw(
            self._behavior(function, robot).stopping,
            lambda: self._chance.stream(robot.name, function, call, "stops"),
        )
        self._clock.schedule(delay, lambda: run.end("preempted"))

    def _behavior(self, function: str, robot: Robot) -> FunctionBehavior:
        found = self._behaviors.get((function, robot.name))
        if found is None:
            found = self._scenario.behavior(function, robot)
            self._behaviors[function, robot.name] = found
        return found

    def _blank(self, function: str) -> Mapping[str, Any]:
        """Return the default result of a function."""
        if self._system is None:
            return {}
        if function not in self._blanks:
            call = self._system.function(function).communication
            self._blanks[function] = default_result(call, self._system)
        return self._blanks[function]

    def _outcome(self, run: Run, event: str, data: Any) -> str:
        """Return the outcome of an end event: a service response may report failure."""
        outcome = next(each for each, name in run.activity.events.items() if name == event)
        if outcome != "succeeded" or self._system is None or not isinstance(data, Mapping):
            return outcome
        if data.get("success") is not False:
            return outcome
        call = self._system.function(run.activity.name).communication
        return run.activity.refused if call.paradigm == "service" else outcome
