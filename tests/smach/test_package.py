"""Package files beside nodes: launch files, parameters, test, README."""

from __future__ import annotations

from collections.abc import Callable

import yaml
from lxml import etree

from swarmdsl.codegen.api import OutputFile

Generate = Callable[..., dict[str, OutputFile]]

MODEL = """
package lab
swarm event Found : cpswarm_msgs/Note
swarm event Bare  : std_msgs/Empty
message cpswarm_msgs/Note { swarmio : swarmros/EventHeader, x : float64 }
message std_msgs/Empty { }
statemachine Look {
  /// How long it looks.
  param wait  : duration
  param name  : string
  param small : float64 = 0.0000001
  param loud  : bool = true
  initial A
  state A { after wait / send Found(x = small), send Bare() -> B }
  final B
}
sensor Eye {
  behavior Look
  param wait : duration = 2 s
  param name : string
}
/// Flies.
member Uav {
  behavior Look
  param wait : duration = 1500 ms
  param name : string = "it's $(x)"
  left : Eye { wait = 500 ms, name = "port" }
}
member Stone { }
environment Field { world "worlds/field.world" }
/// All of them.
swarm Search {
  uav   : Uav[2..3]
  stone : Stone[2]
  environment Field
}
"""


def _args(root: etree._Element) -> dict[str, str | None]:
    return {str(arg.get("name")): arg.get("default") for arg in root.findall("arg")}


def _launch(files: dict[str, OutputFile], name: str) -> etree._Element:
    return etree.fromstring(files[f"launch/{name}.launch"].text.encode())


def test_launch_file_of_a_robot(generate: Generate) -> None:
    root = _launch(generate(MODEL), "uav")
    assert _args(root) == {
        "name": "uav_0",
        "member": "$(arg name)",
        "count": "0",
        "params": "",
        "introspection": "false",
        "bridge": "false",
    }
    (group,) = root.findall("group")
    assert group.get("ns") == "$(arg name)"
    nodes = [(n.get("pkg"), n.get("type"), n.get("name")) for n in group.findall("node")]
    assert nodes == [
        ("lab_behavior", "look", "look"),
        ("lab_behavior", "look", "left"),
        ("swarmros", "bridge", "swarmros"),
    ]
    files = [load.get("file") for load in group.findall("rosparam")]
    assert files == ["$(find lab_behavior)/param/uav.yaml", "$(arg params)"]


def test_roles_and_robots_have_their_values(generate: Generate) -> None:
    head = "uav   : Uav[2..3]"
    files = generate(MODEL.replace(head, head + ' { wait = 4 s } uav[1] { name = "two" }'))
    role = yaml.safe_load(files["param/search/uav.model.yaml"].text)
    robot = yaml.safe_load(files["param/search/uav_1.model.yaml"].text)
    assert (role["look"]["wait"], role["look"]["name"]) == (4.0, "it's $(x)")
    assert (robot["look"]["wait"], robot["look"]["name"]) == (4.0, "two")
    assert "param/search/uav_0.model.yaml" not in files

    passed = [
        {arg.get("name"): arg.get("value") for arg in include.findall("arg")}["values"]
        for include in _launch(files, "search").findall("include")
    ]
    folder = "$(find lab_behavior)/param/search"
    assert passed == [f"{folder}/{name}.model.yaml" for name in ("uav", "uav_1", "uav")]
    loaded = [load.get("file") for load in _launch(files, "uav").find("group").findall("rosparam")]
    assert loaded == ["$(find lab_behavior)/param/uav.yaml", "$(arg values)", "$(arg params)"]


def test_launch_file_of_a_swarm(generate: Generate) -> None:
    files = generate(MODEL)
    root = _launch(files, "search")
    assert _args(root) == {"uav_count": "2", "introspection": "false", "bridge": "false"}
    includes = root.findall("include")
    assert [include.get("if") for include in includes] == [
        None,
        None,
        "$(eval arg('uav_count') > 2)",
    ]
    for number, include in enumerate(includes):
        values = {arg.get("name"): arg.get("value") for arg in include.findall("arg")}
        assert values["name"] == f"uav_{number}"
        own = f"param/search/uav_{number}.yaml"
        assert values["params"] == f"$(find lab_behavior)/{own}"
        assert files[own].keep
    assert "launch/stone.launch" not in files


def test_params_of_a_robot(generate: Generate) -> None:
    text = generate(MODEL)["param/uav.yaml"].text
    assert yaml.safe_load(text) == {
        "look": {"wait": 1.5, "name": "it's $(x)", "small": 1e-07, "loud": True},
        "left": {"wait": 0.5, "name": "port", "small": 1e-07, "loud": True},
    }
    assert "  # How long it looks.\n  wait: 1.5\n" in text


