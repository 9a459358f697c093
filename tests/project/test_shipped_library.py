"""The shipped library: correct, buildable, and consistent with the ROS packages."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest
import yaml

from swarmdsl import ir
from swarmdsl.base import resources
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.cli import run
from swarmdsl.codegen.emit import Request
from swarmdsl.codegen.shared.constants import evaluate
from swarmdsl.driver import pipeline
from swarmdsl.project.loader import load
from swarmdsl.project.rosidl.interface_file import parse_interface
from swarmdsl.syntax.ast import ActionType, Field, MessageType, ServiceType

from . import catalogue

ROOT = Path(__file__).resolve().parents[2]
CORPUS = Path(os.environ.get("SWARMDSL_CORPUS", ROOT.parent / "shared" / "corpus"))
VALUES = {"string": '"a"', "bool": "true"}
needs_corpus = pytest.mark.skipif(not CORPUS.is_dir(), reason=f"no files of CPSwarm in {CORPUS}")


@pytest.mark.parametrize("name", catalogue.PACKAGES)
def test_there_are_no_mistakes(name: str, capsys) -> None:
    library = str(resources.library() / name)

    assert run(["check", library, "--deny", "warnings"]) == 0
    assert run(["fmt", library, "--check"]) == 0
    assert capsys.readouterr().out == ""


OF_CPSWARM = [name for name in catalogue.PACKAGES if name.startswith("cpswarm")]
BUILDS = [
    *(
        (name, target)
        for name in OF_CPSWARM
        for target in ("smach", "ros2", "adf", "scxml", "swarmros")
    ),
    *((name, "ros2") for name in catalogue.PACKAGES if name not in OF_CPSWARM),
]


@pytest.mark.parametrize(("name", "target"), BUILDS)
def test_all_of_it_can_be_built(name: str, target: str, tmp_path: Path) -> None:
    """Build a model that calls all functions and extends or reuses all other declarations."""
    system = catalogue.systems()[name]
    path = tmp_path / "everything.swarm"
    path.write_text("\n".join(_everything(name, system)), encoding="utf-8")
    request = Request(target, {"profile": "portable"} if target == "scxml" else {})
    result = pipeline.build([path], [request], tmp_path / "out")
    made = [each for each in (tmp_path / "out" / target).rglob("*") if each.is_file()]
    text = "\n".join(each.read_text(encoding="utf-8") for each in made)

    assert [found.message for found in result.report] == []
    if target != "swarmros":
        for function in _called(system):
            assert function.communication.name in text, function.name


def test_skeletons_of_all_functions_and_nodes(tmp_path: Path) -> None:
    """Compile the library itself: in other projects its functions get no skeletons."""
    place = resources.library() / "cpswarm"
    result = pipeline.build([place], [Request("skeleton")], tmp_path)
    made = {path.parent.name for path in tmp_path.rglob("package.xml")}

    assert [found.message for found in result.report] == []
    assert {each.name for each in _called(catalogue.systems()["cpswarm"])} <= made


def _everything(name: str, system: ir.System) -> Iterator[str]:
    yield f"package everything\nimport {name}.*\nendless statemachine Main {{\n  initial S0"
    functions = _called(system)
    for number, function in enumerate(functions):
        fields = _taken(system, function)
        types = [str(field.type) for field in fields]
        if all(
            type_ in VALUES or type_.strip("uint0123456789") in ("", "float") for type_ in types
        ):
            values = ", ".join(f"{f.name} = {VALUES.get(str(f.type), 1)}" for f in fields)
        else:
            values = f"by make_{function.name}"
        yield f"  state S{number} {{"
        yield f"    do {function.name}({values})" if values else f"    do {function.name}"
        yield f"    on succeeded, aborted -> S{number + 1}\n  }}"
    last = f"S{len(functions)}"
    if name == "cpswarm":
        yield f"  state {last} = SearchOnce {{ on done -> S0 }}\n}}"
        yield "member Flying extends Uav { behavior Main }"
        yield "member Driving extends Carrier { behavior GoToTargets }"
        yield "member Watching extends Drone { behavior SearchAndTrack }"
        yield "swarm All {\n  uav : Flying\n  ugv : Driving\n  drone : Watching"
        yield "  environment StorageHall\n  fitness RescueTime\n}"
    elif name == "cpswarm_uint32":
        yield f"  state {last} {{ on MissionStart -> S0 }}\n}}\nmember Robot {{ behavior Main }}"
    else:
        yield f"  state {last} {{"
        yield from (f"    on {each.name} -> S0" for each in system.events)
        yield "    after 1 s -> S0\n  }\n}\nmember Robot { behavior Main }"
        yield from (
            f"member My{m.name} extends {m.name} {{ behavior Main }}" for m in system.members
        )


def _called(system: ir.System) -> list[ir.Function]:
    """Return the functions that are no operations of components."""
    operations = {each for component in system.components for each in component.operations}
    return [each for each in system.functions if each.name not in operations]


def _taken(system: ir.System, function: ir.Function) -> tuple[ir.Field, ...]:
    match system.known_interface(function.communication.type):
        case ir.Action(goal=goal):
            return goal
        case ir.Service(request=request):
            return request
    return ()


def test_each_function_is_documented() -> None:
    for system in catalogue.systems().values():
        items = (*system.functions, *system.events, *system.machines, *system.members)
        assert [each.name for each in items if not each.doc and "." not in each.name] == []
        params = [each for owner in _called(system) for each in owner.params]
        assert [each.name for each in params if not each.doc] == []


def test_the_page_of_the_library(bless: bool) -> None:
    page = catalogue.page()
    if bless:
        catalogue.PLACE.write_text(page, encoding="utf-8")

    assert catalogue.PLACE.read_text(encoding="utf-8") == page, "make bless"


# ---- an interface that the project describes too


def test_interface_files_of_ros_win(swarmc, project, tmp_path) -> None:
    folder = tmp_path / "cpswarm_msgs" / "action"
    folder.mkdir(parents=True)
    (folder / "Coverage.action").write_text("float64 depth\n---\nbool found\n---\n")
    model = """import cpswarm.functions.*
