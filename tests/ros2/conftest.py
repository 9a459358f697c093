"""Generated packages of ROS 2: their text, and nodes of theirs that run."""

from __future__ import annotations

import functools
import importlib.util
import json
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.naming import snake_case
from swarmdsl.cli import run
from swarmdsl.codegen.api import OutputFile
from swarmdsl.codegen.options import parse_options
from swarmdsl.codegen.registry import load
from swarmdsl.driver import pipeline
from swarmdsl.ir import System
from swarmdsl.syntax.types import DURATION

from .domains import free_domain
from .installed import installed

HERE = Path(__file__).parent


def load_module(name: str, folder: Path = HERE) -> ModuleType:
    """A module beside this file, or in another folder."""
    key = f"{folder.name}_{name}"
    if key in sys.modules:
        return sys.modules[key]
    spec = importlib.util.spec_from_file_location(key, folder / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[key] = module
    spec.loader.exec_module(module)
    return module


def emit(
    system: System, target: str = "ros2", **options: str
) -> tuple[list[OutputFile], Diagnostics]:
    """Generate from a system; return the files and the diagnostics."""
    generator = load(target)
    report = Diagnostics()
    chosen = parse_options(generator, options, report)
    files = [] if report.has_errors else list(generator.emit(system, chosen, report))
    return files, report


@pytest.fixture
def generate(compiled: Callable[[str], System]) -> Callable[..., dict[str, OutputFile]]:
    """Generate from the text of a model; the files by path."""

    def generate(text: str, **options: str) -> dict[str, OutputFile]:
        files, report = emit(compiled(text), **options)
        assert not list(report)
        return {file.path: file for file in files}

    return generate


@pytest.fixture
def reported(compiled: Callable[[str], System]) -> Callable[..., list[tuple[str, str, str]]]:
    """Diagnostics of a model: name, message, and the text of the primary span."""

    def reported(text: str, **options: str) -> list[tuple[str, str, str]]:
        _, report = emit(compiled(text), **options)
        return [
            (found.name, found.message, found.primary.span.text if found.primary else "")
            for found in report
        ]

    return reported


@pytest.fixture(scope="session")
def ros_folder() -> Path:
    """The environment with ROS 2, which `make test-ros2` makes."""
    folder = installed()
    assert load_module("environment").ready(folder), f"{folder} is not of today"
    return folder


@pytest.fixture(scope="session")
def packages(ros_folder: Path, tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """The packages with the behaviours of all models, as they are generated."""
    environment = load_module("environment")
    folder = tmp_path_factory.mktemp("behaviors")
    return [write_package(model, folder) for model in environment.MODELS]


def write_package(model: Path, folder: Path, **options: str) -> Path:
    """Generate from a model; the folder of the package with the behaviour."""
    files, report = emit(_system(model), **options)
    assert not report.has_errors
    for file in files:
        path = folder / file.path
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(file.text, encoding="utf-8")
    return folder / files[0].path.partition("/")[0]


@pytest.fixture
def variant(tmp_path: Path) -> Callable[..., Path]:
    """Generate from a model with options; the folder of the package."""
    root = HERE.parents[1]
    return lambda model, **options: write_package(root / model, tmp_path / "variant", **options)


@pytest.fixture
def ros(ros_folder: Path, packages: list[Path], tmp_path: Path) -> Iterator[Any]:
    """Processes of ROS in a domain of their own."""
    harness = load_module("harness")
    with free_domain() as domain:
        made = harness.Ros(ros_folder, packages, domain, tmp_path)
        yield made
        made.close()
    for number, node in enumerate(made.nodes):
        # A monitor has the lines of others in its trace.
        if node.trace and not node.module.endswith("_monitor"):
            check_trace(node, tmp_path / f"replay_{number}.toml")


def check_trace(node: Any, scenario: Path) -> None:
    """Replay the trace of a node on its machine in the model; both must agree."""
    environment = load_module("environment")
    (model,) = [m for m in environment.MODELS if f"{_system(m).name}_behavior" == node.package]
    # What targets `yasmin` and `smach` call it.
    module = node.module.removesuffix("_fsm").removesuffix("_smach")
    (machine,) = [m for m in _system(model).machines if snake_case(m.name) == module]
    names = {param.name: param.type for param in machine.params}
    lines = ["[params]"]
    for name, value in node.parameters.items():
        if name in names:
            text = f"{value} s" if names[name] == DURATION else value
            lines.append(f"{name} = {json.dumps(text)}")
    scenario.write_text("\n".join(lines), encoding="utf-8")
    # The last line may be half written where the node was killed.
    trace = scenario.with_suffix(".jsonl")
    trace.write_text("".join(f"{json.dumps(each)}\n" for each in node.trace), encoding="utf-8")
    words = ["simulate", str(model), "--machine", machine.name, "--scenario", str(scenario)]
    assert run([*words, "--no-properties", "--replay", str(trace)]) == 0, node.log


@functools.cache
def _system(model: Path) -> System:
    system = pipeline.check([model]).system
    assert system is not None
    return system
