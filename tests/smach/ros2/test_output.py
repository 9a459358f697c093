"""The text of packages for ROS 2: valid, as the linters of ROS want it, complete."""

from __future__ import annotations

import ast
from collections.abc import Callable
from pathlib import Path

import pytest
from lxml import etree

from ...ros2.test_output import BARE, FORMAT, LINTERS, ruff
from ...yasmin.test_output import MODEL

Generate = Callable[..., dict[str, str]]


def test_the_manifest_and_setup(generate: Generate) -> None:
    files = generate(MODEL)
    manifest = etree.fromstring(files["package.xml"].encode())
    assert manifest.get("format") == "3"
    assert {each.text for each in manifest.findall("depend")} >= {"rclpy", "smach", "smach_ros"}
    assert "'work = lab_behavior.work_smach:main'" in files["setup.py"]


def test_states_say_where_they_come_from(generate: Generate) -> None:
    text = generate(MODEL)["lab_behavior/work_smach.py"]
    line = MODEL[: MODEL.index("state In")].count("\n") + 1
    added = f"# model.swarm:{line} StateMachine.add( 'In', State("
    assert added in " ".join(text.split())


@pytest.mark.parametrize("options", [{}, {"lifecycle": "true"}], ids=["plain", "lifecycle"])
@pytest.mark.parametrize("model", [MODEL, BARE], ids=["full", "bare"])
def test_linters_of_ros_find_nothing(
    generate: Generate, tmp_path: Path, model: str, options: dict[str, str]
) -> None:
    for path, text in generate(model, **options).items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text, encoding="utf-8")
        if path.endswith(".py"):
            ast.parse(text, path, feature_version=(3, 10))

    assert ruff("check", *LINTERS, tmp_path) == ""
    assert ruff("format", "--check", *FORMAT, tmp_path) == ""


def test_for_ros_1_nothing_is_of_ros_2(generate: Generate) -> None:
    files = generate(MODEL)
    assert not any("rospy" in text for text in files.values())
    assert "CMakeLists.txt" not in files
