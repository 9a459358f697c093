"""Abstraction Description Files of all generations: what robots can do, and their devices.

The first generation has `msg_def` and `comm_paradigm`, the second `comm_model` with `paradigm` and
`definition` in it, that of D5.4 `msg` and `param_list`; the exporter of 2021 has no `comm_model`.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any, Literal

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.importing.activities import Library
from swarmdsl.importing.names import Names, is_plain, value_names
from swarmdsl.importing.types import MISSPELT, data_type, qualified
from swarmdsl.ir import (
    Action,
    Array,
    Communication,
    Component,
    Expression,
    Field,
    Function,
    FunctionPort,
    Message,
    Named,
    Param,
    Port,
    Primitive,
    Service,
    Type,
)
from swarmdsl.ir import Literal as Value
from swarmdsl.ir.types import BOOL, FLOAT, INT, STRING
from swarmdsl.source import Source, Span

_TYPES: dict[type, Primitive] = {bool: BOOL, int: INT, float: FLOAT, str: STRING}
_KNOWN = {"runtime-env", "functions", "sensors/actuators"}
_DEVICES: dict[str, Literal["sensor", "actuator", "controller", "virtual"]] = {
    "sensor": "sensor",
    "actuator": "actuator",
    "controller": "controller",
    "virtual": "virtual",
}


def read(source: Source, library: Library, report: Diagnostics) -> None:
    """Add what a file describes to a library; all that is wrong with it is reported."""
    try:
        content = json.loads(source.text)
    except json.JSONDecodeError as error:
        start = min(error.pos, len(source.text))
        place = Span(source, start, min(start + 1, len(source.text)))
        report.report("not-json", place, reason=error.msg)
        return
    except RecursionError:
        report.report("not-json", Span(source, 0, 1), reason="it is nested too deeply")
        return
    if not isinstance(content, dict) or not (content.keys() & {"functions", "sensors/actuators"}):
        reason = "there are no `functions`"
        report.report("not-adf", Span(source, 0, min(1, len(source.text))), reason=reason)
        return
    _Reader(source, library, report).read(content)


class _Reader:
    def __init__(self, source: Source, library: Library, report: Diagnostics) -> None:
        self.source = source
        self.library = library
        self.report = report

    def read(self, content: dict[str, Any]) -> None:
        for key in content.keys() - _KNOWN:
            reason = "only functions and devices are read"
            self.report.report("left-out", self._at(key), what=f"`{key}`", reason=reason)
        for typo, meant in MISSPELT.items():
            match = re.search(rf'(?<="){typo}(?=/)', self.source.text)
            if match is not None:
                place = Span(self.source, *match.span())
                self.report.report("renamed", place, name=typo, new=meant)
        for described in _dicts(content.get("functions")):
            self._function(described)
        for described in _dicts(content.get("sensors/actuators")):
            self._device(described)

    def _device(self, described: dict[str, Any]) -> None:
        """A sensor, actuator or other device, with what it hears and tells as ports."""
        written = str(described.get("name", ""))
        name = self.library.devices.new(written)
        if not is_plain(written):
            self.report.report("renamed", self._at(written), name=written, new=name)
        api = described.get("api")
        api = api if isinstance(api, dict) else {}
        if api.get("services"):
            reason = "nothing says what they are for: a function would"
            what = f"the services of `{written}`"
            self.report.report("left-out", self._at(written), what=what, reason=reason)
        kind = _DEVICES.get(str(described.get("category", "controller")).lower())
        if kind is None:
            what = f"`{described['category']}` is no kind of device"
            self.report.report("assumed", self._at(written), what=what, assumed="`virtual`")
        names = value_names()
        ports = tuple(
            Port(names.new(port.topic.rpartition("/")[2]), port.direction, port.type, port.topic)
            for port in self._ports(api)
        )
        doc = _line(described.get("description"))
        self.library.components.append(Component(name, kind or "virtual", ports, (), doc=doc))

    def _function(self, described: dict[str, Any]) -> None:
        written = str(described.get("name", ""))
        name = self.library.names.new(written)
        if not is_plain(written):
            self.report.report("renamed", self._at(written), name=written, new=name)
        api = described.get("api")
        api = api if isinstance(api, dict) else {}
        self.library.add(
            Function(
                name,
                "swarm" if described.get("category") == "swarm-lib" else "abstraction",
                self._communication(api, written),
                tuple(self._ports(api)),
                tuple(self._params(described)),
                doc=_line(described.get("description")),
            )
        )

    def _communication(self, api: dict[str, Any], name: str) -> Communication:
        model = api.get("comm_model")
        if not isinstance(model, dict):
            what = f"how `{name}` is called is not said"
            assumed = f"an action `{name}` of `cpswarm_msgs/Empty`"
            self.report.report("assumed", self._at(name), what=what, assumed=assumed)
            return Communication("action", _topic(name), Named("cpswarm_msgs", "Empty"))
        paradigm = str(model.get("paradigm", api.get("comm_paradigm", "")))
        definition = model.get("definition", model)
        definition = definition if isinstance(definition, dict) else {}
        is_service = paradigm == "rosservice"
        if paradigm not in ("rosaction", "rosservice"):
            is_service = "request" in definition or "response" in definition
            kind = "service" if is_service else "action"
            what = f"`{paradigm}` is no paradigm"
            self.report.report("assumed", self._at(paradigm or name), what=what, assumed=kind)
        kind = "service" if is_service else "action"
        type_ = self._interface(str(definition.get("class", "")), kind, name)
        parts = {
            key: self._fields(definition.get(key))
            for key in ("goal", "result", "feedback", "request", "response")
        }
        self.library.describe(
            Service(type_, parts["request"], parts["response"], external=True)
            if is_service
            else Action(type_, parts["goal"], parts["result"], parts["feedback"], external=True)
        )
        called: Literal["action", "service"] = "service" if is_service else "action"
        server = str(definition.get("name", name))
        if _topic(server) != server:
            self.report.report("renamed", self._at(server), name=server, new=_topic(server))
        return Communication(called, _topic(server), type_)

    def _interface(self, written: str, kind: str, name: str) -> Named:
        type_ = qualified(written, kind)
        if not re.search(r"[/.]", written):
            what = f"the package of `{written}` is not said"
            place = self._at(written or name)
            self.report.report("assumed", place, what=what, assumed=f"`{type_}`")
        return type_

    def _ports(self, api: dict[str, Any]) -> Iterator[FunctionPort]:
        directions: tuple[tuple[Literal["in", "out"], str], ...] = (
            ("in", "inputs"),
            ("out", "outputs"),
        )
        for direction, key in directions:
            seen: dict[str, Type] = {}
            for port in _dicts(api.get(key)):
                message = port.get("msg", port.get("msg_def"))
                message = message if isinstance(message, dict) else {}
                topic = str(port.get("topic", ""))
                type_ = self._interface(str(message.get("class", "")), "message", topic)
                fields = self._fields(message.get("fields"))
                if fields:
                    self.library.describe(Message(type_, fields, external=True))
                if seen.setdefault(topic, type_) != type_:
                    what, reason = f"topic `{topic}` of `{type_}`", f"it carries `{seen[topic]}`"
                    self.report.report("left-out", self._at(topic), what=what, reason=reason)
                    continue
                yield FunctionPort(direction, _topic(topic), type_)

    def _params(self, described: dict[str, Any]) -> Iterator[Param]:
        names: Names = value_names()
        for param in _dicts(described.get("param_list")):
            written = str(param.get("name", ""))
            name = names.new(written)
            if not is_plain(written):
                self.report.report("renamed", self._at(written), name=written, new=name)
            value = param.get("value")
            type_ = _param_type(str(param.get("class", "")), value)
            default: Expression | None = None
            if isinstance(value, (bool, int, float, str)):
                whole = type_ == FLOAT and type(value) is int
                default = Value(float(value) if whole else value, _TYPES[type(value)])
            elif value is not None:
                what = f"the value of `{written}`"
                reason = "it is no number, text or truth value"
                self.report.report("left-out", self._at(written), what=what, reason=reason)
            yield Param(name, type_, default, doc=_line(param.get("description")))

    def _fields(self, described: object) -> tuple[Field, ...]:
        if isinstance(described, dict):
            described = described.get("fields")
        return tuple(
            Field(
                str(field.get("name", "")),
                data_type(str(field.get("class", ""))),
                doc=_line(field.get("description")),
            )
            for field in _dicts(described)
            if re.fullmatch(r"[A-Za-z]\w*", str(field.get("name", "")), re.ASCII)
        )

    def _at(self, word: str) -> Span:
        """Where a text stands in the file for the first time, without its quotes."""
        text = json.dumps(word, ensure_ascii=False)
        start = self.source.text.find(text)
        if start < 0:
            return Span(self.source, 0, min(1, len(self.source.text)))
        return Span(self.source, start + 1, start + len(text) - 1)


def _param_type(class_: str, value: object) -> Type:
    if class_ == "array":
        inner = value[0] if isinstance(value, list) and value else 0.0
        return Array(_TYPES.get(type(inner), FLOAT))
    type_ = data_type(class_ or "number")
    # What a value is says more than a class that it cannot be of.
    fits = isinstance(type_, Primitive) and (class_ != "number" or type(value) not in (bool, str))
    return type_ if fits or type(value) not in _TYPES else _TYPES[type(value)]


def _dicts(items: object) -> list[dict[str, Any]]:
    return [item for item in items if isinstance(item, dict)] if isinstance(items, list) else []


def _line(text: object) -> str:
    return " ".join(str(text).split()) if text else ""


def _topic(name: str) -> str:
    """A name that ROS takes."""
    plain = re.sub(r"[^A-Za-z0-9_/]+", "_", name).strip("_/")
    return plain if plain[:1].isalpha() else f"n_{plain}"
