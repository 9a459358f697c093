"""Round trip of a model through target adf, in the form of D5.4."""

from __future__ import annotations

import json
import os
from dataclasses import fields, is_dataclass, replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import Phase, given, settings

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.codegen.exchange import adf
from swarmdsl.codegen.exchange.description import value_class
from swarmdsl.codegen.shared.constants import constant
from swarmdsl.driver import pipeline
from swarmdsl.importing import import_adf
from swarmdsl.ir import Action, Array, Function, Literal, Message, Param, Primitive, Service, System
from swarmdsl.project.rosidl.standard import lookup
from swarmdsl.syntax.types import BOOL, FLOAT, INT, STRING, Type

from ..swarm_printer.round_trip import printed_and_compiled
from ..swarm_printer.systems import systems
from .test_portable import told_in_whole_milliseconds

ROOT = Path(__file__).resolve().parents[2]
CORPUS = Path(os.environ.get("SWARMDSL_CORPUS", ROOT.parent / "shared" / "corpus"))
APPENDIX = CORPUS / "adf" / "head_d54.json"
EXAMPLES = sorted(path.parent for path in (ROOT / "examples").glob("*/README.md"))


def written(system: System) -> str:
    (file,) = adf.emit(system, adf.Options(), Diagnostics())
    return file.text


def read_again(system: System, folder: Path) -> System:
    back = import_adf([Source("robot.json", written(system))], system.name, Diagnostics())
    return printed_and_compiled(back, folder)


def carried(system: System) -> System:
    """Reduce a system to what the file holds: functions and their interfaces."""
    known = {interface.type: interface for interface in system.interfaces}
    kept: dict[Type, Action | Service | Message] = {}
    functions = tuple(map(_plain, system.functions))
    for function in functions:
        call = function.communication
        # What has no fields there is not told from what is not known.
        empty = (
            Action(call.type, (), (), (), external=True)
            if call.paradigm == "action"
            else Service(call.type, (), (), external=True)
        )
        kept[call.type] = known.get(call.type, empty)
        for port in function.ports:
            message = known.get(port.type)
            if isinstance(message, Message) and (message.fields or message.constants):
                kept.setdefault(port.type, message)
    plain = System(
        system.name,
        # What ROS comes with is not described again, unless it is a message with fields.
        tuple(
            replace(each, doc="", external=True)
            for each in kept.values()
            if isinstance(each, Message) or lookup(each.type) is None
        ),
        functions=functions,
    )
    made = _in_ros_1(plain)
    assert isinstance(made, System)
    return made


def _plain(function: Function) -> Function:
    """Without documentation of calls and topics, and a model; inputs first, one type a topic."""
    types: dict[tuple[str, str], Type] = {}
    return replace(
        function,
        model=None,
        communication=replace(function.communication, doc=""),
        ports=tuple(
            replace(port, doc="")
            for direction in ("in", "out")
            for port in function.ports
            if port.direction == direction
            and types.setdefault((direction, port.topic), port.type) == port.type
        ),
        params=tuple(_param(param, function) for param in function.params),
    )


def _param(param: Param, function: Function) -> Param:
    """A number is a number in the file, of whatever type, and a duration one of seconds.

    What a library says itself of other defaults is left out: programs take numbers only.
    """
    types: dict[str, Type] = {"string": STRING, "boolean": BOOL}
    type_ = types.get(value_class(param.type), FLOAT)
    if param.default is None or (function.in_library and type_ != FLOAT):
        return replace(param, type=type_, default=None)
    value = constant(param.default, {})
    assert value is not None
    kind = INT if type(value) is int else type_
    return replace(param, type=type_, default=Literal(value, kind))


def _in_ros_1(node: Any) -> Any:
    """The same without bounds, with documentation in one line."""
    match node:
        case Primitive():
            return Primitive("string" if node.name == "wstring" else node.name)
        case Array(element=element, size=size, bounded=bounded):
            return Array(_in_ros_1(element), None if bounded else size)
        case tuple():
            return tuple(map(_in_ros_1, node))
    if not is_dataclass(node) or isinstance(node, type):
        return node
    values = {field.name: _in_ros_1(getattr(node, field.name)) for field in fields(node)}
    if "doc" in values:
        values["doc"] = " ".join(values["doc"].split())
    return replace(node, **values)


def check(system: System, folder: Path) -> None:
    wanted, back = carried(system), carried(read_again(system, folder))
    assert back.functions == wanted.functions
    assert set(back.interfaces) == set(wanted.interfaces)


@pytest.mark.parametrize("model", EXAMPLES, ids=lambda path: path.name)
def test_examples(model: Path, tmp_path: Path) -> None:
    system = pipeline.check([model]).system
    assert system is not None
    if system.functions:
        check(system, tmp_path)


@pytest.mark.filterwarnings("ignore:Gen")
@settings(
    max_examples=30,
    phases=[Phase.generate],  # shrinking would take minutes
)
# Names that a package of another model cannot have.
@given(systems().filter(lambda s: bool(s.functions) and s.name not in ("my-model", "event")))
def test_whatever_functions_are_like(tmp_path: Path, system: System) -> None:
    # Seconds as a floating-point number do not hold each nanosecond of some months.
    check(told_in_whole_milliseconds(system), tmp_path)


# What is wrong with the file itself, and is repaired with a warning.
REPAIRS = {
    "TakeOff": "cpswarm_msgs/TakeOff",
    "Empty": "std_srvs/Empty",
    "stds_msgs/Header": "std_msgs/Header",
}


def repaired(content: Any) -> Any:
    if isinstance(content, dict):
        return {key: repaired(each) for key, each in content.items()}
    if isinstance(content, list):
        return [repaired(each) for each in content]
    return REPAIRS.get(content, content) if isinstance(content, str) else content


@pytest.mark.skipif(not APPENDIX.exists(), reason=f"no {APPENDIX} (set SWARMDSL_CORPUS)")
def test_the_appendix_of_d5_4(tmp_path: Path) -> None:
    text = APPENDIX.read_text(encoding="utf-8")
    report = Diagnostics()
    system = import_adf([Source("appendix.json", text)], "appendix", report)

    assert {found.name for found in report} == {"renamed", "assumed"}
    assert json.loads(written(printed_and_compiled(system, tmp_path))) == repaired(json.loads(text))
