"""Diagnostics for ROS 2 packages."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.cli import run

from ..test_mapping import HEADER

MACHINE = "statemachine Work { initial A; state A { on Go -> End } final End }"
Reported = Callable[..., list[tuple[str, str, str]]]


@pytest.mark.parametrize(
    ("option", "fault"),
    [
        ("simulation=true", "option `simulation` counts only with `ros=1`"),
        ("cancel=3", "option `cancel` counts only with `ros=1`"),
        ("package=rclpy", "`rclpy` cannot be the name of the package"),
        ("package=smach_ros", "`smach_ros` cannot be the name of the package"),
    ],
)
def test_options(reported: Reported, option: str, fault: str) -> None:
    name, _, value = option.partition("=")
    ((code, message, _),) = reported(HEADER + MACHINE, **{name: value})
    assert code == "bad-option"
    assert fault in message


def test_an_option_is_shown_where_it_stands(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "lab.swarm").write_text(HEADER + MACHINE, encoding="utf-8")
    project = '[project]\nname = "lab"\n\n[targets.smach]\nlifecycle = true\n'
    (tmp_path / "swarm.toml").write_text(project, encoding="utf-8")
    command = ["build", str(tmp_path), "--target", "smach", "-o", str(tmp_path / "out")]
    assert run([*command, "--format", "concise"]) == 1
    found = capsys.readouterr()
    assert "swarm.toml:5:" in found.out + found.err
    assert "option `lifecycle` counts only with `ros=2`" in found.out + found.err
    assert run([*command, "--option", "smach.ros=2"]) == 0


def test_skeletons_of_ros_1_beside_it_mean_nothing_for_it(tmp_path: Path) -> None:
    """Requirements of ROS 1 skeletons on the package do not apply here."""
    model = tmp_path / "lab.swarm"
    model.write_text(HEADER + MACHINE, encoding="utf-8")
    targets = ["--target", "smach", "--target", "skeleton", "--option", "smach.ros=2"]
    assert run(["build", str(model), *targets, "-o", str(tmp_path / "out")]) == 0


@pytest.mark.parametrize(
    ("machine", "name"),
    [
        ("Following", "following"),
        ("Library", "library"),
        ("Runner", "runner"),
        ("States", "states"),
        ("Host", "host"),
    ],
)
def test_machines_called_like_modules(reported: Reported, machine: str, name: str) -> None:
    ((code, message, _),) = reported(HEADER + MACHINE.replace("Work", machine))
    assert code == "bad-identifier"
    assert f"`{name}`" in message


def test_a_machine_called_like_that_of_another_one(reported: Reported) -> None:
    model = HEADER + MACHINE + MACHINE.replace("Work", "WorkSmach")
    ((code, message, _),) = reported(model)
    assert (code, "`work_smach`" in message) == ("bad-identifier", True)


def test_a_package_of_interfaces_that_would_hide_smach(reported: Reported) -> None:
    model = HEADER.replace("package lab", "package smach") + MACHINE
    ((code, message, _),) = reported(model, package="lab")
    assert (code, "SMACH has a package" in message) == ("bad-identifier", True)


def test_keys_of_userdata(reported: Reported) -> None:
    variables = "var update : int32; var _n : int32; param extract : int32 = 1; var fine : int32"
    model = HEADER + MACHINE.replace("initial A", f"{variables}; initial A")
    found = reported(model)
    assert [code for code, _, _ in found] == ["bad-identifier"] * 3
    assert ["update" in f[1] or "_n" in f[1] or "extract" in f[1] for f in found] == [True] * 3
