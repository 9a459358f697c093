"""`swarmc import ros`: packages with interfaces and parameters."""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.cli import run
from swarmdsl.driver import pipeline
from swarmdsl.importing.ros import import_ros, library_functions
from swarmdsl.ir import System

from .corpus import CORPUS

REAL = [CORPUS / name for name in ("interfaces", "params") if (CORPUS / name).is_dir()]

ROUTE = """\
# Where to go.

uint8 MOST=16     # as many as fit
string NAME=south
bool FAST=true
float32 SCALE=0.5
geometry_msgs/Point[<=16] points  # in order
string<=8 label "none"
int32[2] size [1, 2]
bool closed false
"""
GO = "uint8 OK=0\nstring<=8[] names\n---\nbool done\n---\n# so far\nfloat32 progress\n"


def make(folder: Path, **files: str) -> Path:
    """A folder with files; `__` stands for `/`, the last `_` for the dot."""
    for name, text in files.items():
        stem, _, suffix = name.rpartition("_")
        path = folder / f"{stem.replace('__', '/')}.{suffix}"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return folder


def imported(folder: Path) -> tuple[System, Diagnostics]:
    report = Diagnostics()
    system, _ = import_ros([folder], "uav", library_functions(), report)
    return system, report


def test_interfaces_with_all_that_is_said_of_them(tmp_path: Path) -> None:
    folder, out = make(tmp_path, nav__msg__Route_msg=ROUTE), tmp_path / "uav.swarm"

    assert run(["import", "ros", str(folder / "nav"), "-o", str(out)]) == 0
    assert (
        out.read_text(encoding="utf-8")
        == """\
package uav

/// Where to go.
message nav/Route {
  /// as many as fit
  const MOST  : uint8   = 16
  const NAME  : string  = "south"
  const FAST  : bool    = true
  const SCALE : float32 = 0.5

  /// in order
  points : geometry_msgs/Point[<=16]
  /// Default: none
  label  : string<=8
  /// Default: [1, 2]
  size   : int32[2]
  /// Default: false
  closed : bool
}
"""
    )


def test_constants_of_actions_have_no_place(tmp_path: Path) -> None:
    system, report = imported(make(tmp_path, arm__action__Go_action=GO))

    assert [(f.name, f.primary.span.text if f.primary else "") for f in report] == [
        ("left-out", "OK")
    ]
    (action,) = system.interfaces
    assert [str(field.type) for field in action.goal] == ["string<=8[]"]  # type: ignore[union-attr]
    assert action.feedback[0].doc == "so far"  # type: ignore[union-attr]


def test_what_ros_comes_with_is_not_described_again(tmp_path: Path) -> None:
    files = {"std_msgs__msg__Empty_msg": "", "a__msg__X_msg": "int8 x", "a__srv__X_srv": "---"}
    system, report = imported(make(tmp_path, **files))

    assert [str(each.type) for each in system.interfaces] == ["a/X"]
    assert [found.name for found in report] == ["left-out"]


def test_params_belong_to_functions_of_the_library_or_to_components(tmp_path: Path) -> None:
    files = {
        "uav_mavros_takeoff__param__a_yaml": "rate: 5.0  # In Hz.\n",
        "gps__config__b_yaml": "# What it is.\n\nsize: 1\n",
        "gps__docs__manifest_yaml": "license: x\n",
        "gps__package_xml": "<package><name>mavros_gps</name></package>",
    }
    system, report = imported(make(tmp_path, **files))

    assert len(report) == 0
    (function,) = system.functions
    assert (function.name, function.communication.name) == ("uav_mavros_takeoff", "cmd/takeoff")
    assert [(p.name, p.doc) for p in function.params] == [("rate", "In Hz.")]
    (component,) = system.components
    assert (component.name, component.kind, component.doc) == (
        *("MavrosGps", "virtual"),
        "What it is.",
    )
    assert [p.name for p in component.params] == ["size"]


def test_folders_without_anything(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    make(tmp_path, a__readme_md="x", b__param__x_yaml="", c__msg__Empty_msg="int8")
    for name, code in (("a", "SW0001"), ("b", "SW1209"), ("c", "SW0101"), ("d", "SW0001")):
        assert run(["import", "ros", str(tmp_path / name)]) == 1
        assert f"error[{code}]" in capsys.readouterr().err


@pytest.mark.skipif(not REAL, reason=f"no real files in {CORPUS} (set SWARMDSL_CORPUS)")
@pytest.mark.parametrize("folders", [*([each] for each in REAL), REAL], ids=str)
def test_real_packages(folders: list[Path], tmp_path: Path) -> None:
    out = tmp_path / "model.swarm"

    assert run(["import", "ros", *map(str, folders), "-o", str(out)]) == 0
    checked = pipeline.check([out])
    assert checked.system is not None
    assert [found.name for found in checked.report if found.name != "naming-style"] == []
    read = [path for folder in folders for path in folder.rglob("*.*")]
    interfaces = [path for path in read if path.suffix in (".msg", ".srv", ".action")]
    packages = {path.parent.name for path in read if path.suffix == ".yaml"}
    assert len(checked.system.interfaces) == len(interfaces)
    assert len(checked.system.functions) + len(checked.system.components) == len(packages)


@pytest.mark.parametrize(
    ("name", "advice"),
    [
        ("nav2_msgs", "AMENT_PREFIX_PATH is not set"),
        ("std_msgs", "the interfaces of `std_msgs` come with swarmdsl, and need no import"),
    ],
)
def test_packages_by_name_without_ros(
    name: str, advice: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    assert run(["import", "ros", name]) == 1
    assert advice in capsys.readouterr().err


def test_packages_by_name_with_ros(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("std_msgs", "sensor_msgs", "uav_msgs"):
        for index in ("packages", "rosidl_interfaces"):
            path = tmp_path / "share/ament_index/resource_index" / index / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text("", encoding="utf-8")
    make(tmp_path, share__std_msgs__msg__Empty_msg="")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    model = tmp_path / "model.swarm"

    def advice(name: str) -> str:
        model.write_text(f'import ros "{name}"\nevent Go : std_msgs/Empty\n', encoding="utf-8")
        assert run(["check", str(model)]) == 1
        return capsys.readouterr().out

    assert "help: did you mean `std_msgs`?" in advice("std_msg")
    assert "help: did you mean `uav_msgs`?" in advice("uaw_msgs")
    # An ending that all of them have makes no name similar.
    assert "did you mean" not in advice("nav2_msgs")
    assert run(["import", "ros", "std_msgs"]) == 1
    assert "interfaces of `std_msgs` come with swarmdsl, and" in capsys.readouterr().err
