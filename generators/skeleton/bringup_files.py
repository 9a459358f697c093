"""Files of the package that starts components: launch files, params, manifest."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from lxml import etree

from swarmdsl.codegen import OutputFile, member_pictures
from swarmdsl.codegen.ros import manifest, yaml_key
from swarmdsl.codegen.xml_tree import Places, add_comment, document
from swarmdsl.ir import System

from .bringup import Bringup, Robot
from .options import Options

Fill = Callable[..., str]
_PARAMS = "$(find {package})/param/{name}.yaml"


def bringup_files(
    made: Bringup, system: System, options: Options, fill: Fill
) -> Iterator[OutputFile]:
    """Yield the files of the package; `fill` renders a template."""
    root, ros2 = made.package, options.ros == 2
    depends = [("exec_depend", name) for name in made.depends]
    if ros2:
        tools = [("exec_depend", name) for name in ("launch", "launch_ros")]
        depends = [("buildtool_depend", "ament_cmake"), *tools, *depends]
    else:
        depends = [("buildtool_depend", "catkin"), ("exec_depend", "roslaunch"), *depends]
    summary = f"Starts the functions and components of {_listed(made)}."
    text = manifest(
        root,
        summary,
        depends,
        options,
        format_=3 if ros2 else 2,
        build_type="ament_cmake" if ros2 else "",
    )
    yield OutputFile(f"{root}/package.xml", text)
    members = [robot.member for robot in made.robots]
    values = {"summary": summary, "pictures": member_pictures(system, members), "ros2": ros2}
    yield OutputFile(f"{root}/README.md", fill("bringup.md", bringup=made, **values))
    folder = "config" if ros2 else "param"
    folders = ["launch", *([folder] if made.has_values else [])]
    text = fill(f"ros{options.ros}/bringup.cmake", bringup=made, folders=folders)
    yield OutputFile(f"{root}/CMakeLists.txt", text)
    for robot in made.robots:
        path = f"{root}/launch/{robot.name}.launch"
        if ros2:
            text = fill("ros2/bringup.launch.py", bringup=made, robot=robot)
            yield OutputFile(f"{path}.py", text, origin=robot.origin)
        else:
            yield OutputFile(path, _launch(robot, made), origin=robot.origin)
        if robot.has_values:
            text = _values(robot, made, ros2)
            yield OutputFile(f"{root}/{folder}/{robot.name}.yaml", text, origin=robot.origin)


def _listed(made: Bringup) -> str:
    return ", ".join(robot.member for robot in made.robots)


def _launch(robot: Robot, made: Bringup) -> str:
    """Return the launch file of a robot for ROS 1; values of the model override those of nodes."""
    places: Places = {}
    root = etree.Element("launch")
    for line in (made.header, *robot.doc):
        add_comment(root, line)
    for name, default, doc in (
        ("name", f"{robot.name}_0", "the namespace of the robot"),
        ("params", "", "a YAML file with params of this robot"),
    ):
        etree.SubElement(root, "arg", name=name, default=default, doc=doc)
    group = etree.SubElement(root, "group", ns="$(arg name)")
    for node in robot.nodes:
        if node.has_settings:
            file = _PARAMS.format(package=node.package, name=node.package)
            etree.SubElement(group, "rosparam", command="load", ns=node.name, file=file)
    if robot.has_values:
        file = _PARAMS.format(package=made.package, name=robot.name)
        etree.SubElement(group, "rosparam", command="load", file=file)
    given = {"if": "$(eval arg('params') != '')"}
    etree.SubElement(group, "rosparam", {"command": "load", "file": "$(arg params)", **given})
    for node in robot.nodes:
        for line in node.doc:
            add_comment(group, line)
        about = {"pkg": node.package, "type": f"{node.package}_node", "name": node.name}
        element = etree.SubElement(group, "node", {**about, "output": "screen"})
        places[element] = node.origin
        for name, topic in node.remaps:
            etree.SubElement(element, "remap", {"from": name, "to": topic})
    return document(root, places)


def _values(robot: Robot, made: Bringup, ros2: bool) -> str:
    """Return the params of parts with values in the model, as YAML."""
    lines = [f"# {made.header}", f"# Params of the parts of every {robot.member}."]
    for node in robot.nodes:
        if node.values:
            lines += (
                [f"/**/{node.name}:", "  ros__parameters:"] if ros2 else [f"{yaml_key(node.name)}:"]
            )
            indent = "    " if ros2 else "  "
            lines += [f"{indent}{yaml_key(name)}: {value}" for name, value in node.values]
    return "".join(f"{line}\n" for line in lines)
