"""Strings and comments as the programs read them that the generated files are for."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest
from lxml import etree

from ..ros2.installed import installed
from .conftest import Make
from .model import DOCS, ENDS, HOSTILE, model

DEBIAN = Path("/usr/bin/python3")


def run_python(python: Path, script: str, given: Any, **more: Any) -> Any:
    """Run a script on JSON; what it puts into `found`."""
    code = f"import json, sys\ngiven = json.load(sys.stdin)\n{script}\nprint(json.dumps(found))"
    ran = subprocess.run(
        [python, "-c", code], input=json.dumps(given), capture_output=True, text=True, **more
    )
    assert ran.returncode == 0, ran.stderr
    return json.loads(ran.stdout.splitlines()[-1])


@pytest.fixture(scope="session")
def ros1() -> Callable[[str, Any], Any]:
    """Run a script with the tools of ROS 1."""
    known = "import genmsg, genpy, roslaunch"
    if not DEBIAN.exists() or subprocess.run([DEBIAN, "-c", known], stderr=-3).returncode:
        pytest.skip("no ROS 1: apt-get install python3-roslaunch python3-rospy")
    return lambda script, given: run_python(DEBIAN, script, given)


@pytest.fixture(scope="session")
def ros2() -> Callable[[str, Any], Any]:
    """Run a script with the tools of ROS 2."""
    folder = installed()
    shell = f'. "{folder}/setup.sh" && exec python "$@"'

    def run(script: str, given: Any) -> Any:
        code = f"import json, sys\ngiven = json.load(sys.stdin)\n{script}\nprint(json.dumps(found))"
        ran = subprocess.run(
            ["bash", "-c", shell, "bash", "-c", code],
            input=json.dumps(given), capture_output=True, text=True,
        )  # fmt: skip
        assert ran.returncode == 0, ran.stderr
        return json.loads(ran.stdout.splitlines()[-1])

    return run


@pytest.fixture
def files(make: Make) -> Callable[..., Mapping[str, str]]:
    """The files of a target with all strings that it takes."""

    def files(target: str, **options: str) -> Mapping[str, str]:
        rejected: set[tuple[str, int]] = set()
        while True:
            made = make(model(HOSTILE, "x", rejected), target, options)
            if made.rejected.keys() <= rejected:
                return made.files
            rejected |= made.rejected.keys()

    return files


def numbered(found: Mapping[str, str]) -> dict[int, str]:
    """Values by the number at the end of their names."""
    matches = ((re.search(r"(?:^|/)[Cpv](\d+)$", name), text) for name, text in found.items())
    return {int(name[1]): text for name, text in matches if name}


def check_same(found: Mapping[int, str], at_least: int) -> None:
    """Expect the hostile strings under their numbers."""
    assert found == {number: HOSTILE[number] for number in found}
    assert len(found) >= at_least


_MESSAGE_1 = """
import genmsg.msg_loader, genpy.generator
context = genmsg.msg_loader.MsgContext.create_default()
spec = genmsg.msg_loader.load_msg_from_string(context, given, "hostile/Found")
code = "\\n".join(genpy.generator.msg_generator(context, spec, {}))
space = {}
exec(code, space)
made = space["Found"]
found = [{each.name: getattr(made, each.name) for each in spec.constants}, made._full_text]
"""


def test_messages_of_ros_1(files: Any, ros1: Any) -> None:
    constants, _ = ros1(_MESSAGE_1, files("smach")["hostile/msg/Found.msg"])
    check_same(numbered(constants), len(HOSTILE) - 20)


def test_comments_of_messages_of_ros_1(make: Make, ros1: Any) -> None:
    text = make(model([], "\n".join([*DOCS, *ENDS])), "smach", {}).files["hostile/msg/Found.msg"]
    assert ros1(_MESSAGE_1, text) == [{}, text]


_MESSAGE_2 = """
import contextlib, io, pathlib, tempfile
from rosidl_adapter.msg import convert_msg_to_idl
from rosidl_generator_py.generate_py_impl import constant_value_to_py
from rosidl_parser.definition import IdlLocator, Message
from rosidl_parser.parser import parse_idl_file
with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
    folder = pathlib.Path(folder)
    (folder / "msg").mkdir()
    (folder / "msg" / "Found.msg").write_text(given, encoding="utf-8")
    convert_msg_to_idl(folder, "hostile", pathlib.Path("msg/Found.msg"), folder)
    read = parse_idl_file(IdlLocator(folder, pathlib.Path("Found.idl")))
    (message,) = read.content.get_elements_of_type(Message)
    found = [
        {
            each.name: eval(constant_value_to_py(each.type, each.value))
            for each in message.constants
        },
        [each.name for each in message.structure.members],
    ]
