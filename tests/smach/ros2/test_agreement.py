"""Machines of SMACH in packages for ROS 2 go the way of the engine."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from ...agreement.scripts import params
from ...ros2_outcomes.agreement import MODELS, Build, Twin, check_model, check_models_made_by_chance
from ..active import running

SYSTEMS = 6
MOST = 8


class Smach(Twin):
    """A machine in SMACH."""

    target = "smach"
    options = {"ros": "2"}
    stopped = "preempted"

    def prepare(self) -> None:
        self.machine.check_consistency()

    def execute(self) -> Any:
        return self.machine.execute()

    def inside(self) -> Iterator[str]:
        return _inside(self.machine, "")

    def stop(self) -> None:
        if self.outcome is None:  # later it would be about the next run
            self.machine.request_preempt()


def _inside(container: Any, path: str) -> Iterator[str]:
    for label in running(container):
        found = f"{path}.{label}" if path else label
        yield found
        child = container.get_children()[label]
        if hasattr(child, "get_children"):
            yield from _inside(child, found)


@pytest.mark.parametrize("path", params(MODELS))
def test_models(path: Path, build: Build) -> None:
    check_model(path, build, Smach, MOST)


@pytest.mark.filterwarnings("ignore:Generating overly large repr")
def test_models_made_by_chance(build: Build) -> None:
    check_models_made_by_chance(build, Smach, SYSTEMS)
