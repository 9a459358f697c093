"""The interface types that ROS comes with."""

from __future__ import annotations

import subprocess
import sys

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.base.suggest import closest
from swarmdsl.project.rosidl import standard
from swarmdsl.project.rosidl.interface_file import parse_interface
from swarmdsl.syntax.ast import ActionType, Field, MessageType, ServiceType, TypeRef, walk
from swarmdsl.syntax.types import PRIMITIVES, Named

from .rosbags_types import text

ALL = [(package, name) for package in standard.packages() for name in standard.names(package)]


def test_the_messages_are_those_of_rosbags(bless: bool) -> None:
    path = standard.FOLDER / "standard_messages.txt"
    expected = text()
    if bless:
        path.write_text(expected, encoding="utf-8")

    assert path.read_text(encoding="utf-8") == expected


@pytest.mark.parametrize("file", standard.FILES)
def test_the_files_are_well_formed(file: str) -> None:
    content = (standard.FOLDER / file).read_text(encoding="utf-8")
    _, *sections = content.split("\n== ")
    headings = [section.partition("\n")[0] for section in sections]
    report = Diagnostics()
    for heading, section in zip(headings, sections, strict=True):
        package, kind, name = heading.split("/")
        parse_interface(Source(heading, section.partition("\n")[2]), package, name, kind, report)

    assert headings == sorted(set(headings))
    assert [(found.primary, found.message) for found in report] == []


def fields(package: str, name: str) -> dict[str, str]:
    found = standard.lookup(Named(package, name))
    assert isinstance(found, MessageType)
    return {str(field.name): field.type.name + field.type.array for field in found.fields}


# From the documentation of each message, not from the file that is tested.
@pytest.mark.parametrize(
    ("package", "name", "expected"),
    [
        ("std_msgs", "Empty", {}),
        ("std_msgs", "Header", {"seq": "uint32", "stamp": "time", "frame_id": "string"}),
        ("std_msgs", "Time", {"data": "time"}),
        ("builtin_interfaces", "Time", {"sec": "int32", "nanosec": "uint32"}),
        (
            "geometry_msgs",
            "Pose",
            {"position": "geometry_msgs/Point", "orientation": "geometry_msgs/Quaternion"},
        ),
        (
            "geometry_msgs",
            "PoseWithCovariance",
            {"pose": "geometry_msgs/Pose", "covariance": "float64[36]"},
        ),
        ("nav_msgs", "Path", {"header": "std_msgs/Header", "poses": "geometry_msgs/PoseStamped[]"}),
        ("tf2_msgs", "TFMessage", {"transforms": "geometry_msgs/TransformStamped[]"}),
        ("unique_identifier_msgs", "UUID", {"uuid": "uint8[16]"}),
    ],
)
def test_messages(package: str, name: str, expected: dict[str, str]) -> None:
    assert fields(package, name) == expected


def test_services_and_actions() -> None:
    trigger = standard.lookup(Named("std_srvs", "Trigger"))
    transform = standard.lookup(Named("tf2_msgs", "LookupTransform"))

    assert isinstance(trigger, ServiceType)
    assert trigger.request == []
    assert [str(field.name) for field in trigger.response] == ["success", "message"]
    assert isinstance(transform, ActionType)
    assert transform.result[1].type.name == "tf2_msgs/TF2Error"


def test_one_name_of_a_service_and_an_action() -> None:
    type_ = Named("nav_msgs", "GetMap")

    assert isinstance(standard.lookup(type_), ServiceType)
    assert isinstance(standard.lookup(type_, "action"), ActionType)
    assert standard.lookup(type_, "msg") is None


def test_parts_of_only_one_ros() -> None:
    def fields_only_in(package: str, name: str) -> dict[str, int | None]:
        found = standard.lookup(Named(package, name))
        assert isinstance(found, MessageType)
        assert standard.only_in(found) is None
        return {str(field.name): standard.only_in(field) for field in found.fields}

    def only_in(package: str, name: str) -> int | None:
        found = standard.lookup(Named(package, name))
        assert found is not None
        return standard.only_in(found)

    assert fields_only_in("std_msgs", "Header") == {"seq": 1, "stamp": None, "frame_id": None}
    camera = fields_only_in("sensor_msgs", "CameraInfo")
    assert {name for name, ros in camera.items() if ros == 1} == set("DKRP")
    assert {name for name, ros in camera.items() if ros == 2} == set("dkrp")
    assert only_in("std_msgs", "Time") == 1
    assert only_in("builtin_interfaces", "Time") == 2
    assert only_in("action_msgs", "GoalStatus") == 2
    assert only_in("actionlib_msgs", "GoalStatus") is None
    assert only_in("tf2_msgs", "TFMessage") is None


def test_the_packages() -> None:
    assert set(standard.packages()) == {
        *("std_msgs", "geometry_msgs", "sensor_msgs", "nav_msgs", "actionlib_msgs", "action_msgs"),
        *("builtin_interfaces", "unique_identifier_msgs", "diagnostic_msgs", "trajectory_msgs"),
        *("visualization_msgs", "shape_msgs", "stereo_msgs", "tf2_msgs", "std_srvs"),
        *("rosgraph_msgs", "rcl_interfaces"),
    }


@pytest.mark.parametrize(("package", "name"), ALL)
def test_all_refer_to_each_other_only(package: str, name: str) -> None:
    found = standard.lookup(Named(package, name))
    assert found is not None
    assert found.name == f"{package}/{name}"
    for node in walk(found):
        if isinstance(node, TypeRef) and node.name not in PRIMITIVES:
            assert standard.lookup(Named(*node.name.split("/")), "msg") is not None


def test_unknown_names() -> None:
    assert standard.lookup(Named("std_msgs", "Headr")) is None
    assert standard.lookup(Named("stds_msgs", "Header")) is None
    assert standard.names("stds_msgs") == []
    assert closest("stds_msgs", standard.packages()) == "std_msgs"
    assert closest("Headr", standard.names("std_msgs")) == "Header"


def test_a_type_is_one_node() -> None:
    type_ = Named("std_msgs", "Header")

    assert standard.lookup(type_) is standard.lookup(Named("std_msgs", "Header"))


def test_places_are_in_the_interface() -> None:
    found = standard.lookup(Named("std_msgs", "Header"))

    assert isinstance(found, MessageType)
    stamp: Field = found.fields[1]
    assert stamp.name.span.source.name == "std_msgs/msg/Header.msg"
    assert (stamp.name.span.line, stamp.name.span.text) == (2, "stamp")


def test_interfaces_are_read_lazily_and_without_parsers() -> None:
    program = """
import os
import sys
from pathlib import Path
import swarmdsl.project.rosidl.interface_file
from swarmdsl.syntax.types import Named

read = []
original = os.open
os.open = lambda path, *how: (read.append(Path(path).name), original(path, *how))[1]
from swarmdsl.project.rosidl import standard
assert read == [], read
assert standard.lookup(Named("geometry_msgs", "PoseStamped"))
assert read == list(standard.FILES), read
assert not {"numpy", "rosbags", "textx", "lxml"} & set(sys.modules)
"""
    assert subprocess.run([sys.executable, "-c", program]).returncode == 0
