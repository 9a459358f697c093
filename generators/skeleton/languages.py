"""Types and values of ROS 1 and 2 in Python and C++."""

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
    """Python or C++ with ROS 1 or 2."""

    @property
    def ros(self) -> Generation:
        """Version of ROS, 1 or 2."""

    def literal(self, text: str) -> str:
        """Return a string literal."""

    def named(self, type_: Named, kind: str) -> str:
        """Return the class of an interface; `kind` is `msg`, `srv` or `action`."""

    def imported(self, type_: Named, kind: str) -> str:
        """Return the module or header of an interface."""

    def server_types(self, type_: Named, kind: str) -> tuple[str, str, str, str]:
        """Return the classes of an action or service and its parts, empty if it has none."""

    def setting_type(self, type_: Primitive | Array) -> str:
        """Return the type of a ROS parameter."""

    def value(self, value: object, type_: Primitive | Array) -> str:
        """Return the literal of a parameter value."""

    def zero(self, type_: Primitive | Array) -> str:
        """Return the value of a ROS parameter until it is set."""

    def declared(self, type_: Primitive | Array) -> str:
        """Return the declaration of a ROS parameter without a value, empty if none is needed."""

    def example(self, type_: Primitive | Array) -> str:
        """Return an example value of a ROS parameter."""

    def field(self, name: str) -> str:
        """Return the name of a field of a message."""

    def refusal(self, why: str, response: Mapping[str, str]) -> tuple[str, ...]:
        """Return the lines that refuse a request; `fields` are types by name."""


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
        """Return the module `demo.msg`; actions of ROS 1 are messages."""
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
            return f"[{self.example(type_.element)}]"  # type: ignore[arg-type]  # a primitive
        return values.get(self.setting_type(type_), "1")

    def field(self, name: str) -> str:
        """`class_` for `class`."""
        return python_field(name)

    def refusal(self, why: str, response: Mapping[str, str]) -> tuple[str, ...]:
        """Return an exception; in ROS 2, a field `success` if the response has one."""
        if self.ros == 1:
            return (f"raise rospy.ServiceException({why!r})",)
        if not reports_failure(response, self.ros):
            return (f"raise NotImplementedError({why!r})",)
        lines = [f"self.get_logger().error({why!r})", "response.success = False"]
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
        """Header `demo/Sample.h` or `demo/msg/sample.hpp`."""
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
        """`double`; integers are `int` in roscpp, and have 64 bits in rclcpp."""
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
        """Empty: the template has the type."""
        return ""

    def example(self, type_: Primitive | Array) -> str:
        """`1.0`, with its type where the literal has another type."""
        name = self.setting_type(type_)
        values = {"bool": "true", "std::string": 'std::string("map")', "double": "1.0"}
        return values.get(name, f"{name}{{1}}")

    def field(self, name: str) -> str:
        """Return the name unchanged."""
        return name

    def refusal(self, why: str, response: Mapping[str, str]) -> tuple[str, ...]:
        """`return false;`; in rclcpp, a field `success`, else an exception."""
        if self.ros == 1:
            return (f"ROS_ERROR({_printed(why)});", "return false;")
        if not reports_failure(response, self.ros):
            return (f"throw std::runtime_error({json.dumps(why)});",)
        lines = [f"RCLCPP_ERROR(get_logger(), {_printed(why)});", "response.success = false;"]
        if response.get("message") == "string":
            lines.append(f"response.message = {json.dumps(why)};")
        return tuple(lines)


def language(name: str, ros: Generation) -> Language:
    """Return the language of option `language`."""
    return Python(ros) if name == "python" else Cpp(ros)


def reports_failure(response: Mapping[str, str], ros: Generation) -> bool:
    """Return True if a service can tell its client that a request failed.

    ROS 1 does that for any service; in ROS 2 it takes a field `success` of the response.
    """
    return ros == 1 or response.get("success") == "bool"


def _printed(text: str) -> str:
    """Return a literal for `printf`, which the logging macros of ROS use."""
    return json.dumps(text.replace("%", "%%"))


def _header(name: str) -> str:
    """Return the name of a header as in rosidl_cmake: `PoseStamped` is `pose_stamped`."""
    name = re.sub(r"(.)([A-Z][a-z]+)", r"\1_\2", name)
    return re.sub(r"([a-z0-9])([A-Z])", r"\1_\2", name).lower()
