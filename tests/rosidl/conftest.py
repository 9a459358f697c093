"""Fixtures of the tests of ROS interface types."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.project.rosidl.interface_file import InterfaceFile, Kind, parse_interface

ROOT = Path(__file__).resolve().parents[2]
Read = Callable[..., InterfaceFile]


@pytest.fixture
def report() -> Diagnostics:
    return Diagnostics()


@pytest.fixture
def read(report: Diagnostics) -> Read:
    """Return a function that parses the text of `my_msgs/Thing`."""

    def read_text(text: str, kind: Kind = "msg") -> InterfaceFile:
        return parse_interface(Source(f"Thing.{kind}", text), "my_msgs", "Thing", kind, report)

    return read_text


@pytest.fixture
def read_well(read: Read, report: Diagnostics) -> Read:
    """Return a function that parses a correct text of `my_msgs/Thing`."""

    def read_text(text: str, kind: Kind = "msg") -> InterfaceFile:
        found = read(text, kind)
        assert [diagnostic.message for diagnostic in report] == []
        assert not found.damaged
        return found

    return read_text


@pytest.fixture
def corpus() -> Path:
    """Folder of published interface files of other projects, not part of this one."""
    folder = Path(os.environ.get("SWARMDSL_CORPUS", ROOT.parent / "shared" / "corpus"))
    if not folder.is_dir():
        pytest.skip("no corpus here; SWARMDSL_CORPUS names its folder")
    return folder
