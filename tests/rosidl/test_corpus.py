"""Interface files that projects of the field published."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from rosbags.typesys import get_types_from_msg

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.project.rosidl.interface_file import InterfaceFile, parse_interface
from swarmdsl.project.rosidl.package_folder import InterfacePath, find_interfaces
from swarmdsl.syntax.ast import ActionType, MessageType, ServiceType

from .rosbags_types import written


@pytest.fixture
def interfaces(corpus: Path, report: Diagnostics) -> list[InterfacePath]:
    found = find_interfaces(corpus / "interfaces", None, report)
    assert len(report) == 0
    return found


def read(interface: InterfacePath, report: Diagnostics) -> InterfaceFile:
    text = interface.path.read_text(encoding="utf-8")
    source = Source(str(interface.path), text, interface.path)
    return parse_interface(source, interface.package, interface.name, interface.kind, report)


def test_all_are_found(corpus: Path, interfaces: list[InterfacePath]) -> None:
    files = [path for path in (corpus / "interfaces").rglob("*") if path.is_file()]

    assert len(interfaces) > 60
    assert sorted(interface.path for interface in interfaces) == sorted(files)


def test_all_are_read(interfaces: list[InterfacePath], report: Diagnostics) -> None:
    for interface in interfaces:
        assert not read(interface, report).damaged

    assert [(found.primary, found.message) for found in report] == []


def test_another_reader_finds_the_same(
    interfaces: list[InterfacePath], report: Diagnostics
) -> None:
    for interface in interfaces:
        match read(interface, report).declaration:
            case MessageType(fields=fields):
                parts = [fields]
            case ServiceType(request=request, response=response):
                parts = [request, response]
            case ActionType(goal=goal, result=result, feedback=feedback):
                parts = [goal, result, feedback]
        texts = re.split(r"^---.*$", interface.path.read_text(encoding="utf-8"), flags=re.M)
        name = f"{interface.package}/msg/{interface.name}"
        for part, text in zip(parts, texts, strict=True):
            _, fields_there = get_types_from_msg(text, name)[name]
            here = {str(field.name): field.type.name + field.type.array for field in part}
            assert here == {field: written(type_, "") for field, type_ in fields_there}, name