import ros "{folder}"
statemachine Dive {{
  var found : bool
  initial Look
  state Look {{
    do uav_coverage(depth = 2.0) gives (found => found)
    on succeeded [found] -> Done
    on succeeded, aborted -> Done
  }}
  final Done
}}
"""
    project({"main.swarm": model.format(folder=folder.parent.as_posix())})
    ran = swarmc("check", "main.swarm")

    assert (ran.code, ran.out) == (0, "")


def test_interfaces_of_a_model_win(swarmc, project) -> None:
    model = """import cpswarm.functions.*
action cpswarm_msgs/Coverage { goal { depth : float64 } }
statemachine Dive {
  initial Look
  state Look {
    do uav_coverage(depth = 2.0)
    on succeeded, aborted -> Done
  }
  final Done
}
"""
    root = project({"main.swarm": model})
    assert (swarmc("check", "main.swarm").out) == ""
    assert swarmc("build", "main.swarm", "-t", "adf").code == 0
    adf = "".join(each.read_text() for each in (root / "out").rglob("*.json"))
    assert "depth" in adf
    assert "altitude" not in adf


# ---- the ROS packages


@needs_corpus
def test_interfaces_are_those_of_the_ros_packages() -> None:
    compared = set()
    for _, shipped in load([resources.library() / "cpswarm"], Diagnostics()).declarations():
        if not isinstance(shipped, (MessageType, ServiceType, ActionType)):
            continue
        package, name = str(shipped.name).split("/")
        kinds = {MessageType: "msg", ServiceType: "srv", ActionType: "action"}
        kind = kinds[type(shipped)]
        path = CORPUS / "interfaces" / package / kind / f"{name}.{kind}"
        if not path.parents[1].is_dir():
            continue
        source = Source(str(path), path.read_text(encoding="utf-8"), path)
        real = parse_interface(source, package, name, kind, Diagnostics()).declaration
        assert _outline(shipped) == _outline(real), shipped.name
        compared.add(path)

    there = {path for path in (CORPUS / "interfaces").rglob("*") if path.is_file()}
    assert {path.stem for path in there - compared} == {
        *("ExampleComplexMessage", "ExampleComplexSubmessage", "ExampleEvent")
    }


def _outline(node: object) -> object:
    """Return the parts of an interface with their fields as plain data."""
    if isinstance(node, list):
        return [_outline(one) for one in node]
    if isinstance(node, Field):
        return (str(node.name), node.type.name, node.type.bound or "", node.type.array or "")
    parts = ("fields", "request", "response", "goal", "result", "feedback")
    return {part: _outline(getattr(node, part)) for part in parts if hasattr(node, part)}


# Where the parameters of a ROS package are that has not exactly one function of its name; those of
# the folders that others load with their own are in front.
SEARCHING = [f"uav_{kind}_coverage" for kind in ("spiral", "circular", "random", "systematic")]
OWNERS: Mapping[str, list[str]] = {
    "return": ["return_home"],
    "swarm_behaviors_flocking": ["uav_flocking_coverage", "uav_flocking_tracking"],
    "swarm_behaviors_position": [*SEARCHING, "uav_simple_tracking", "ugv_coverage"],
    "swarm_behaviors_velocity": ["uav_flocking_coverage", "uav_flocking_tracking"],
    "task_allocation": ["task_allocation_auction", "task_allocation_bid"],
    "uav_coverage": [*SEARCHING, "uav_flocking_coverage", "uav_coverage", "uav_local_coverage"],
    "uav_tracking": ["uav_simple_tracking", "uav_flocking_tracking", "uav_tracking"],
    "ugv_random_walk": ["ugv_coverage"],
}
# Params of the ROS navigation stack, not of the node of the package.
OF_NAVIGATION = {"common_costmap", "global_costmap", "local_costmap", "navigation"}


@needs_corpus
def test_params_are_those_of_the_ros_packages() -> None:
    explained: set[tuple[str, str]] = set()
    for folder in sorted((CORPUS / "params").iterdir()):
        names = OWNERS.get(folder.name, [folder.name])
        owners = [_owner(name) for name in names]
        for file in folder.glob("*.yaml"):
            if file.stem in OF_NAVIGATION:
                continue
            for name, value in _flat(yaml.safe_load(file.read_text(encoding="utf-8"))):
                having = [each for each in owners if name in each]
                assert having, f"{file.name}: {name}"
                for each in having:
                    assert _value(each[name]) == value, f"{file.name}: {name}"
                explained.update((owner, name) for owner in names)

    # Defaults in the library come from such files.
    ours = {
        (owner.name, param.name)
        for owner in (
            *_called(catalogue.systems()["cpswarm"]),
            *catalogue.systems()["cpswarm"].components,
        )
        for param in owner.params
        if param.default is not None and owner.name not in HARDWARE
    }
    known = {(_spelt(owner), name) for owner, name in explained}
    assert {each for each in ours if (_spelt(each[0]), each[1]) not in known} == OWN


# Values that come from elsewhere: a file that the package of the area has beside its model, and
# what the pages of devices say.
OWN = {("AreaProvider", name) for name in ("loop_rate", "queue_size", "resolution")}
HARDWARE = {"Camera", "CmosOv5640", "RangeSensor", "Sonar", "Gp2d12", "CommunicationInterface"}


def _owner(package: str) -> dict[str, ir.Param]:
    """Return the params of the function or component that is the node of a package."""
    for each in (
        *catalogue.systems()["cpswarm"].functions,
        *catalogue.systems()["cpswarm"].components,
    ):
        if _spelt(each.name) == _spelt(package):
            return {param.name: param for param in each.params}
    raise AssertionError(package)


def _spelt(name: str) -> str:
    return name.replace("_", "").lower()


def _flat(values: Mapping[str, object], prefix: str = "") -> Iterator[tuple[str, object]]:
    for name, value in values.items():
        if isinstance(value, dict):
            yield from _flat(value, f"{prefix}{name}_")
        else:
            # A model has no lists as values.
            yield f"{prefix}{name}", None if isinstance(value, list) else value


def _value(param: ir.Param) -> object:
    """Return the default of a param, durations in seconds as in ROS."""
    value = evaluate(param.default, {}) if param.default is not None else None
    if str(param.type) == "duration" and isinstance(value, (int, float)):
        return float(value)
    return value
