"""Code of `swarmc codegen` runs as its SCXML and ADF describe."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run
from swarmdsl.driver import pipeline
from swarmdsl.ir import System

ROOT = Path(__file__).resolve().parents[2]
CORPUS = Path(os.environ.get("SWARMDSL_CORPUS", ROOT.parent / "shared" / "corpus"))
REAL = sorted((CORPUS / "scxml").glob("*.xml"))
DESCRIBED = CORPUS / "adf" / "head_scxml.json"

# As the exporter of CPSwarm writes a state that waits for an event.
SEARCH = """<?xml version="1.0" encoding="UTF-8"?>
<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" initial="IdleThreads" name="search">
  <parallel id="IdleThreads">
    <state id="IdleBehavior"/>
    <state id="IdleEventMonitoring">
      <datamodel><data id="invoke"><rosmonitor>
        <topic>bridge/events/mission_start</topic><msg>uav_msgs/Start</msg>
      </rosmonitor></data></datamodel>
      <invoke type="ROS_MONITOR"/>
    </state>
    <transition event="missionStart" target="TakeOff"/>
  </parallel>
  <state id="TakeOff">
    <datamodel>
      <data id="invoke"><rosaction>
        <name>cmd/takeoff</name><action>uav_msgs/TakeOff</action>
        <goal type="fixed"><param>2.5</param></goal><result type="empty"/>
      </rosaction></data>
      <data id="adf"><name>takeoff</name></data>
    </datamodel>
    <invoke type="ROS_ACTION"/>
    <transition event="succeeded" target="Land"/>
    <transition event="aborted" target="IdleThreads"/>
  </state>
  <state id="Land">
    <datamodel><data id="invoke"><rosservice>
      <name>cmd/land</name><srv>std_srvs/Empty</srv><request type="empty"/><response type="empty"/>
    </rosservice></data></datamodel>
    <invoke type="ROS_SERVICE"/>
    <transition event="succeeded" target="IdleThreads"/>
    <transition event="aborted" target="Land"/>
  </state>
</scxml>
"""
GOAL = {"fields": [{"class": "float64", "name": "altitude"}]}
CALL = {"name": "cmd/takeoff", "class": "uav_msgs/TakeOff", "goal": GOAL}
API = {"comm_model": {"paradigm": "rosaction", "definition": CALL}}
UAV = {"functions": [{"name": "takeoff", "category": "abstraction-lib", "api": API}]}


def model_of(scxml: Path, adf: Path, folder: Path) -> System:
    """The same as a model: what is around the robot is made of it."""
    path = folder / "model.swarm"
    assert run(["import", "scxml", str(scxml), "--adf", str(adf), "-o", str(path)]) == 0
    system = pipeline.check([path]).system
    assert system is not None
    return system


def test_a_machine_of_scxml_runs(start_package: Callable[..., Any], tmp_path: Path) -> None:
    scxml, adf, out = tmp_path / "search.xml", tmp_path / "uav.json", tmp_path / "out"
    scxml.write_text(SEARCH, encoding="utf-8")
    adf.write_text(json.dumps(UAV), encoding="utf-8")
    command = ["codegen", "--env", "ROS", "--scxml", str(scxml), "--adf", str(adf)]

    assert run([*command, "--output", str(out)]) == 0
    robot = start_package(out / "fsm_behaviour", "search", model_of(scxml, adf, tmp_path))
    robot.start()
    robot.wait_in("Idle")
    robot.world.publish("bridge/events/mission_start")
    robot.wait_in("TakeOff")
    robot.world.finish("cmd/takeoff", "succeeded")
    robot.wait_in("Land")
    robot.world.finish("cmd/land", "succeeded")
    robot.wait_in("Idle")
    assert robot.world.called() == ["cmd/takeoff", "cmd/land"]


@pytest.mark.skipif(not REAL, reason=f"no real files in {CORPUS} (set SWARMDSL_CORPUS)")
@pytest.mark.parametrize("path", REAL, ids=lambda path: path.stem)
def test_real_machines_are_complete(
    path: Path, start_package: Callable[..., Any], tmp_path: Path
) -> None:
    out = tmp_path / "out"

    assert run(["codegen", "--scxml", str(path), "--adf", str(DESCRIBED), "-o", str(out)]) == 0
    (script,) = (out / "fsm_behaviour" / "scripts").iterdir()
    system = model_of(path, DESCRIBED, tmp_path)
    start_package(out / "fsm_behaviour", script.name, system).machine.check_consistency()
