"""Interfaces in a folder and their packages."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source, Span
from swarmdsl.project.rosidl.package_folder import find_interfaces, find_parameters

AT = Span(Source("model.swarm", 'import ros "interfaces"'), 11, 23)


def make(folder: Path, *paths: str) -> Path:
    """Files below a folder; a package.xml names the package that its path says before `:`."""
    for path in paths:
        name, _, place = path.rpartition(":")
        file = folder / place
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(f"<package><name> {name} </name></package>" if name else "")
    return folder


def found(folder: Path, report: Diagnostics) -> list[str]:
    return [
        f"{interface.package}/{interface.kind}/{interface.name}"
        for interface in find_interfaces(folder, AT, report)
    ]


@pytest.mark.parametrize(
    ("paths", "start", "expected"),
    [
        pytest.param(
            [
                "my_msgs/srv/Get.srv",
                "my_msgs/msg/B.msg",
                "my_msgs/msg/A.msg",
                "my_msgs/action/Go.action",
            ],
            "my_msgs",
            ["my_msgs/msg/A", "my_msgs/msg/B", "my_msgs/srv/Get", "my_msgs/action/Go"],
            id="package",
        ),
        pytest.param(
            ["my_msgs/A.msg", "my_msgs/Go.action", "my_msgs/README.md"],
            "my_msgs",
            ["my_msgs/msg/A", "my_msgs/action/Go"],
            id="flat",
        ),
        pytest.param(
            ["b_msgs/msg/X.msg", "a_msgs/X.msg", "a_msgs/srv/X.srv"],
            "",
            ["a_msgs/msg/X", "a_msgs/srv/X", "b_msgs/msg/X"],
            id="several",
        ),
        pytest.param(
            ["named:checkout/package.xml", "checkout/msg/A.msg", "other/msg/B.msg"],
            "",
            ["named/msg/A", "other/msg/B"],
            id="manifest",
        ),
        pytest.param(["my_msgs/msg/A.msg"], "my_msgs/msg", ["my_msgs/msg/A"], id="kind"),
        pytest.param(
            ["named:my/package.xml", "my/msg/A.msg"],
            "my/msg",
            ["named/msg/A"],
            id="kind-with-manifest",
        ),
        pytest.param(["my_msgs/msg/sub/A.msg"], "my_msgs", ["my_msgs/msg/A"], id="folder-in-msg"),
        pytest.param(
            ["outer:package.xml", "interfaces/my_msgs/msg/A.msg"],
            "interfaces",
            ["my_msgs/msg/A"],
            id="manifest-further-out",
        ),
        pytest.param(
            [
                "a:src/a/package.xml",
                "src/a/msg/A.msg",
                "b:src/stack/b/package.xml",
                "src/stack/b/msg/B.msg",
                "a:install/a/share/a/package.xml",
                "install/a/share/a/msg/A.msg",
                "devel/share/a/msg/A.msg",
            ],
            "",
            ["a/msg/A", "b/msg/B"],
            id="workspace",
        ),
        pytest.param(
            ["my_pkg/src/main.cpp", "my_pkg/msg/A.msg", "my_pkg/src/msg/B.msg"],
            "my_pkg",
            ["my_pkg/msg/A", "src/msg/B"],
            id="sources-beside",
        ),
        pytest.param(
            [
                "my_msgs/msg/A.msg",
                "build/COLCON_IGNORE",
                "build/my_msgs/msg/A.msg",
                ".cache/my_msgs/msg/A.msg",
            ],
            "",
            ["my_msgs/msg/A"],
            id="ignored",
        ),
    ],
)
def test_found_interfaces(
    paths: list[str], start: str, expected: list[str], tmp_path: Path, report: Diagnostics
) -> None:
    make(tmp_path, *paths)

    assert found(tmp_path / start, report) == expected
    assert len(report) == 0


def test_paths_are_as_the_folder_was_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, report: Diagnostics
) -> None:
    make(tmp_path, "my_msgs/msg/A.msg")
    monkeypatch.chdir(tmp_path / "my_msgs")

    (interface,) = find_interfaces(Path(), AT, report)

    assert interface.package == "my_msgs"
    assert interface.path == Path("msg/A.msg")


def test_linked_folders(tmp_path: Path, report: Diagnostics) -> None:
    make(tmp_path, "elsewhere/my_msgs/msg/A.msg")
    (tmp_path / "src").mkdir()
    (tmp_path / "src" / "my_msgs").symlink_to(tmp_path / "elsewhere" / "my_msgs")
    (tmp_path / "src" / "again").symlink_to(tmp_path / "src")  # a cycle

    assert found(tmp_path, report) == ["my_msgs/msg/A"]


def test_a_folder_above(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, report: Diagnostics
) -> None:
    make(tmp_path, "my_msgs/A.msg", "my_msgs/models/model.swarm")
    monkeypatch.chdir(tmp_path / "my_msgs" / "models")

    assert found(Path(".."), report) == ["my_msgs/msg/A"]


def messages(report: Diagnostics) -> list[str]:
    assert all(found.primary and found.primary.span == AT for found in report)
    return [found.message for found in report]


def test_no_such_folder(tmp_path: Path, report: Diagnostics) -> None:
    assert found(tmp_path / "missing", report) == []
    assert messages(report) == [f"no such file: `{tmp_path / 'missing'}`"]


@pytest.mark.parametrize("paths", [[], ["my_msgs/README.md"], ["src/model.swarm"]])
def test_nothing_found(paths: list[str], tmp_path: Path, report: Diagnostics) -> None:
    assert found(make(tmp_path, *paths), report) == []
    assert messages(report) == [f"no such file: `{tmp_path / '*.msg'}`"]


def test_a_file_is_no_folder(tmp_path: Path, report: Diagnostics) -> None:
    assert found(make(tmp_path, "A.msg") / "A.msg", report) == []
    assert len(report) == 1


def test_a_broken_manifest(tmp_path: Path, report: Diagnostics) -> None:
    make(tmp_path, "my_msgs/package.xml", "my_msgs/msg/A.msg")

    assert found(tmp_path, report) == ["my_msgs/msg/A"]
    (message,) = messages(report)
    assert [diagnostic.name for diagnostic in report] == ["unreadable-file"]
    assert message.startswith(
        f"cannot read `{tmp_path / 'my_msgs' / 'package.xml'}`: it is not XML"
    )


@pytest.mark.parametrize(
    ("path", "name"), [("my-msgs/msg/A.msg", "my-msgs"), ("my_msgs/msg/A-B.msg", "A-B")]
)
def test_bad_names(path: str, name: str, tmp_path: Path, report: Diagnostics) -> None:
    assert found(make(tmp_path, path), report) == []
    (message,) = messages(report)
    assert message.startswith(f"`{name}` cannot be the name of a ROS ")


def test_an_interface_in_two_files(tmp_path: Path, report: Diagnostics) -> None:
    make(tmp_path, "a/my_msgs/msg/A.msg", "b/my_msgs/msg/A.msg")

    assert found(tmp_path, report) == ["my_msgs/msg/A"]
    assert messages(report) == ["interface `my_msgs/msg/A` is declared twice"]


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="needs permissions that hold")
def test_an_unreadable_folder(tmp_path: Path, report: Diagnostics) -> None:
    make(tmp_path, "my_msgs/msg/A.msg", "secret/msg/B.msg")
    (tmp_path / "secret").chmod(0)
    try:
        assert found(tmp_path, report) == ["my_msgs/msg/A"]
    finally:
        (tmp_path / "secret").chmod(0o700)
    assert messages(report) == [f"cannot read `{tmp_path / 'secret'}`: permission denied"]


@pytest.mark.parametrize(
    ("paths", "start", "expected"),
    [
        pytest.param(
            ["gps/param/b.yaml", "gps/param/a.yml", "gps/param/a.txt", "uav/config/x/c.yaml"],
            "",
            ["gps a.yml", "gps b.yaml", "x c.yaml"],
            id="by-folder",
        ),
        pytest.param(
            ["mavros_gps:gps/package.xml", "gps/config/x/a.yaml", "gps/docs/b.yaml", "gps/c.yaml"],
            "",
            ["mavros_gps a.yaml"],
            id="of-a-package",
        ),
        pytest.param(["gps/a.yaml", "vel/b.yaml"], "", ["gps a.yaml", "vel b.yaml"], id="copies"),
        pytest.param(["gps/param/a.yaml"], "gps/param", ["gps a.yaml"], id="inside"),
        pytest.param(
            ["mavros_gps:gps/package.xml", "gps/param/a.yaml"],
            "gps/param",
            ["mavros_gps a.yaml"],
            id="inside-a-package",
        ),
        pytest.param(["params/gps/a.yaml"], "params", ["gps a.yaml"], id="called-so"),
        pytest.param(["1st/a.yaml", "gps/build/a.yaml"], "", ["build a.yaml"], id="names"),
    ],
)
def test_parameter_files(paths: list[str], start: str, expected: list[str], tmp_path: Path) -> None:
    found = find_parameters(make(tmp_path, *paths) / start)

    assert [f"{each.package} {each.path.name}" for each in found] == expected
