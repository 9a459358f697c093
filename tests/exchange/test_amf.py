"""The AMF has the shape of the schema that came with the modelling tool."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import NoOptions
from swarmdsl.codegen.exchange import amf
from swarmdsl.ir import System

Compile = Callable[[str], System]

MODEL = """
message Pose {
  const FRAME : string = "map"
  /// To the east.
  x : float64
}
function find : swarm { action "find" : Drive; in "pose" : Pose; out "near" : Pose }
/// Ask all.
function ask_all : swarm { service "ask_all" : Ask; param wait : duration = 3 s }
"""


def emitted(system: System) -> tuple[dict[str, Any], Diagnostics]:
    report = Diagnostics()
    (file,) = amf.emit(system, NoOptions(), report)
    assert file.path == "test.amf.json"
    return json.loads(file.text), report


def test_functions_of_the_swarm(compiled: Compile) -> None:
    content, _ = emitted(compiled(MODEL))
    pose = {
        "class": "test/Pose",
        "constants": [{"class": "string", "name": "FRAME", "value": "map"}],
        "fields": [{"class": "float64", "name": "x", "description": "To the east."}],
    }

    assert content["runtime-env"] == "ROS"
    assert [function["name"] for function in content["functions"]] == ["find", "ask_all"]
    assert content["functions"][0]["api"]["inputs"] == [{"topic": "pose", "msg_def": pose}]
    assert content["functions"][0]["api"]["outputs"] == [{"topic": "near", "msg_def": pose}]
    assert content["functions"][1] == {
        "name": "ask_all",
        "description": "Ask all.",
        "api": {
            "comm_paradigm": "rosservice",
            "comm_model": {
                "name": "ask_all",
                "class": "test/Ask",
                "request": {"fields": [{"class": "uint8", "name": "times"}]},
                "response": {"fields": [{"class": "bool", "name": "answer"}]},
            },
        },
    }


def test_params_have_no_place(compiled: Compile) -> None:
    _, report = emitted(compiled(MODEL))
    (found,) = report

    assert found.name == "no-place"
    assert found.message == "target `amf` cannot represent param `wait` of a function"
    assert found.primary is not None
    assert found.primary.span.text == "wait"


def test_no_file_without_functions_of_the_swarm(compiled: Compile) -> None:
    assert list(amf.emit(compiled(""), NoOptions(), Diagnostics())) == []


@pytest.mark.parametrize("year", ["2019", "2021"])
def test_the_schema_of_the_modelling_tool(year: str, compiled: Compile, corpus: Path) -> None:
    path = corpus / "schema" / f"{year}_ROS_algorithm-description.schema.json"
    validator = jsonschema.Draft7Validator(json.loads(path.read_text(encoding="utf-8")))
    content, _ = emitted(compiled(MODEL))

    assert list(validator.iter_errors(content)) == []
    del content["functions"][1]["api"]["comm_model"]["class"]
    assert [error.message for error in validator.iter_errors(content)] == [
        "'class' is a required property"
    ]
