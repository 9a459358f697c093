"""Target `composition`: the members of a swarm, and a launch file for each role.

The schema is `SwarmComposition` of the CPSwarm modelling tool. A member has a number and a launch
file, which is started that many times.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType

from lxml import etree

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.naming import snake_case
from swarmdsl.base.records import dataclass
from swarmdsl.base.xml_writer import legal
from swarmdsl.codegen.api import Generator, OutputFile, option
from swarmdsl.codegen.exchange.search_space import behaviour_package
from swarmdsl.codegen.ros.package import package_fault
from swarmdsl.codegen.ros.yaml_values import yaml_value
from swarmdsl.codegen.shared.constants import Value
from swarmdsl.codegen.shared.nodes import ParamValue, behavior_nodes
from swarmdsl.codegen.xml_tree import add_comment, document
from swarmdsl.ir import Member, Role, Swarm, System, Type
from swarmdsl.syntax.types import INTEGERS, Primitive


@dataclass(frozen=True)
class Options:
    """Options of target `composition`."""

    package: str = option(
        "",
        "ROS package with the behaviours; that of target smach if empty",
        check=package_fault,
    )


def emit(system: System, options: Options, report: Diagnostics) -> Iterator[OutputFile]:
    """Yield a folder for each swarm: its composition and its launch files."""
    package = behaviour_package(system, options.package)
    members = system.members_by_name
    for swarm in system.swarms:
        folder = snake_case(swarm.name)
        text = document(_composition(swarm, report))
        yield OutputFile(f"{folder}/composition.xml", text, origin=swarm.origin)
        for role in swarm.roles:
            text = document(_launch(role, members[role.member], system, package))
            yield OutputFile(f"{folder}/launch/{role.name}.launch", text, origin=role.origin)


def _composition(swarm: Swarm, report: Diagnostics) -> etree._Element:
    root = etree.Element("swarm", name=swarm.name)
    add_comment(root, swarm.doc)
    for role in swarm.roles:
        number = max(role.multiplicity.lower, 1)
        if role.multiplicity.upper != role.multiplicity.lower:
            report.report(
                "no-place",
                role.origin,
                target="composition",
                what=f"multiplicity `{role.multiplicity}`",
                notes=(f"a member has one number there: {number} is written",),
            )
        attributes = {
            "name": role.name,
            "launchFile": f"{role.name}.launch",
            "number": str(number),
        }
        etree.SubElement(root, "SwarmMember", attributes).text = legal(role.doc) or None
    return root


def _launch(role: Role, member: Member, system: System, package: str) -> etree._Element:
    """Return a launch file with the node of a member and of each part that has one."""
    root = etree.Element("launch")
    add_comment(root, role.doc)
    etree.SubElement(root, "arg", name="id", default="0", doc="which one of the role it is")
    group = etree.SubElement(root, "group", ns=f"{role.name}_$(arg id)")
    own = {
        robot.index: list(behavior_nodes(role.configured(member, robot.index), system))
        for robot in role.robots
    }
    for number, node in enumerate(behavior_nodes(role.configured(member), system)):
        type_ = snake_case(node.machine.name)
        attributes = {"pkg": package, "type": type_, "name": node.name, "output": "screen"}
        element = etree.SubElement(group, "node", attributes)
        _add_params(element, node.params)
        for index, nodes in own.items():
            others = (g for g in nodes[number].params if g not in node.params)
            _add_params(element, others, {"if": f"$(eval arg('id') == {index})"})
        for name, topic in node.remaps:
            etree.SubElement(element, "remap", {"from": name, "to": topic})
    return root


def _add_params(
    node: etree._Element,
    params: Iterable[ParamValue],
    condition: Mapping[str, str] = MappingProxyType({}),
) -> None:
    """Add the params with a value that is known at compile time."""
    for given in params:
        if isinstance(given.value, str) and _is_changed(given.value):
            attributes = {"param": given.param.name, **condition}
            etree.SubElement(node, "rosparam", attributes).text = yaml_value(given.value)
        elif given.value is not None:
            type_, text = _kind(given.param.type), _text(given.value)
            attributes = {"name": given.param.name, "type": type_, "value": text, **condition}
            etree.SubElement(node, "param", attributes)


def _is_changed(text: str) -> bool:
    """Return True if roslaunch changes a value: it substitutes `$(...)` and removes blanks."""
    return "$(" in text or text != text.strip()


def _kind(type_: Type) -> str:
    """Return a type as roslaunch names it; durations are numbers of seconds."""
    name = type_.name if isinstance(type_, Primitive) else ""
    if name in INTEGERS:
        return "int"
    return {"bool": "bool", "string": "str", "wstring": "str"}.get(name, "double")


def _text(value: Value) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


generator = Generator(
    target="composition",
    summary="the members of a swarm as XML, and launch files for them",
    emit=emit,
    options_type=Options,
)
