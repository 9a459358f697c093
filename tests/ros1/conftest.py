"""Generated packages as nodes in a graph of ROS 1, with real servers around them.

They run on the real smach where there is one, as in tests/smach, and on the stand-in elsewhere.
"""

from __future__ import annotations

import importlib.util
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from swarmdsl.codegen.bundled.smach.package import used_types

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import chosen_machines
from swarmdsl.codegen.features import used_features
from swarmdsl.codegen.options import parse_options
from swarmdsl.codegen.registry import load
from swarmdsl.codegen.ros.interface_files import definition, interface_path
from swarmdsl.codegen.shared import envelopes_of
from swarmdsl.driver import pipeline
from swarmdsl.ir import System

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
STAND_IN = HERE.parent / "smach" / "stand_in"
# Interfaces that models name and may leave to others to describe.
_LIBRARY = ROOT / "src" / "swarmdsl" / "project" / "library" / "cpswarm"
_DEBIAN = Path("/usr/lib/python3/dist-packages")


def _load(name: str, folder: Path = HERE) -> ModuleType:
    spec = importlib.util.spec_from_file_location(f"ros1_{name}", folder / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


environment_module = _load("environment", HERE.parent / "smach")
graph_module = _load("graph")
world_module = _load("world")


@pytest.fixture(scope="session")
def graph() -> Iterator[Any]:
    """A master on a port of its own."""
    why = graph_module.missing()
    if why is not None:
        pytest.skip(why)
    made = graph_module.Graph()
    yield made
    made.stop()


@pytest.fixture(scope="session")
def smach_path() -> tuple[Path, ...]:
    """The folders of the smach to run on: the real one where there is one, else the stand-in."""
    python = graph_module.PYTHON
    if "SWARMDSL_SMACH_PATH" not in os.environ and python.exists():
        command = [python, "-c", "import smach, smach_ros"]
        if subprocess.run(command, stderr=subprocess.DEVNULL, check=False).returncode == 0:
            return ()
    found: tuple[Path, ...] = environment_module.installed(STAND_IN)
    return found or (STAND_IN,)


class Workspace:
    """Generated packages, and the Python of all interfaces that are named in them."""

    def __init__(self, folder: Path, smach: Sequence[Path]) -> None:
        self.folder = folder
        self.smach = smach
        self._made: dict[str, tuple[System, Path, list[Path]]] = {}

    def example(self, folder: str) -> tuple[System, Path, list[Path]]:
        """The system of an example, its package of the behaviour, and folders to import from."""
        if folder not in self._made:
            paths = sorted((ROOT / "examples" / folder).glob("*.swarm"))
            self._made[folder] = self._make(paths, folder)
        return self._made[folder]

    def can_make(self, folder: str) -> bool:
        """Return True if the target can express an example."""
        result = pipeline.check(sorted((ROOT / "examples" / folder).glob("*.swarm")))
        assert result.system is not None
        supported = load("smach").supports
        return all(feature in supported for feature, _ in used_features(result.system))

    def model(self, text: str) -> tuple[System, Path, list[Path]]:
        """The same of the text of a model."""
        if text not in self._made:
            folder = self.folder / f"model{len(self._made)}"
            folder.mkdir()
            path = folder / "model.swarm"
            path.write_text(text, encoding="utf-8")
            self._made[text] = self._make([path], folder.name)
        return self._made[text]

    def _make(self, paths: list[Path], name: str) -> tuple[System, Path, list[Path]]:
        result = pipeline.check(paths)
        assert result.system is not None, [found.message for found in result.report]
        generator = load("smach")
        report = Diagnostics()
        options = parse_options(generator, {}, report)
        files = list(generator.emit(result.system, options, report))
        assert not list(report)
        source = self.folder / name / "src"
        for file in files:
            path = source / file.path
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(file.text, encoding="utf-8")
            path.chmod(0o755 if file.executable else 0o644)
        package = source / files[0].path.partition("/")[0]
        interfaces = self._interfaces(result.system, self.folder / name / "interfaces", source)
        return result.system, package, [package / "src", interfaces, *self.smach]

    def _interfaces(self, system: System, folder: Path, source: Path) -> Path:
        """Make what is generated, what the model describes, and what the library does."""
        library = pipeline.check([_LIBRARY]).system
        assert library is not None
        for interface in (*library.interfaces, *system.interfaces, *envelopes_of(system).values()):
            if not (_DEBIAN / interface.type.package).exists():
                path = folder / interface.type.package / interface_path(interface)
                path.parent.mkdir(parents=True, exist_ok=True)
                text = definition(interface, 1, lambda construct, at: pytest.fail(construct))
                path.write_text(text, encoding="utf-8")
        for type_, kind in used_types(system, chosen_machines(system)):
            path = folder / type_.package / kind / f"{type_.name}.{kind}"
            if not path.exists() and not (_DEBIAN / type_.package).exists():
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text("---\n" * {"msg": 0, "srv": 1, "action": 2}[kind])
        for smach in self.smach:
            described = smach.parents[1] / "smach_msgs"
            if described.exists():
                shutil.copytree(described, folder / "smach_msgs", dirs_exist_ok=True)
        made = folder.parent / "python"
        command = [graph_module.PYTHON, HERE / "messages.py", folder, made]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        assert run.returncode == 0, run.stderr
        return made


@pytest.fixture(scope="session")
def workspace(smach_path: tuple[Path, ...], tmp_path_factory: pytest.TempPathFactory) -> Workspace:
    """Workspace for generated packages."""
    return Workspace(tmp_path_factory.mktemp("ros1"), smach_path)


@pytest.fixture
def world(
    graph: Any, workspace: Workspace, request: pytest.FixtureRequest
) -> Iterator[Callable[..., Any]]:
    """Make the surroundings of a node: of `example="folder"`, or of the text of a model."""
    made: list[Any] = []

    def world(text: str = "", example: str = "") -> Any:
        found = workspace.example(example) if example else workspace.model(text)
        name = re.sub(r"\W+", "_", f"{request.node.name}_{len(made)}").lower()
        made.append(world_module.World(graph, *found, name, made))
        return made[-1]

    yield world
    for each in made:
        each.stop()
