"""Machines of YASMIN go the way of the engine."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from ..agreement.scripts import params
from ..ros2_outcomes.agreement import MODELS, Build, Twin, check_model, check_models_made_by_chance

SYSTEMS = 40


class Yasmin(Twin):
    """A machine in YASMIN."""

    target = "yasmin"
    stopped = "canceled"

    def prepare(self) -> None:
        import yasmin  # type: ignore[import-not-found]  # of the stand-in, or the real one

        self.machine.validate(True)
        self._blackboard = yasmin.Blackboard()

    def execute(self) -> Any:
        return self.machine(self._blackboard)

    def inside(self) -> Iterator[str]:
        return _inside(self.machine, "")

    def stop(self) -> None:
        self.chart.cancel()


def _inside(container: Any, path: str) -> Iterator[str]:
    states = container.get_states()
    if hasattr(container, "get_current_state"):
        current = container.get_current_state()
        states = {current: states[current]["state"]} if current else {}
    for name, state in states.items():
        found = f"{path}.{name}" if path else name
        yield found
        if hasattr(state, "get_states"):
            yield from _inside(state, found)


@pytest.mark.parametrize("path", params(MODELS))
def test_models(path: Path, build: Build) -> None:
    check_model(path, build, Yasmin)


@pytest.mark.filterwarnings("ignore:Generating overly large repr")
def test_models_made_by_chance(build: Build) -> None:
    check_models_made_by_chance(build, Yasmin, SYSTEMS)
