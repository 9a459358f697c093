"""Lines of a run for a recording: steps with variables, losses, verdicts, measures and places."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol

from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.expressions import SELF
from swarmdsl.execution.simulate.machines.json_numbers import named_numbers
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.network.packets import Transmission
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND
from swarmdsl.execution.simulate.world.line import Line, as_json
from swarmdsl.execution.simulate.world.world import World


class Recorder(Protocol):
    """Keeps the lines of a run, as they are in a trace."""

    def begin(
        self, subject: Subject, cast: Sequence[Actor], scenario: Path | None, world: World
    ) -> None:
        """Note who runs, in which scenario and world, before the world begins."""

    def write(self, text: str, /) -> object:
        """Keep a line, which ends with a newline."""

    def end(self, time: int) -> None:
        """Note when the run was over, in nanoseconds."""


class Changes:
    """Variables of machines, as far as they change."""

    def __init__(self) -> None:
        self._told: dict[Actor, dict[str, str]] = {}

    def of(self, actor: Actor, data: Any) -> dict[str, Any]:
        """Return the variables and params that have changed since the last call.

        What the world keeps beside them in the data of a machine is the robot itself, or has no
        identifier.
        """
        if not isinstance(data, Mapping):
            return {}
        told = self._told.setdefault(actor, {})
        changed = {}
        for name, value in data.items():
            if name == SELF or not name.isidentifier():
                continue
            text = json.dumps(named_numbers(value), ensure_ascii=False, default=str)
            if told.get(name) != text:
                told[name] = text
                changed[name] = json.loads(text)
        return changed


class RunLines:
    """Make the lines of a run.

    A step also has `variables`, those that it has changed. A line with `lost` is a swarm event that
    did not reach a robot.
    """

    def __init__(self, world: World, write: Callable[[str], object]) -> None:
        self._world = world
        self._write = write
        self._changes = Changes()

    def step(self, line: Line) -> None:
        """Write a step, with the variables that it has changed."""
        changed = self._changes.of(line.actor, self._world.data(line.actor))
        self._write(f"{as_json(line, {'variables': changed} if changed else None)}\n")

    def transmitted(self, crossing: Transmission) -> None:
        """Write a swarm event that gets lost."""
        if crossing.arrives:
            return
        lost = {
            "event": crossing.event,
            "sender": crossing.source.name,
            "member": crossing.target.name,
            "sent": crossing.sent,
        }
        self._tell(self._world.clock.now, {"lost": lost})

    def verdict(self, name: str, verdict: str, time: int) -> None:
        """Write a verdict so far on a property."""
        self._tell(time, {"property": name, "verdict": verdict})

    def _tell(self, time: int, about: Mapping[str, object]) -> None:
        line = {"t": time // MILLISECOND, **about}
        self._write(f"{json.dumps(line, ensure_ascii=False)}\n")
