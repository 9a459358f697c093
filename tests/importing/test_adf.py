"""Abstraction Description Files of all generations, and what is wrong with some."""

from __future__ import annotations

import json
from typing import Any

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.importing import import_adf
from swarmdsl.ir import Action, Literal, System

CALL = {"name": "cmd/lift", "class": "arm_msgs/Lift"}
GOAL = {"goal": {"fields": [{"class": "float64", "name": "height", "description": "in m"}]}}
STATE = {"class": "arm_msgs/State", "fields": [{"class": "uint8[]", "name": "joints"}]}


def imported(*functions: dict[str, Any], **others: Any) -> tuple[System, Diagnostics]:
    return imported_text(json.dumps({"functions": functions, **others}))


def imported_text(text: str) -> tuple[System, Diagnostics]:
    report = Diagnostics()
    return import_adf([Source("arm.json", text)], "arm", report), report


def said(report: Diagnostics) -> list[tuple[str, str]]:
    return [(f.name, f.primary.span.text if f.primary else "") for f in report]


@pytest.mark.parametrize(
    "api",
    [
        {"comm_paradigm": "rosaction", "comm_model": {**CALL, **GOAL}},
        {"comm_model": {"paradigm": "rosaction", "definition": {**CALL, **GOAL}}},
    ],
)
@pytest.mark.parametrize("message", ["msg", "msg_def"])
def test_generations_say_the_same(api: dict[str, Any], message: str) -> None:
    ports = {"inputs": [{"topic": "arm/state", message: STATE}]}
    described = {"name": "lift", "description": "Lift\n it", "category": "swarm-lib"}
    system, report = imported({**described, "api": {**ports, **api}})

    assert said(report) == []
    (function,) = system.functions
    assert (function.name, function.doc, function.category) == ("lift", "Lift it", "swarm")
    assert (function.communication.name, str(function.communication.type)) == (
        *("cmd/lift", "arm_msgs/Lift"),
    )
    assert [(p.direction, p.topic, str(p.type)) for p in function.ports] == [
        ("in", "arm/state", "arm_msgs/State")
    ]
    action, state = system.interfaces
    assert isinstance(action, Action)
    assert [(f.name, str(f.type), f.doc) for f in action.goal] == [("height", "float64", "in m")]
    assert str(state.fields[0].type) == "uint8[]"  # type: ignore[union-attr]


def test_the_exporter_of_2021_says_nothing_about_calls() -> None:
    fix = {"topic": "gps/global", "msg": {"class": "sensor_msgs/NavSatFix"}}
    sensor = {"name": "GPS", "category": "Sensor", "api": {"outputs": [fix]}}
    function = {"name": "lift", "category": "abstraction-lib", "api": {}}
    system, report = imported(function, **{"sensors/actuators": [sensor]})

    assert sorted(said(report)) == [("assumed", "lift")]
    (component,) = system.components
    assert (component.name, component.kind) == ("GPS", "sensor")
    assert [(p.name, p.direction, str(p.type), p.topic) for p in component.ports] == [
        ("global", "out", "sensor_msgs/NavSatFix", "gps/global")
    ]
    assert str(system.functions[0].communication.type) == "cpswarm_msgs/Empty"


def test_params() -> None:
    params = [
        {"class": "number", "name": "speed", "value": 5},
        {"class": "string", "name": "frame", "value": "map"},
        {"class": "boolean", "name": "slow", "value": True},
        {"class": "number", "name": "top-speed", "value": 0.5},
        {"class": "array", "name": "route", "value": [1.5]},
        {"class": "numbr", "name": "count", "value": 1},
    ]
    api = {"comm_model": {"paradigm": "rosaction", "definition": CALL}}
    system, report = imported({"name": "lift", "param_list": params, "api": api})

    assert sorted(said(report)) == [("left-out", "route"), ("renamed", "top-speed")]
    assert [
        (p.name, str(p.type), p.default.value if isinstance(p.default, Literal) else None)
        for p in system.functions[0].params
    ] == [
        ("speed", "float64", 5.0),
        ("frame", "string", "map"),
        ("slow", "bool", True),
        ("top_speed", "float64", 0.5),
        ("route", "float64[]", None),
        ("count", "int64", 1),
    ]


def test_classes_as_the_real_files_have_them() -> None:
    header = {"class": "arm_msgs/State", "fields": [{"class": "stds_msgs/Header", "name": "h"}]}
    definition = {"name": "cmd/stop", "class": "Empty"}
    api = {
        "outputs": [{"topic": "state", "msg": header}, {"topic": "state", "msg": {"class": "a/B"}}],
        "comm_model": {"paradigm": "rosservice", "definition": definition},
    }
    system, report = imported({"name": "stop", "api": api})

    assert sorted(said(report)) == [
        ("assumed", "Empty"),
        ("left-out", "state"),
        ("renamed", "stds_msgs"),
    ]
    # What ROS comes with is not described again.
    assert [str(each.type) for each in system.interfaces] == ["arm_msgs/State"]
    assert str(system.functions[0].communication.type) == "std_srvs/Empty"


def test_devices_that_a_model_does_not_have() -> None:
    device = {"name": "arm 1", "category": "Robot", "api": {"services": [{"name": "reset"}]}}
    system, report = imported(**{"sensors/actuators": [device]})

    assert sorted(said(report)) == [
        ("assumed", "arm 1"),
        ("left-out", "arm 1"),
        ("renamed", "arm 1"),
    ]
    assert [(each.name, each.kind) for each in system.components] == [("Arm1", "virtual")]


def test_text_that_is_not_json() -> None:
    _, report = imported_text('{"functions": [{"name" 1}]}')

    (found,) = report
    assert found.name == "not-json"
    assert found.primary is not None
    assert found.primary.span.start == 23


@pytest.mark.parametrize("text", ["[1]", '{"sensors": []}', '"text"', "[" * 100_000])
def test_json_that_is_no_adf(text: str) -> None:
    _, report = imported_text(text)

    assert [found.name for found in report] in (["not-adf"], ["not-json"])
    assert report.has_errors


def test_what_is_of_another_kind_than_it_should_be() -> None:
    port = {"topic": "arm/state", "msg": "arm_msgs/State"}
    definition = {**CALL, "goal": {"fields": ["height"]}, "result": "reached"}
    call = {"comm_model": {"paradigm": "rosaction", "definition": definition}}
    lift = {"name": "lift", "api": {**call, "inputs": port}, "param_list": [1]}
    system, report = imported(
        lift, "grip", {"name": "lower", "api": [call]}, **{"sensors/actuators": {}}
    )

    assert [function.name for function in system.functions] == ["lift", "lower"]
    assert {found.message for found in report if found.name == "left-out"} == {
        '`"grip"` in `functions` is left out: it is not an object',
        f"`{json.dumps([call])[:40]}...` in `api` is left out: it is not an object",
        '`{"topic": "arm/state", "msg": "arm_msgs/...` in `inputs` is left out: it is not a list',
        "`1` in `param_list` is left out: it is not an object",
        '`"height"` in `fields` is left out: it is not an object',
        '`"reached"` in `result` is left out: it is not an object',
    }
