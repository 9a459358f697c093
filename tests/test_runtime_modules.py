"""Python in generated packages: templates have logic, everything else is ordinary source."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest
from swarmdsl.codegen.bundled.runtime_source import runtime_source
from swarmdsl.codegen.bundled.smach.ros2.library import SMACH
from swarmdsl.codegen.bundled.yasmin.library import YASMIN

from swarmdsl import ir
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import replace
from swarmdsl.codegen.emit import Request, emit
from swarmdsl.driver import pipeline

ROOT = Path(__file__).resolve().parents[1]
GENERATORS = ROOT / "generators"
RUNTIMES = sorted(GENERATORS.rglob("runtime"))
STAND_IN = "Stand-in for"

# The templates of Python modules; everything that needs no logic is in a folder `runtime`.
PYTHON_TEMPLATES = {
    "ros2/templates/package/launch/robot.launch.py.j2",
    "ros2/templates/package/launch/swarm.launch.py.j2",
    "ros2/templates/package/package/callbacks.py.j2",
    "ros2/templates/package/package/machine.py.j2",
    "ros2/templates/package/package/monitor.py.j2",
    "ros2/templates/package/package/node.py.j2",
    "ros2/templates/package/package/px4_offboard.py.j2",
    "ros2/templates/package/setup.py.j2",
    "ros2/templates/package/test/test_copyright.py.j2",
    "ros2/templates/package/test/test_machines.py.j2",
    "skeleton/templates/ros1_python/base.py.j2",
    "skeleton/templates/ros1_python/implementation.py.j2",
    "skeleton/templates/ros1_python/test.py.j2",
    "skeleton/templates/ros2/bringup.launch.py.j2",
    "skeleton/templates/ros2/launch.py.j2",
    "skeleton/templates/ros2_python/base.py.j2",
    "skeleton/templates/ros2_python/implementation.py.j2",
    "skeleton/templates/ros2_python/node.py.j2",
    "skeleton/templates/ros2_python/setup.py.j2",
    "skeleton/templates/ros2_python/test.py.j2",
    "smach/templates/package/src/package/callbacks.py.j2",
    "smach/templates/package/src/package/events.py.j2",
    "smach/templates/package/src/package/machine.py.j2",
    "smach/templates/ros2/machine.py.j2",
    "smach/templates/ros2/test_smach.py.j2",
    "yasmin/templates/package/fsm.py.j2",
    "yasmin/templates/test/test_yasmin.py.j2",
}
# A few lines of setuptools, or a docstring: all that they say is a value of the model.
WITHOUT_STATEMENTS = {
    "skeleton/templates/ros1_python/setup.py.j2",
    "skeleton/templates/ros2_python/__init__.py.j2",
    "smach/templates/package/setup.py.j2",
}


def test_python_templates_have_logic() -> None:
    found = {
        path.relative_to(GENERATORS).as_posix(): path.read_text(encoding="utf-8")
        for path in GENERATORS.rglob("*.py.j2")
    }
    assert found.keys() == PYTHON_TEMPLATES | WITHOUT_STATEMENTS
    assert {name for name, text in found.items() if "{%" not in text} == WITHOUT_STATEMENTS
    assert all(found[name].count("\n") < 10 for name in WITHOUT_STATEMENTS)


def test_templates_print_more_than_a_header() -> None:
    for path in GENERATORS.rglob("*.j2"):
        text = re.sub(r"\{\{ [\w.]*header \}\}", "", path.read_text(encoding="utf-8"))
        assert "{{" in text or "{%" in text, path


@pytest.mark.parametrize(
    ("target", "options", "folders"),
    [
        ("ros2", {"monitors": "true", "composed": "true"}, ["ros2"]),
        ("smach", {}, ["smach"]),
        ("smach", {"ros": "2", "monitors": "true"}, ["ros2", "ros2_outcomes", "smach/ros2"]),
        ("yasmin", {"monitors": "true"}, ["ros2", "ros2_outcomes", "yasmin"]),
    ],
)
def test_modules_are_copied_with_a_header(
    target: str, options: dict[str, str], folders: list[str]
) -> None:
    system = pipeline.check([ROOT / "examples/search_and_rescue"]).system
    assert system is not None
    dies = ir.Contract("Dies", function="uav_mavros_land")  # for the modules of watchdogs
    members = tuple(replace(each, contracts=(dies,)) for each in system.members)
    climb = ir.Named("px4_offboard_msgs", "TakeOff")  # for those of offboard control
    functions = tuple(
        replace(each, communication=replace(each.communication, type=climb))
        if each.name == "uav_mavros_takeoff"
        else each
        for each in system.functions
    )
    interfaces = (*system.interfaces, ir.Action(climb, (), (), (), True))
    system = replace(system, members=members, functions=functions, interfaces=interfaces)
    files = emit(system, [Request(target, options)], Diagnostics())[target]
    texts = {file.path.partition("sar_behavior/")[2]: file.text for file in files}
    texts = {path.replace("src/", "").replace("sar_behavior/", ""): t for path, t in texts.items()}
    for folder in folders:
        runtime = GENERATORS / folder / "runtime"
        for path in runtime.rglob("*.py"):
            source = path.read_text(encoding="utf-8")
            if (ast.get_docstring(ast.parse(source)) or "").startswith(STAND_IN):
                continue
            if path.name == "container.py" and target != "ros2":
                continue  # it has no option `composed`
            made = texts[path.relative_to(runtime).as_posix()].splitlines()
            header = next(line for line in made if line.startswith("# Generated by swarmc"))
            made.remove(header)
            differ = [new for new, old in zip(made, source.splitlines(), strict=True) if new != old]
            assert all(re.match(r"_?[A-Z_]+ = ", line) for line in differ), (path, differ)


def test_constants_are_replaced(tmp_path: Path) -> None:
    path = tmp_path / "module.py"
    path.write_text("#!/usr/bin/env python3\n_A = 1\nB_A = 2\n", encoding="utf-8")
    made = runtime_source(path, "# Generated.", _A="x")
    assert made == "#!/usr/bin/env python3\n# Generated.\n_A = 'x'\nB_A = 2\n"
    with pytest.raises(AssertionError, match="0 constants C"):
        runtime_source(path, "", C=1)


@pytest.mark.parametrize(
    ("library", "folder"), [(SMACH, "smach/ros2/runtime"), (YASMIN, "yasmin/runtime")]
)
def test_libraries_agree_with_their_modules(library: object, folder: str) -> None:
    constants = {}
    for module in ("library", "states"):
        tree = ast.parse((GENERATORS / folder / f"{module}.py").read_text(encoding="utf-8"))
        for node in tree.body:
            if isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant):
                constants[ast.unparse(node.targets[0])] = node.value.value
    assert constants == {"NAME": library.name, "STOPPED": library.stopped}
