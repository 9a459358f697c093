"""Skeletons of one model in all their variants, and a graph of ROS 1 to run them in."""

from __future__ import annotations

import importlib.util
import json
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import OutputFile
from swarmdsl.codegen.options import parse_options
from swarmdsl.codegen.registry import load
from swarmdsl.driver import pipeline

HERE = Path(__file__).parent
MODEL = HERE / "model.swarm"
STAND_IN = HERE.parent / "smach" / "stand_in"


def load_module(name: str, path: Path) -> ModuleType:
    """A module that lies somewhere in the tests."""
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


graph_module = load_module("skeleton_graph", HERE.parent / "ros1" / "graph.py")

Emit = Callable[..., tuple[dict[str, OutputFile], list[Any]]]


@pytest.fixture(scope="session")
def emit(tmp_path_factory: pytest.TempPathFactory) -> Emit:
    """Generate from a model, a string or a file; return files and diagnostics."""

    def emit(model: str | Path = MODEL, **options: str) -> tuple[dict[str, OutputFile], list[Any]]:
        if isinstance(model, str):
            path = tmp_path_factory.mktemp("model") / "model.swarm"
            path.write_text(model, encoding="utf-8")
            model = path
        result = pipeline.check([model])
        assert result.system is not None, [found.message for found in result.report]
        generator = load("skeleton")
        report = Diagnostics()
        parsed = parse_options(generator, options, report)
        files = list(generator.emit(result.system, parsed, report))
        return {file.path: file for file in files}, list(report)

    return emit


@pytest.fixture(scope="session")
def write(emit: Emit) -> Callable[..., dict[str, OutputFile]]:
    """Write what the generator makes below a folder; no complaints."""

    def write(folder: Path, model: Path = MODEL, **options: str) -> dict[str, OutputFile]:
        files, complaints = emit(model, **options)
        assert complaints == []
        for file in files.values():
            path = folder / file.path
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(file.text, encoding="utf-8")
            path.chmod(0o755 if file.executable else 0o644)
        return files

    return write


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
def messages(
    graph: Any, write: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory
) -> Path:
    """The Python of the interfaces of the model."""
    folder = tmp_path_factory.mktemp("interfaces")
    write(folder / "src")
    (folder / "packages").mkdir()
    shutil.copytree(folder / "src" / "demo", folder / "packages" / "demo")
    script = HERE.parent / "ros1" / "messages.py"
    command = [graph_module.PYTHON, script, folder / "packages", folder / "python"]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    return folder / "python"


@pytest.fixture
def start(graph: Any, messages: Path, request: pytest.FixtureRequest) -> Iterator[Any]:
    """Start nodes by their names in a namespace of their own, and ask them from a client."""
    running: dict[str, Any] = {}
    namespace = f"/{request.node.name.replace('[', '_').replace(']', '').replace('-', '_')}"

    def start(commands: dict[str, list[str]], folders: list[Path]) -> Callable[..., Any]:
        graph.set_param(f"{namespace}/climb/frame", "map")
        environment = graph.environment([*folders, messages], ROS_NAMESPACE=namespace)
        for name, command in commands.items():
            output = f"{namespace[1:]}_{name}"
            running[name] = graph.start(command, output=output, env=environment)

        def ask(*words: str) -> Any:
            run = subprocess.run(
                [graph.python, HERE / "client.py", *words],
                env=environment, capture_output=True, text=True, timeout=100, check=False,
            )  # fmt: skip
            printed = "\n".join(graph.printed(f"{namespace[1:]}_{name}") for name in commands)
            assert run.returncode == 0, f"{run.stderr}\n{printed}"
            return json.loads(run.stdout.splitlines()[-1])

        return ask

    start.running = running  # type: ignore[attr-defined]
    yield start
    for process in running.values():
        graph.end(process)