def test_params_without_a_value_are_named(generate: Generate) -> None:
    alone = MODEL.partition("/// All of them.")[0].replace(', name = "port"', "")
    text = generate(alone)["param/uav.yaml"].text
    assert "name" not in yaml.safe_load(text)["left"]
    assert "  # name: requires a value of type string\n" in text


def test_params_of_one_robot_say_what_can_stand_there(generate: Generate) -> None:
    text = generate(MODEL)["param/search/uav_1.yaml"].text
    assert yaml.safe_load(text) is None
    shown = text.split("#\n", 1)[1].replace("# ", "").replace("#\n", "")
    assert yaml.safe_load(shown)["look"] == {
        "wait": 1.5,
        "name": "it's $(x)",
        "small": 1e-07,
        "loud": True,
        "introspection": True,
    }


def test_bridge(generate: Generate) -> None:
    text = generate(MODEL)["param/uav.swarmros.cfg"].text
    assert 'source = "found"' in text
    assert text.startswith("# ")
    assert "topic `bare`" in text.splitlines()[0]


def test_test_of_the_machines(generate: Generate) -> None:
    files = generate(MODEL)
    root = etree.fromstring(files["test/machines.test"].text.encode())
    tests = {
        test.get("test-name"): {p.get("name"): p.get("value") for p in test.findall("param")}
        for test in root.findall("test")
    }
    assert tests == {
        "uav_look": {"machine": "look", "wait": "1.5", "name": "0"},
        "uav_left": {"machine": "look", "wait": "0.5", "name": "port"},
    }
    assert files["test/test_machine.py"].executable
    assert "add_rostest(test/machines.test)" in files["CMakeLists.txt"].text


def test_simulation(generate: Generate) -> None:
    assert "launch/search_simulation.launch" not in generate(MODEL)
    files = generate(MODEL, simulation="true")
    root = _launch(files, "search_simulation")
    assert _args(root)["world"] == "$(find lab_behavior)/world/field.world"
    included = [include.get("file") for include in root.findall("include")]
    assert included == [
        "$(find gazebo_ros)/launch/empty_world.launch",
        "$(find lab_behavior)/launch/search.launch",
    ]
    passed = [arg.get("name") for arg in root.findall("include")[1].findall("arg")]
    assert passed == ["uav_count", "introspection", "bridge"]
    assert files["world/field.world"].keep
    assert "  world\n" in files["CMakeLists.txt"].text
    assert "gazebo_ros" in files["package.xml"].text


def test_the_world_has_what_is_in_the_environment(generate: Generate) -> None:
    assert "wall_1" not in generate(MODEL, simulation="true")["world/field.world"].text
    item = "environment Field { wall : (0 m, 0 m) -> (3 m, 4 m); "
    files = generate(MODEL.replace("environment Field {", item), simulation="true")
    root = etree.fromstring(files["world/field.world"].text.encode())

    assert root.get("version") == "1.6"
    assert root.find("world").get("name") == "search"
    (box,) = root.findall("world/model[@name='wall_1']/link/collision/geometry/box/size")
    assert box.text == "5 0.1 3"


def test_readme(generate: Generate) -> None:
    text = generate(MODEL)["README.md"].text
    assert "| `~wait` | `duration` |" in text
    assert "| `found` | `cpswarm_msgs/Note` |" in text
    assert "| `roslaunch lab_behavior search.launch` | swarm `Search`" in text
    assert "| `param/search/*.yaml` |" in text


def test_readme_names_packages_of_others(generate: Generate) -> None:
    model = """
package p
message known_msgs/Note { stamp : time, at : geometry_msgs/Point }
message part_msgs/Note { head : part_msgs/Head }
event Known : known_msgs/Note
event Part : part_msgs/Note
event Unknown : unknown_msgs/Note
statemachine M { initial A; state A { on Known, Part, Unknown -> B }  final B }
"""
    needs = "packages with its interfaces: `known_msgs`, `part_msgs`, `unknown_msgs`."
    text = generate(model)["README.md"].text
    assert needs in text
    assert "option `smach.interfaces=known_msgs` of swarmc" in text
    text = generate(model, interfaces="known_msgs")["README.md"].text
    assert needs.replace("`known_msgs`, ", "") in text
    assert "smach.interfaces" not in text


def test_machines_without_members_have_no_launch_files(generate: Generate) -> None:
    files = generate("package p\nstatemachine M { initial A; state A { after 1 s -> B }  final B }")
    assert not [path for path in files if path.startswith(("launch/", "param/", "test/"))]
    assert "rostest" not in files["CMakeLists.txt"].text + files["package.xml"].text


def test_more_robots_than_one_launch_file_starts(generate: Generate) -> None:
    files = generate(MODEL.replace("Uav[2..3]", "Uav[500]"))
    assert len(_launch(files, "search").findall("include")) == 100
