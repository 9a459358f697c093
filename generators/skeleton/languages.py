"""How Python and C++ write the types and values of the two generations of ROS."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Protocol

from swarmdsl.codegen import dataclass
from swarmdsl.codegen.cpp import literal as cpp_literal
from swarmdsl.codegen.ros import Generation
from swarmdsl.ir import FLOATS, STRING, Array, Literal, Named, Primitive

from .names import python_field

_REAL = (*FLOATS, "duration")


class Language(Protocol):
    """Python or C++ with one generation of ROS."""

    @property
    def ros(self) -> Generation:
        """The generation."""

    def literal(self, text: str) -> str:
        """A text as a literal."""

    def named(self, type_: Named, kind: str) -> str:
        """The class of an interface; `kind` is `msg`, `srv` or `action`."""

    def imported(self, type_: Named, kind: str) -> str:
        """The module or header it is in."""

    def server_types(self, type_: Named, kind: str) -> tuple[str, str, str, str]:
        """The class of an action or service, and those of its parts; empty where it has none."""

    def setting_type(self, type_: Primitive | Array) -> str:
        """The type of a ROS parameter."""

    def value(self, value: object, type_: Primitive | Array) -> str:
        """The value of a ROS parameter."""

    def zero(self, type_: Primitive | Array) -> str:
        """What a ROS parameter is until it has a value."""

    def declared(self, type_: Primitive | Array) -> str:
        """How a ROS parameter is declared that has no value; empty where it need not be."""

    def example(self, type_: Primitive | Array) -> str:
        """Some value of a ROS parameter."""

    def field(self, name: str) -> str:
        """A field of a message."""

    def refusal(self, why: str, response: Mapping[str, str]) -> tuple[str, ...]:
        """The lines that answer a service which is not there yet; types of fields by name."""


@dataclass(frozen=True)
class Python:
    """Python with rospy or rclpy."""

    ros: Generation

    def literal(self, text: str) -> str:
        """`'cmd/climb'`."""
        return repr(text)

    def named(self, type_: Named, kind: str) -> str:
        """`demo.msg.Sample`."""
        return f"{type_.package}.{kind}.{type_.name}"

    def imported(self, type_: Named, kind: str) -> str:
        """The module, `demo.msg`; actions of ROS 1 are messages."""
        module = "msg" if kind == "action" and self.ros == 1 else kind
        return f"{type_.package}.{module}"

    def server_types(self, type_: Named, kind: str) -> tuple[str, str, str, str]:
        """`demo.msg.ClimbAction` and so on, or `demo.action.Climb` and so on."""
        base = f"{self.imported(type_, kind)}.{type_.name}"
        if kind == "srv":
            dot = "." if self.ros == 2 else ""
            return base, f"{base}{dot}Request", f"{base}{dot}Response", ""
        if self.ros == 1:
            return f"{base}Action", f"{base}Goal", f"{base}Result", f"{base}Feedback"
        return base, f"{base}.Goal", f"{base}.Result", f"{base}.Feedback"

    def setting_type(self, type_: Primitive | Array) -> str:
        """`float`."""
        if isinstance(type_, Array):
            return "list"
        names = {"bool": "bool", "string": "str", **dict.fromkeys(_REAL, "float")}
        return names.get(type_.name, "int")

    def value(self, value: object, type_: Primitive | Array) -> str:
        """`0.1`."""
        return repr(value)

    def zero(self, type_: Primitive | Array) -> str:
        """`float()`."""
        return f"{self.setting_type(type_)}()"

    def declared(self, type_: Primitive | Array) -> str:
        """`Parameter.Type.DOUBLE`."""
        if self.ros == 1:
            return ""
        element = type_.element if isinstance(type_, Array) else type_
        assert isinstance(element, Primitive)
        names = {"bool": "BOOL", "string": "STRING", **dict.fromkeys(_REAL, "DOUBLE")}
        array = "_ARRAY" if isinstance(type_, Array) else ""
        return f"Parameter.Type.{names.get(element.name, 'INTEGER')}{array}"

    def example(self, type_: Primitive | Array) -> str:
        """`1.0`."""
        values = {"bool": "True", "str": "'map'", "float": "1.0"}
        if isinstance(type_, Array):
            return f"[{self.example(type_.element)}]"  # type: ignore[arg-type]
        return values.get(self.setting_type(type_), "1")

    def field(self, name: str) -> str:
        """`class_` for `class`."""
        return python_field(name)

    def refusal(self, why: str, response: Mapping[str, str]) -> tuple[str, ...]:
        """An exception; ROS 2 has none that reaches who asks, but often a field `success`."""
        if self.ros == 1:
            return (f"raise rospy.ServiceException({why!r})",)
        lines = [f"self.get_logger().error({why!r})"]
        if response.get("success") == "bool":
            lines.append("response.success = False")
            if response.get("message") == "string":
                lines.append(f"response.message = {why!r}")
        return (*lines, "return response")


@dataclass(frozen=True)
class Cpp:
    """C++ with roscpp or rclcpp."""

    ros: Generation

    def literal(self, text: str) -> str:
        """`"cmd/climb"`."""
        return cpp_literal(Literal(text, STRING)).removeprefix("std::string(").removesuffix(")")

    def named(self, type_: Named, kind: str) -> str:
        """`demo::Sample` or `demo::msg::Sample`."""
        middle = f"{kind}::" if self.ros == 2 else ""
        return f"{type_.package}::{middle}{type_.name}"

    def imported(self, type_: Named, kind: str) -> str:
        """The header, `demo/Sample.h` or `demo/msg/sample.hpp`."""
        if self.ros == 1:
            return f"{type_.package}/{type_.name}{'Action' if kind == 'action' else ''}.h"
        return f"{type_.package}/{kind}/{_header(type_.name)}.hpp"

    def server_types(self, type_: Named, kind: str) -> tuple[str, str, str, str]:
        """`demo::ClimbAction` and so on, or `demo::action::Climb` and so on."""
        base = self.named(type_, kind)
        if kind == "srv":
            return base, f"{base}::Request", f"{base}::Response", ""
        if self.ros == 1:
            return f"{base}Action", f"{base}Goal", f"{base}Result", f"{base}Feedback"
        return base, f"{base}::Goal", f"{base}::Result", f"{base}::Feedback"

    def setting_type(self, type_: Primitive | Array) -> str:
        """`double`; whole numbers of roscpp are ints, those of rclcpp have 64 bits."""
        if isinstance(type_, Array):
            assert isinstance(type_.element, Primitive)
            return f"std::vector<{self.setting_type(type_.element)}>"
        names = {"bool": "bool", "string": "std::string", **dict.fromkeys(_REAL, "double")}
        return names.get(type_.name, "int" if self.ros == 1 else "std::int64_t")

    def value(self, value: object, type_: Primitive | Array) -> str:
        """`0.1`."""
        if isinstance(value, bool):
            return "true" if value else "false"
        return self.literal(value) if isinstance(value, str) else repr(value)

    def zero(self, type_: Primitive | Array) -> str:
        """`{}`."""
        return "{}"

    def declared(self, type_: Primitive | Array) -> str:
        """Nothing: the template says the type."""
        return ""

    def example(self, type_: Primitive | Array) -> str:
        """`1.0`, with its type where it would have another."""
        name = self.setting_type(type_)
        values = {"bool": "true", "std::string": 'std::string("map")', "double": "1.0"}
        return values.get(name, f"{name}{{1}}")

    def field(self, name: str) -> str:
        """The name as it is."""
        return name

    def refusal(self, why: str, response: Mapping[str, str]) -> tuple[str, ...]:
        """False; in rclcpp, what a field `success` can say."""
        if self.ros == 1:
            return (f"ROS_ERROR({_printed(why)});", "return false;")
        lines = [f"RCLCPP_ERROR(get_logger(), {_printed(why)});"]
        if response.get("success") == "bool":
            lines.append("response.success = false;")
            if response.get("message") == "string":
                lines.append(f"response.message = {json.dumps(why)};")
        return tuple(lines)


def language(name: str, ros: Generation) -> Language:
    """The language of a name as options have it."""
    return Python(ros) if name == "python" else Cpp(ros)


def _printed(text: str) -> str:
    """A literal for `printf`, and so for the macros of ROS that log."""
    return json.dumps(text.replace("%", "%%"))


def _header(name: str) -> str:
    """`PoseStamped` becomes `pose_stamped`, as rosidl_cmake calls headers."""
    name = re.sub(r"(.)([A-Z][a-z]+)", r"\1_\2", name)
    return re.sub(r"([a-z0-9])([A-Z])", r"\1_\2", name).lower()