"""


def test_messages_of_ros_2(files: Any, ros2: Any) -> None:
    constants, _ = ros2(_MESSAGE_2, files("ros2")["hostile/msg/Found.msg"])
    check_same(numbered(constants), len(HOSTILE) - 20)


def test_comments_of_messages_of_ros_2(make: Make, ros2: Any) -> None:
    text = make(model([], "\n".join([*DOCS, *ENDS])), "ros2", {}).files["hostile/msg/Found.msg"]
    assert ros2(_MESSAGE_2, text) == [{}, ["name"]]


_PARAMETERS_2 = """
import os, tempfile
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "OFF"
import rclpy, rclpy.node
with tempfile.NamedTemporaryFile("w", suffix=".yaml", encoding="utf-8") as file:
    file.write(given)
    file.flush()
    rclpy.init(args=["--ros-args", "--params-file", file.name])
    node = rclpy.node.Node("work", automatically_declare_parameters_from_overrides=True)
    found = {name: each.value for name, each in node.get_parameters_by_prefix("").items()}
    rclpy.shutdown()
"""


def test_parameters_of_ros_2(files: Any, ros2: Any) -> None:
    text = files("ros2")["hostile_behavior/config/team/bot.yaml"]
    check_same(numbered(ros2(_PARAMETERS_2, text)), len(HOSTILE))


_LAUNCH = """
import roslaunch.config, roslaunch.xmlloader, tempfile
with tempfile.NamedTemporaryFile("w", suffix=".launch", encoding="utf-8") as file:
    file.write(given)
    file.flush()
    config = roslaunch.config.ROSLaunchConfig()
    roslaunch.xmlloader.XmlLoader().load(file.name, config, verbose=False, argv=[])
found = {name: each.value for name, each in config.params.items()}
"""


def test_launch_files_of_ros_1(files: Any, ros1: Any) -> None:
    found = ros1(_LAUNCH, files("composition")["team/launch/bot.launch"])
    check_same(numbered(found), len(HOSTILE))


@pytest.fixture(scope="session")
def compiler() -> str:
    found = shutil.which("g++")
    if found is None:
        pytest.skip("no C++ compiler: apt-get install g++")
    return found


# Trigraphs are replaced in C++11, and no longer in C++17.
@pytest.mark.parametrize("standard", ["c++11", "c++17"])
@pytest.mark.parametrize("ros", ["1", "2"])
def test_strings_of_cpp(files: Any, compiler: str, standard: str, ros: str, tmp_path: Path) -> None:
    made = files("skeleton", language="cpp", ros=ros)
    header = made[f"go/include/go/go_base.{'h' if ros == '1' else 'hpp'}"]
    literals = dict(re.findall(r"std::string (p\d+) = (.*);", header))
    code = "#include <cstdio>\n#include <string>\nint main() {\n" + "".join(
        f'{{ std::string s({each}); std::printf("%zu\\n", s.size()); '
        "std::fwrite(s.data(), 1, s.size(), stdout); }\n"
        for each in literals.values()
    )
    source, program = tmp_path / "strings.cpp", tmp_path / "strings"
    source.write_text(f"{code}}}\n", encoding="utf-8")
    subprocess.run([compiler, f"-std={standard}", "-w", source, "-o", program], check=True)
    out = subprocess.run([program], capture_output=True, check=True).stdout
    found = []
    while out:
        size, _, out = out.partition(b"\n")
        found.append(out[: int(size)].decode())
        out = out[int(size) :]
    check_same(numbered(dict(zip(literals, found, strict=True))), len(HOSTILE))


@pytest.mark.parametrize("ros", ["1", "2"])
def test_comments_of_cpp(make: Make, compiler: str, ros: str) -> None:
    def code(doc: str) -> str:
        made = make(model(["x"], doc), "skeleton", {"language": "cpp", "ros": ros}).files
        texts = [text for path, text in made.items() if path.endswith((".h", ".hpp", ".cpp"))]
        ran = subprocess.run(
            [compiler, "-std=c++11", "-w", "-E", "-P", "-x", "c++", "-"],
            input=re.sub("^#include.*", "", "\n".join(texts), flags=re.MULTILINE),
            capture_output=True, text=True, check=True,
        )  # fmt: skip
        # Documentation of parameters is a string of the program.
        return re.sub(r'"(?:[^"\\\n]|\\.)*"', '""', ran.stdout)

    for doc in ("\n".join(DOCS), *ENDS):
        assert code(doc) == code("plain"), doc


def test_expressions_of_scxml(files: Any) -> None:
    node = shutil.which("node")
    if node is None:
        pytest.skip("no Node: apt-get install nodejs")
    tree = etree.fromstring(files("scxml", profile="portable")["Work.scxml"].encode())
    constants = {
        each.get("name"): each.get("value")
        for each in tree.iter("{*}constant")
        if re.fullmatch(r"C\d+", each.get("name"))
    }
    variables = {
        each.get("id"): each.get("expr")
        for each in tree.iter("{*}data")
        if re.fullmatch(r"[pv]\d+", each.get("id"))
    }
    for texts in (constants, variables):
        script = (
            'const texts = JSON.parse(require("fs").readFileSync(0, "utf8"));'
            "console.log(JSON.stringify(Object.fromEntries(Object.entries(texts).map("
            '([name, text]) => [name, (0, eval)("(" + text + ")")]))))'
        )
        ran = subprocess.run(
            [node, "-e", script],
            input=json.dumps(texts), capture_output=True, text=True, check=True,
        )  # fmt: skip
        check_same(numbered(json.loads(ran.stdout)), len(HOSTILE))
