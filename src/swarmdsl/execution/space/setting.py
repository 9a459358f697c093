"""Setting of a space: its layout, and the models of the functions of each robot."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from swarmdsl.base.records import dataclass, field
from swarmdsl.execution.engine import ExecutionError
from swarmdsl.execution.simulate.machines.expressions import Value, function_of
from swarmdsl.execution.simulate.machines.machine_data import stored
from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.execution.simulate.scenario.scenario import Robot, Scenario
from swarmdsl.execution.space.functions.base import Model
from swarmdsl.execution.space.layout import Layout
from swarmdsl.execution.space.messages import path_in, place_in
from swarmdsl.execution.space.motion import Motion
from swarmdsl.execution.space.robots import Robots
from swarmdsl.ir import Function, System
from swarmdsl.ir.function_models import NAMES, Argument

if TYPE_CHECKING:
    from swarmdsl.execution.space.stage import Stage

_HEIGHTS, _SPEEDS = ("altitude", "height"), ("speed", "velocity")


@dataclass(frozen=True)
class Kind:
    """Model of the catalogue or of a project: its arguments, and how it is made."""

    name: str
    arguments: tuple[Argument, ...]
    make: Callable[[Stage], Model]


@dataclass(frozen=True, eq=False)
class Use:
    """Model that a function of a robot has, with what computes its arguments from a goal."""

    function: str
    kind: Kind
    given: tuple[tuple[str, Value], ...]
    params: Mapping[str, Any]

    def arguments(self, goal: Any) -> dict[str, Any]:
        """Return the arguments of a call.

        Raises ExecutionError, ArithmeticError or ValueError for one without a value.
        """
        fields = goal if isinstance(goal, Mapping) else {}
        data = {**self.params, **fields}
        values = {name: value(data, None) for name, value in self.given}
        return {
            each.name: _converted(each, values[each.name])
            if each.name in values
            else _default(each, fields)
            for each in self.kind.arguments
        }


@dataclass(frozen=True)
class Setting:
    """Data that all runs of a space share."""

    layout: Layout
    system: System
    scenario: Scenario
    kinds: Mapping[str, Kind]
    motion: Callable[[Robots], Motion] = Motion
    """Maker of what moves the robots of some runs."""
    _uses: dict[tuple[str, str | None], Use | None] = field(default_factory=dict)

    def use(self, function: str, robot: Robot) -> Use | None:
        """Return the model of a function of a robot; None if it has none."""
        found = (function, robot.name)
        if found not in self._uses:
            self._uses[found] = self._find(function, robot)
        return self._uses[found]

    def _find(self, name: str, robot: Robot) -> Use | None:
        function = self.system.functions_by_name.get(name)
        if function is None:
            return None
        params = _params(function, self.system)
        said = self.scenario.model(name, robot)
        if said is not None:
            if said.model is None:
                return None
            constants = tuple((key, _constant(value)) for key, value in said.arguments.items())
            return Use(name, self.kinds[said.model], constants, params)
        if function.model is None or function.model.name not in self.kinds:
            return None
        given = tuple((key, function_of(value)) for key, value in function.model.arguments)
        return Use(name, self.kinds[function.model.name], given, params)


def _params(function: Function, system: System) -> dict[str, Any]:
    """Return the params of a function that have a value."""
    found: dict[str, Any] = {}
    for param in function.params:
        if param.default is not None:
            found[param.name] = stored(param.default, param.type, system)(found, None)
    return found


def _constant(value: Any) -> Value:
    return lambda data, event: value


def _converted(argument: Argument, value: Any) -> Any:
    """Return a value as the model takes it; times are in seconds."""
    if argument.kind == "place":
        place = value if isinstance(value, tuple) else place_in(value)
        if place is None:
            raise ExecutionError(f"argument `{argument.name}` is no place")
        return place
    if argument.kind == "path":
        path = value if isinstance(value, tuple) else path_in(value)
        if path is None:
            raise ExecutionError(f"argument `{argument.name}` is no path")
        return path
    if argument.kind in NAMES:
        if argument.choices and value not in argument.choices:
            choices = " or ".join(f"`{each}`" for each in argument.choices)
            raise ExecutionError(f"argument `{argument.name}` is {value!r}, not {choices}")
        return str(value)
    number = float(value)
    if not math.isfinite(number):
        raise ExecutionError(f"argument `{argument.name}` is not finite")
    number = number / SECOND if argument.kind == "time" else number
    limits = argument.limits(number)
    if limits is not None:
        raise ExecutionError(f"argument `{argument.name}` is {number:g}: it must be {limits}")
    return number


def _default(argument: Argument, goal: Mapping[str, Any]) -> Any:
    """Return the default of an argument, or what the goal says of it by its structure."""
    if argument.default is not None:
        return _converted(argument, argument.default)
    if argument.kind == "place":
        return place_in(goal)
    if argument.kind == "path":
        return path_in(goal)
    if argument.kind in NAMES:
        said = goal.get(argument.name)
        return said if isinstance(said, str) and said else None
    names = {"height": _HEIGHTS, "speed": _SPEEDS}.get(argument.name, ())
    found = next((goal[name] for name in names if _is_given(goal.get(name))), None)
    return _converted(argument, found) if found is not None else None


def _is_given(value: Any) -> bool:
    """Return True for a number other than 0, which fields have where nothing is said."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and value != 0
