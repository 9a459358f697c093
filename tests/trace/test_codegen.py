"""Code from SCXML and ADF traces to these, not to the intermediate model."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from swarmdsl.cli import run as swarmc

from .conftest import Trace, line_of

SCXML = """<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" name="rise" initial="Up">
  <state id="Up">
    <datamodel>
      <data id="adf"><name>lift</name></data>
      <data id="invoke">
        <rosaction>
          <name>cmd/lift</name><action>lift/Lift</action>
          <goal type="fixed"><param>1.5</param></goal><result type="empty"/>
        </rosaction>
      </data>
    </datamodel>
    <invoke type="ROS_ACTION"/>
    <transition event="succeeded" target="end"/><transition event="aborted" target="end"/>
  </state>
  <final id="end"/>
</scxml>
"""
LIFT = {
    "name": "lift",
    "category": "abstraction-lib",
    "param_list": [{"class": "number", "name": "tolerance", "value": 0.1}],
    "api": {
        "inputs": [{"topic": "ready", "msg": {"class": "std_msgs/Bool"}}],
        "comm_model": {
            "paradigm": "rosaction",
            "definition": {
                "name": "cmd/lift",
                "class": "lift/Lift",
                "goal": {"fields": [{"class": "float64", "name": "height"}]},
            },
        },
    },
}


def test_packages_of_codegen(trace: Trace, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    adf = json.dumps({"runtime-env": "ROS", "functions": [LIFT]}, indent=2)
    (tmp_path / "rise.xml").write_text(SCXML, encoding="utf-8")
    (tmp_path / "lift.json").write_text(adf, encoding="utf-8")
    words = ["--scxml", "rise.xml", "--adf", "lift.json", "--output", "src"]
    assert swarmc(["codegen", *words]) == 0
    base = tmp_path / "src" / "lift" / "src" / "lift_base.cpp"
    machine = tmp_path / "src" / "fsm_behaviour" / "src" / "fsm_behaviour" / "rise.py"

    def told(path: str, line: int) -> str:
        return trace(f"{path}:{line}\n").splitlines()[1].strip()

    for text, in_adf in (('"tolerance"', "tolerance"), ('"ready", 10', "ready")):
        at = line_of(tmp_path / "lift.json", f'"{in_adf}"')
        column = adf.splitlines()[at - 1].index(in_adf) + 1
        assert told("lift/src/lift_base.cpp", line_of(base, text)) == f"--> lift.json:{at}:{column}"
    assert told("fsm_behaviour/rise.py", line_of(machine, "'Up',")) == "--> rise.xml:2:14"
    assert told("fsm_behaviour/rise.py", 1) == f"--> rise.xml:1:{SCXML.index('rise') + 1}"
    assert told("lift/package.xml", 1).startswith("--> lift.json:")
