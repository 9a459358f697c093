"""The ADF has the shape of the appendix of D5.4, and describes the same functions."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source, Span
from swarmdsl.codegen.exchange import adf
from swarmdsl.driver import pipeline
from swarmdsl.ir import (
    Binary,
    Call,
    Communication,
    Function,
    Literal,
    Named,
    Param,
    System,
    Unary,
)
from swarmdsl.syntax.types import FLOAT

Compile = Callable[[str], System]


def emitted(system: System, *expected: str) -> tuple[str, Any]:
    """Return the name of the file and its content."""
    report = Diagnostics()
    (file,) = adf.emit(system, adf.Options(), report)
    assert [found.name for found in report] == list(expected)
    return file.path, json.loads(file.text)


def as_we_write_it(node: Any, interface: str = "") -> Any:
    """Return the appendix with the intended differences.

    - the package of `Header` is `std_msgs`, not `stds_msgs`;
    - an interface is named with its package;
    - ids of tasks are strings, as in the messages of today (and the id of an event of that kind
      is called `id`).
    """
    classes = {
        "stds_msgs/Header": "std_msgs/Header",
        "TakeOff": "uav_mavros_takeoff/TakeOff",
        "Empty": "std_srvs/Empty",
    }
    if isinstance(node, list):
        return [as_we_write_it(item, interface) for item in node]
    if not isinstance(node, dict):
        return node
    interface = node.get("class", interface)
    changed = {key: as_we_write_it(value, interface) for key, value in node.items()}
    if "class" in changed:
        changed["class"] = classes.get(changed["class"], changed["class"])
    if changed.get("name") == "task_id":
        changed["class"] = "string"
    return changed


@pytest.mark.parametrize("name", ["uav_mavros_takeoff", "uav_mavros_land", "auction_action"])
def test_functions_of_the_appendix(search_and_rescue: System, corpus: Path, name: str) -> None:
    real = json.loads((corpus / "adf" / "head_d54.json").read_text(encoding="utf-8"))
    _, ours = emitted(search_and_rescue)
    expected = as_we_write_it(next(f for f in real["functions"] if f["name"] == name))
    for message in expected["api"].get("inputs", []):
        if message["msg"]["class"] == "cpswarm_msgs/TaskAllocationEvent":
            message["msg"]["fields"][2]["name"] = "id"
    function = next(f for f in ours["functions"] if f["name"] == name)

    # As text: the order of the keys is part of the shape.
    assert json.dumps(expected, indent=1) == json.dumps(function, indent=1)
    assert list(ours) == list(real)
    assert ours["runtime-env"] == real["runtime-env"]


def test_a_service_with_fields(compiled: Compile) -> None:
    path, content = emitted(compiled(""))
    ask = next(f for f in content["functions"] if f["name"] == "ask")

    assert path == "test.adf.json"
    assert ask == {
        "name": "ask",
        "category": "abstraction-lib",
        "api": {
            "comm_model": {
                "paradigm": "rosservice",
                "definition": {
                    "name": "cmd/ask",
                    "class": "test/Ask",
                    "request": {"fields": [{"class": "uint8", "name": "times"}]},
                    "response": {"fields": [{"class": "bool", "name": "answer"}]},
                },
            }
        },
    }


def test_params(compiled: Compile) -> None:
    system = compiled(
        """
        function f : swarm {
          service "f" : std_srvs/Empty
          /// How fast.
          param speed : float64 = -2 * 1.5
          param wait  : duration = 500 ms
          param given : int32
          param mode  : string = "spiral"
          param on_off : bool = true
        }
        """
    )
    _, content = emitted(system, "value-not-a-number", "value-not-a-number")
    (function,) = [f for f in content["functions"] if f["name"] == "f"]

    assert function["category"] == "swarm-lib"
    assert function["param_list"] == [
        {"class": "number", "name": "speed", "value": -3.0, "description": "How fast."},
        {"class": "number", "name": "wait", "value": 0.5},
        {"class": "number", "name": "given"},
        {"class": "string", "name": "mode", "value": "spiral"},
        {"class": "boolean", "name": "on_off", "value": True},
    ]


def test_durations_are_seconds_however_they_are_computed(compiled: Compile) -> None:
    system = compiled(
        """
        const pause : duration = 3 s
        function f : swarm {
          service "f" : std_srvs/Empty
          param half  : duration = 30 s / 2
          param third : duration = pause * 0.5
          param more  : duration = max(1 s, 250 ms) + 500 ms
          param ratio : float64  = 3 s / 2 s
        }
        """
    )
    _, content = emitted(system)
    (function,) = [f for f in content["functions"] if f["name"] == "f"]

    assert {param["name"]: param["value"] for param in function["param_list"]} == {
        "half": 15.0,
        "third": 1.5,
        "more": 1.5,
        "ratio": 1.5,
    }


def number(value: float) -> Literal:
    return Literal(value, FLOAT)


@pytest.mark.parametrize(
    ("operation", "message"),
    [
        (Binary("/", number(1), number(0), FLOAT), "`/` does not work on `1` and `0`"),
        (Binary("%", number(5.5), number(0), FLOAT), "`%` does not work on `5.5` and `0`"),
        (
            Binary("*", number(9e200), number(1e200), FLOAT),
            "`*` does not work on `9e+200` and `1e+200`",
        ),
        (Call("sqrt", (number(-2.0),), FLOAT), "`sqrt` does not work on `-2.0`"),
    ],
)
def test_a_value_that_is_no_number(operation: Binary | Call, message: str) -> None:
    """Checks find literal divisions by zero; computed ones are found here."""
    source = Source("model.swarm", "-(the operation)")
    operation = replace(operation, origin=Span(source, 2, 15))
    param = Param("x", FLOAT, Unary("-", operation, FLOAT))
    call = Communication("service", "f", Named("std_srvs", "Empty"))
    system = System("test", functions=(Function("f", "swarm", call, (), (param,)),))
    report = Diagnostics()
    (file,) = adf.emit(system, adf.Options(), report)
    (found,) = report

    assert (found.name, found.message) == ("bad-operand", message)
    assert found.primary is not None
    assert found.primary.span.text == "the operation"
    (function,) = json.loads(file.text)["functions"]
    assert function["param_list"] == [{"class": "number", "name": "x"}]


def test_constants_of_messages(compiled: Compile) -> None:
    """As class `Constant` of the CPSwarm generator reads them; ROS 1 has no bounds."""
    system = compiled(
        """
        message Mode {
          const IDLE : uint8 = 0
          /// At work.
          const BUSY : uint8 = 2 * 2
          const NAME : string<=8 = "mode"
          mode  : uint8
          label : string<=10
          past  : uint8[<=5]
          last  : string<=3[2]
        }
        function f : swarm {
          service "f" : std_srvs/Empty
          in "mode" : Mode
        }
        """
    )
    _, content = emitted(system, "value-not-a-number")
    (function,) = [f for f in content["functions"] if f["name"] == "f"]
    ((port,),) = [function["api"]["inputs"]]

    assert list(port["msg"]) == ["class", "constants", "fields"]
    assert port["msg"]["constants"] == [
        {"class": "uint8", "name": "IDLE", "value": 0},
        {"class": "uint8", "name": "BUSY", "value": 4, "description": "At work."},
        {"class": "string", "name": "NAME", "value": "mode"},
    ]
    assert [(field["name"], field["class"]) for field in port["msg"]["fields"]] == [
        ("mode", "uint8"),
        ("label", "string"),
        ("past", "uint8[]"),
        ("last", "string[2]"),
    ]


def test_no_functions_no_file() -> None:
    assert list(adf.emit(System("empty"), adf.Options(), Diagnostics())) == []


def test_each_component_and_part_has_servers_of_its_own(compiled: Compile) -> None:
    system = compiled(
        """
        sensor Camera { operation snap() }
        sensor ThermalCamera extends Camera {}
        member Uav { left : ThermalCamera; camera : Camera }
        """
    )
    _, content = emitted(system)
    assert [
        (each["name"], each["api"]["comm_model"]["definition"]["name"])
        for each in content["functions"]
        if each["name"].endswith("_snap")
    ] == [
        ("camera_snap", "camera/snap"),
        ("thermal_camera_snap", "thermal_camera/snap"),
        ("left_snap", "left/snap"),
    ]


SENSORS = """
/// Sees.
sensor Eye { out seen : Report on "seen"; inout light : float32; param rate : float64 = 2.0 }
controller Mind { in seen : Report }
actuator Wheel { in turn : Report }
function find : swarm { action "find" : Drive; param far : float64 = 3.0 }
"""


def by_schema(system: System) -> tuple[Any, list[str]]:
    report = Diagnostics()
    (file,) = adf.emit(system, adf.Options(form="schema"), report)
    return json.loads(file.text), [found.message for found in report]


def test_the_form_of_the_schema(compiled: Compile) -> None:
    content, said = by_schema(compiled(SENSORS))
    report = {
        "class": "test/Report",
        "fields": [{"class": "string", "name": "id"}, {"class": "int32", "name": "level"}],
    }
    light = {"topic": "light", "msg_def": {"class": "float32"}}

    assert content["sensors/actuators"] == [
        {
            "name": "Eye",
            "description": "Sees.",
            "category": "Sensor",
            "api": {"inputs": [light], "outputs": [{"topic": "seen", "msg_def": report}, light]},
        },
        {
            "name": "Wheel",
            "description": "",
            "category": "Actuator",
            "api": {"inputs": [{"topic": "turn", "msg_def": report}]},
        },
    ]
    assert content["functions"][-1]["api"]["comm_paradigm"] == "rosaction"
    assert said == [
        "target `adf` cannot represent param `rate` of a component",
        "target `adf` cannot represent controller `Mind`",
        "target `adf` cannot represent param `far` of a function",
    ]


@pytest.mark.parametrize("year", ["2019", "2021"])
def test_the_schema_of_the_modelling_tool(year: str, compiled: Compile, corpus: Path) -> None:
    path = corpus / "schema" / f"{year}_ROS_abstraction-description.schema.json"
    validator = jsonschema.Draft7Validator(json.loads(path.read_text(encoding="utf-8")))
    content, _ = by_schema(compiled(SENSORS))
    d5_4 = emitted(compiled(SENSORS))[1]

    assert list(validator.iter_errors(content)) == []
    assert list(validator.iter_errors(d5_4))


def test_the_functions_that_no_library_has(tmp_path: Path) -> None:
    model = tmp_path / "model.swarm"
    model.write_text(
        """
        package test
        import cpswarm.functions.*
        function mine : swarm { service "mine" : std_srvs/Empty }
        endless statemachine M {
          initial A
          state A { do uav_mavros_land; on succeeded, aborted -> B }
          state B { do mine; on succeeded, aborted -> A }
        }
        """,
        encoding="utf-8",
    )
    result = pipeline.check([model])
    assert result.system is not None, [found.message for found in result.report]
    names = {}
    for which in ("all", "missing"):
        (file,) = adf.emit(result.system, adf.Options(functions=which), Diagnostics())
        names[which] = [function["name"] for function in json.loads(file.text)["functions"]]

    assert sorted(names["all"]) == ["mine", "uav_mavros_land"]
    assert names["missing"] == ["mine"]
