"""Parameter files: the values of the model for robot types, and a file for each robot."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.codegen.python import comment_lines
from swarmdsl.codegen.ros import yaml_key, yaml_value
from swarmdsl.codegen.shared import BehaviorNode, ParamValue, Value, doc_with_unit

from .robots import Fleet, Robot


def node_params(nodes: Iterable[BehaviorNode], header: str, about: str) -> str:
    """Return the parameter file of a robot type, a role or a robot, with the model's values."""
    lines = [f"# {header}", f"# {about}"]
    for node in nodes:
        lines += ["", f"{yaml_key(node.name)}:" if node.params else f"# {node.name} has no params."]
        for given in node.params:
            lines += [
                f"  # {line}".rstrip()
                for line in comment_lines(doc_with_unit(given.param.doc, given.param.type))
            ]
            lines.append(_line(given))
        if node.params and not any(given.value is not None for given in node.params):
            lines.append("  {}")
    return "\n".join(lines) + "\n"


def own_params(robot: Robot, fleet: Fleet, name: str) -> str:
    """Return the user's parameter file of one robot, with commented examples."""
    lines = [
        f"# Params of {name} in swarm {fleet.swarm.name}; they override the params of its type.",
        "# Once you have edited this file, it is yours.",
    ]
    for node in robot.nodes:
        lines += ["#", f"# {yaml_key(node.name)}:"]
        lines += [
            f"#   {yaml_key(given.param.name)}: {_text(given.value)}" for given in node.params
        ]
        lines.append("#   introspection: true")
    return "\n".join(lines) + "\n"


def _line(given: ParamValue) -> str:
    if given.value is None:
        return f"  # {given.param.name}: requires a value of type {given.param.type}"
    return f"  {yaml_key(given.param.name)}: {_text(given.value)}"


def _text(value: Value | None) -> str:
    return yaml_value(value) if value is not None else "..."
