"""Robots that tell their models, and refuse robots of another one, on a real ROS 2."""

from __future__ import annotations

import json
import shutil
import signal
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from .conftest import load_module

PATIENCE: float = load_module("harness").PATIENCE

MODELS = "/night/models"


@pytest.fixture
def other(packages: list[Path], tmp_path: Path) -> Path:
    """The package with the behaviours, generated from another model."""
    (package,) = (path for path in packages if path.name == "lab_behavior")
    made = tmp_path / "other" / package.name
    shutil.copytree(package, made)
    module = made / package.name / "model.py"
    text = module.read_text(encoding="utf-8")
    (line,) = (line for line in text.splitlines() if line.startswith("DIGEST = "))
    module.write_text(text.replace(line, "DIGEST = 'other'"), encoding="utf-8")
    return made


def guard(ros: Any, number: int, **parameters: Any) -> Any:
    """Start the node of a guard; nobody is expected."""
    return ros.node(
        "lab_behavior.guarding",
        f"/night/guard_{number}",
        member=f"guard[{number}]",
        heartbeat__period=0.2,
        heartbeat__timeout=60.0,
        heartbeat__members="guard[0]",
        **parameters,
    )


def test_robots_refuse_those_of_another_model(ros: Any, other: Path) -> None:
    fakes = ros.fakes()
    first = guard(ros, 0, model__others="refuse", model__wait=0.1)
    first.wait_in("Watch")
    own = dict(ros.environment)
    ros.prefer(other)
    late = guard(ros, 1, model__others="refuse")

    # It begins nothing, and its heartbeats do not count.
    assert late.exit_code() == 1
    assert "refused to begin with lab 0.1.0 (other): guard[0] has lab 0.1.0 (" in late.log
    assert late.trace == []
    # Told also to those that come later.
    fakes.do("subscribe", topic=MODELS, kind="std_msgs/msg/String", latched=True)
    told = json.loads(fakes.wait("message", MODELS)["data"]["data"])
    assert told.pop("digest") != "other"
    assert told == {
        "node": "/night/guard_0/guarding",
        "member": "guard[0]",
        "machine": "Guarding",
        "model": "lab",
        "version": "0.1.0",
    }
    # One that does not refuse others goes on among them, and they go on without it.
    warned = guard(ros, 1)
    warned.wait_in("Watch")
    said = "another model: guard[1] has lab 0.1.0 (other), not lab"
    until(lambda: said in first.log)
    assert "(other), not lab" in first.log.partition("and is refused")[0]
    until(lambda: "another model: guard[0] has lab" in warned.log)
    warned.process.send_signal(signal.SIGKILL)
    ros.environment.update(own)
    guard(ros, 2, model__others="refuse", model__wait=0.1)

    assert first.wait_for("member_joined")["data"] == {"id": "guard[2]", "role": "guard"}


def until(holds: Callable[[], bool]) -> None:
    """Wait until something is so."""
    end = time.monotonic() + PATIENCE
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.05)


def test_a_way_to_treat_other_models_that_is_none(ros: Any) -> None:
    node = guard(ros, 0, model__others="kill")

    assert node.exit_code() == 1
    said = "parameter `model.others` is `kill`, but can be `warn`, `refuse`, `ignore`"
    assert said in node.log
