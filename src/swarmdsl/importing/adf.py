"""Import Abstraction Description Files (ADF) of all generations.

The first generation has `msg_def` and `comm_paradigm`; the second has `comm_model` with `paradigm`
and `definition`; that of D5.4 has `msg` and `param_list`; the exporter of 2021 has no `comm_model`.
Algorithm Modelling Files, which describe swarm behaviors, have the form of the first generation.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, Literal

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.numerals import fits_64_bits
from swarmdsl.base.source import Source, Span
from swarmdsl.importing.json_file import JsonContent, read_json
from swarmdsl.importing.library import Library
from swarmdsl.importing.names import NamePool, is_plain, value_names
from swarmdsl.importing.types import MISSPELT, data_type, qualified
from swarmdsl.ir import (
    Action,
    Array,
    Communication,
    Component,
    Constant,
    Expression,
    Field,
    Function,
    FunctionPort,
    Interface,
    Message,
    Named,
    Param,
    Port,
    Primitive,
    Service,
    Type,
)
from swarmdsl.ir import Literal as Value
from swarmdsl.syntax.parser.literals import forbidden_character
from swarmdsl.syntax.types import BOOL, DURATION, FLOAT, INT, STRING

_TYPES: dict[type, Primitive] = {bool: BOOL, int: INT, float: FLOAT, str: STRING}
# 64 bits of nanoseconds.
_MOST_SECONDS = 2**63 // 1_000_000_000
_CATEGORIES: dict[str, Literal["abstraction", "swarm"]] = {
    "abstraction-lib": "abstraction",
    "swarm-lib": "swarm",
}
_TOPIC = re.compile(r"[~/]?[A-Za-z]\w*(?:/\w+)*", re.ASCII)
_KNOWN = {"runtime-env", "functions", "sensors/actuators"}
_DEVICES: dict[str, Literal["sensor", "actuator", "controller", "virtual"]] = {
    "sensor": "sensor",
    "actuator": "actuator",
    "controller": "controller",
    "virtual": "virtual",
}


def read(
    source: Source,
    library: Library,
    report: Diagnostics,
    category: Literal["abstraction", "swarm"] = "abstraction",
) -> None:
    """Add the functions and devices of a file to a library and report errors.

    `category` is for functions that do not state theirs.
    """
    content = read_json(source, report)
    if content is None:
        return
    if not isinstance(content, dict) or not (content.keys() & {"functions", "sensors/actuators"}):
        reason = "there are no `functions`"
        report.report("not-adf", Span(source, 0, min(1, len(source.text))), reason=reason)
        return
    _Reader(source, library, report, category).read(content)


class _Reader:
    def __init__(
        self,
        source: Source,
        library: Library,
        report: Diagnostics,
        category: Literal["abstraction", "swarm"],
    ) -> None:
        self.source = source
        self.content = JsonContent(source, report)
        self.library = library
        self.report = report
        self.category = category

    def read(self, content: dict[str, Any]) -> None:
        for key in content.keys() - _KNOWN:
            reason = "only functions and devices are imported"
            self.report.report("left-out", self.content.at(key), what=f"`{key}`", reason=reason)
        for typo, meant in MISSPELT.items():
            match = re.search(rf'(?<="){typo}(?=/)', self.source.text)
            if match is not None:
                place = Span(self.source, *match.span())
                self.report.report("renamed", place, name=typo, new=meant)
        for described in self.content.objects(content, "functions"):
            self._function(described)
        for described in self.content.objects(content, "sensors/actuators"):
            self._device(described)

    def _device(self, described: dict[str, Any]) -> None:
        """Read a sensor, actuator or other device with its ports."""
        written = str(described.get("name", ""))
        name = self.library.devices.new(written)
        if not is_plain(written):
            self.report.report("renamed", self.content.at(written), name=written, new=name)
        api = self.content.inside(described, "api")
        if api.get("services"):
            reason = "their purpose is unknown; describe them as functions"
            what = f"the services of `{written}`"
            self.report.report("left-out", self.content.at(written), what=what, reason=reason)
        if "category" not in described:
            self.library.guesses.add((name, "kind"))
        kind = _DEVICES.get(str(described.get("category", "controller")).lower())
        if kind is None:
            self.library.guesses.add((name, "kind"))
            what = f"`{described['category']}` is not a kind of device"
            self.report.report("assumed", self.content.at(written), what=what, assumed="`virtual`")
        names = value_names()
        ports = tuple(
            Port(names.new(port.topic.rpartition("/")[2]), port.direction, port.type, port.topic)
            for port in self._ports(api)
        )
        doc = _line(described.get("description"))
        self.library.components.append(Component(name, kind or "virtual", ports, (), doc=doc))

    def _function(self, described: dict[str, Any]) -> None:
        written = str(described.get("name", ""))
        name = self.library.names.exact(written)
        if name != written:
            self.report.report("renamed", self.content.at(written), name=written, new=name)
        api = self.content.inside(described, "api")
        if str(described.get("category")) not in _CATEGORIES:
            self.library.guesses.add((name, "category"))
        if not isinstance(api.get("comm_model"), dict):
            self.library.guesses.add((name, "communication"))
        self.library.add(
            Function(
                name,
                _CATEGORIES.get(str(described.get("category")), self.category),
                self._communication(api, written),
                tuple(self._ports({**api, "dependencies": described.get("dependencies")})),
                tuple(self._params(described)),
                doc=_line(described.get("description")),
            )
        )

    def _communication(self, api: dict[str, Any], name: str) -> Communication:
        model = api.get("comm_model")
        if not isinstance(model, dict):
            what = f"the communication of `{name}` is missing"
            assumed = f"an action `{name}` of `cpswarm_msgs/Empty`"
            self.report.report("assumed", self.content.at(name), what=what, assumed=assumed)
            return Communication("action", _topic(name), Named("cpswarm_msgs", "Empty"))
        paradigm = str(model.get("paradigm", api.get("comm_paradigm", "")))
        definition = self.content.inside(model, "definition") if "definition" in model else model
        is_service = paradigm == "rosservice"
        if paradigm not in ("rosaction", "rosservice"):
            is_service = "request" in definition or "response" in definition
            kind = "service" if is_service else "action"
            what = f"`{paradigm}` is not a paradigm"
            self.report.report(
                "assumed", self.content.at(paradigm or name), what=what, assumed=kind
            )
        kind = "service" if is_service else "action"
        type_ = self._interface(str(definition.get("class", "")), kind, name)
        parts = {
            key: self._part(definition, key)
            for key in ("goal", "result", "feedback", "request", "response")
        }
        self._describe(
            Service(type_, parts["request"], parts["response"], external=True)
            if is_service
            else Action(type_, parts["goal"], parts["result"], parts["feedback"], external=True)
        )
        called: Literal["action", "service"] = "service" if is_service else "action"
        server = str(definition.get("name", name))
        if _topic(server) != server:
            self.report.report("renamed", self.content.at(server), name=server, new=_topic(server))
        return Communication(called, _topic(server), type_)

    def _describe(self, interface: Interface) -> None:
        if not self.library.describe(interface):
            what, reason = (
                f"the description of `{interface.type}`",
                "its fields differ from those in ROS",
            )
            place = self.content.at(str(interface.type))
            self.report.report("left-out", place, what=what, reason=reason)

    def _interface(self, written: str, kind: str, name: str) -> Named:
        type_ = qualified(written, kind)
        if not re.search(r"[/.]", written):
            what = f"the package of `{written}` is missing"
            place = self.content.at(written or name)
            self.report.report("assumed", place, what=what, assumed=f"`{type_}`")
        return type_

    def _ports(self, api: dict[str, Any]) -> Iterator[FunctionPort]:
        directions: tuple[tuple[Literal["in", "out"], str], ...] = (
            ("in", "inputs"),
            ("out", "outputs"),
            ("in", "dependencies"),
        )
        heard: set[str] = set()
        for direction, key in directions:
            seen: dict[str, Type] = {}
            for port in self.content.objects(api, key):
                message = self.content.inside(port, "msg" if "msg" in port else "msg_def")
                topic = str(port.get("topic", ""))
                type_ = self._interface(str(message.get("class", "")), "message", topic)
                fields = self._fields(message)
                constants = tuple(self._constants(message))
                if fields or constants:
                    self._describe(Message(type_, fields, True, constants))
                if seen.setdefault(topic, type_) != type_:
                    what, reason = f"topic `{topic}` of `{type_}`", f"it carries `{seen[topic]}`"
                    self.report.report("left-out", self.content.at(topic), what=what, reason=reason)
                    continue
                if key == "dependencies":
                    if topic in heard:
                        continue
                    what = f"the direction of `{topic}` is missing"
                    assumed = "an input"
                    self.report.report(
                        "assumed", self.content.at(topic), what=what, assumed=assumed
                    )
                heard.add(topic)
                yield FunctionPort(direction, _topic(topic), type_)

    def _params(self, described: dict[str, Any]) -> Iterator[Param]:
        names: NamePool = value_names()
        for param in self.content.objects(described, "param_list"):
            written = str(param.get("name", ""))
            name = names.exact(written)
            if name != written:
                self.report.report("renamed", self.content.at(written), name=written, new=name)
            value = param.get("value")
            type_ = _param_type(str(param.get("class", "")), value)
            default: Expression | None = None
            if isinstance(value, (bool, int, float, str)) and not _forbidden(value):
                default = Value(value, _TYPES[type(value)])
            elif value is not None:
                what = f"the value of `{written}`"
                reason = _forbidden(value) or "it is not a number, string or boolean"
                self.report.report("left-out", self.content.at(written), what=what, reason=reason)
            yield Param(name, type_, default, doc=_line(param.get("description")))

    def _constants(self, message: dict[str, Any]) -> Iterator[Constant]:
        for constant in self.content.objects(message, "constants"):
            name, value = str(constant.get("name", "")), constant.get("value")
            type_ = data_type(str(constant.get("class", "")))
            fault = _forbidden(value)
            if type_ == DURATION and isinstance(value, (int, float)) and abs(value) > _MOST_SECONDS:
                fault = "ROS has no duration of this length"
            if is_plain(name) and isinstance(value, (bool, int, float, str)) and not fault:
                doc = _line(constant.get("description"))
                known = Value(value, _TYPES[type(value)])
                if type_ == DURATION and not isinstance(value, (bool, str)):
                    known = Value(round(value * 1_000_000_000), DURATION)
                yield Constant(name, type_, known, doc)
            else:
                reason = fault or "it is not a name with a number, string or boolean"
                what = f"constant `{name}`"
                self.report.report("left-out", self.content.at(name), what=what, reason=reason)

    def _part(self, definition: dict[str, Any], key: str) -> tuple[Field, ...]:
        """Fields of a goal, result or the like, with or without an enclosing object."""
        if isinstance(definition.get(key), list):
            return self._fields({"fields": definition[key]})
        return self._fields(self.content.inside(definition, key))

    def _fields(self, described: dict[str, Any]) -> tuple[Field, ...]:
        fields = []
        for field in self.content.objects(described, "fields"):
            name = str(field.get("name", ""))
            if not re.fullmatch(r"[A-Za-z]\w*", name, re.ASCII):
                reason = "it is not a valid field name"
                self.report.report(
                    "left-out", self.content.at(name), what=f"field `{name}`", reason=reason
                )
                continue
            type_ = data_type(str(field.get("class", "")))
            fields.append(Field(name, type_, doc=_line(field.get("description"))))
        return tuple(fields)


def _param_type(class_: str, value: object) -> Type:
    if class_ == "array":
        inner = value[0] if isinstance(value, list) and value else 0.0
        return Array(_TYPES.get(type(inner), FLOAT))
    type_ = data_type(class_ or "number")
    # If class and value contradict each other, trust the value.
    fits = isinstance(type_, Primitive) and (class_ != "number" or type(value) not in (bool, str))
    return type_ if fits or type(value) not in _TYPES else _TYPES[type(value)]


def _forbidden(value: object) -> str:
    """Return the reason why no model contains a string or number, or nothing."""
    if isinstance(value, (int, float)) and not fits_64_bits(value):
        return "no type of a model has so large a number"
    forbidden = forbidden_character(value) if isinstance(value, str) else None
    return f"a string of a model cannot contain {forbidden}" if forbidden else ""


def _line(text: object) -> str:
    return " ".join(str(text).split()) if text else ""


def _topic(name: str) -> str:
    """Replace characters that ROS does not allow in names."""
    if _TOPIC.fullmatch(name):
        return name
    plain = re.sub(r"[^A-Za-z0-9_/]+", "_", name).strip("_/")
    return plain if plain[:1].isalpha() else f"n_{plain}"
