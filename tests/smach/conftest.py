"""Generated packages, built and run in this process against a ROS of one process.

The machines run twice: on the stand-in for smach beside this file, and on the real smach where the
system has it, where SWARMDSL_SMACH_PATH names its folders, or where `environment.py` has installed
it.
"""

from __future__ import annotations

import functools
import importlib
import importlib.util
import itertools
import os
import subprocess
import sys
import threading
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
from swarmdsl.ir import System

HERE = Path(__file__).parent
STAND_IN = HERE / "stand_in"


def _load(name: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, HERE / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


environment = _load("environment")
fake_ros = _load("fake_ros")
active = _load("active")


def emit(system: System, **options: str) -> tuple[list[OutputFile], Diagnostics]:
    """Generate from a system; return the files and the diagnostics."""
    generator = load("smach")
    report = Diagnostics()
    chosen = parse_options(generator, options, report)
    files = [] if report.has_errors else list(generator.emit(system, chosen, report))
    return files, report


@pytest.fixture
def generate(compiled: Callable[[str], System]) -> Callable[..., dict[str, OutputFile]]:
    """Generate from the text of a model; the files by path.

    That of the package with the behaviour is left out: `lab_behavior/setup.py` is `setup.py`.
    """

    def generate(text: str, **options: str) -> dict[str, OutputFile]:
        files, report = emit(compiled(text), **options)
        assert not list(report)
        package = files[0].path.partition("/")[0] + "/" if files else ""
        return {file.path.removeprefix(package): file for file in files}

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


@functools.cache
def _real_smach() -> tuple[str, ...]:
    """The folders that the real smach and smach_ros are imported from, those to prefer last."""
    if "SWARMDSL_SMACH_PATH" in os.environ:
        return tuple(map(str, reversed(environment.installed(STAND_IN))))
    code = (
        "import importlib.util, pathlib\n"
        "for name in ('smach', 'smach_ros'):\n"
        "    print(pathlib.Path(importlib.util.find_spec(name).origin).parents[1])"
    )
    python = Path("/usr/bin/python3")
    if python.exists():
        found = subprocess.run([python, "-c", code], capture_output=True, text=True, check=False)
        if found.returncode == 0:
            return tuple(found.stdout.split())
    return tuple(map(str, reversed(environment.installed(STAND_IN))))


@pytest.fixture(params=["stand-in", "real"])
def smach_path(request: pytest.FixtureRequest) -> tuple[str, ...]:
    """The folders of the smach to run on: the stand-in, then the real one where there is one."""
    if request.param == "stand-in":
        return (str(STAND_IN),)
    if not _real_smach():
        pytest.skip("no real SMACH: `python tests/smach/environment.py .smach`")
    return _real_smach()


class Robot:
    """A generated machine and the ROS it lives in."""

    def __init__(self, world: Any, machine: Any) -> None:
        self.world = world
        self.machine = machine
        self.outcome: str | None = None
        self.error: BaseException | None = None
        self._thread = threading.Thread(target=self._run, daemon=True)

    def _run(self) -> None:
        try:
            self.outcome = self.machine.execute()
        except BaseException as error:
            self.error = error

    def start(self) -> None:
        """Run the machine in a thread of its own."""
        self._thread.start()

    def ended(self) -> str | None:
        """The outcome, when the machine has ended."""
        self._thread.join(fake_ros.WAIT)
        if self.error is not None:
            raise self.error
        assert not self._thread.is_alive(), f"the machine still runs: {self.world.log}"
        return self.outcome

    def preempt(self) -> str | None:
        """Preempt the machine, as a shutdown does; return the outcome."""
        self.machine.request_preempt()
        return self.ended()

    def active(self) -> list[str]:
        """The labels of the active states without children, by their path."""
        return list(active.paths(self.machine))

    def wait_in(self, *paths: str) -> None:
        """Wait until exactly these states are active, and those that wait do so."""
        self.world.wait_until(
            lambda: self.active() == sorted(paths) and active.settled(self.machine),
            f"{list(paths)} expected, {self.active()} active",
        )


@pytest.fixture
def start_package(
    smach_path: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> Iterator[Callable[..., Robot]]:
    """Import a generated package and build a machine of it; each time anew."""
    made: list[Robot] = []
    imported = {"smach", "smach_ros"}

    def forget() -> None:
        for name in list(sys.modules):
            if name.partition(".")[0] in imported:
                del sys.modules[name]

    def start_package(folder: Path, module: str, system: System, **params: Any) -> Robot:
        forget()
        package = folder.name
        world = fake_ros.World(system)
        world.params.update(params)
        monkeypatch.syspath_prepend(str(folder / "src"))
        for place in smach_path:
            monkeypatch.syspath_prepend(place)
        for name, fake in world.modules.items():
            monkeypatch.setitem(sys.modules, name, fake)
        imported.add(package)
        generated = importlib.import_module(f"{package}.{module}")
        robot = Robot(world, generated.build())
        made.append(robot)
        return robot

    yield start_package
    for robot in made:
        robot.machine.request_preempt()
    forget()


@pytest.fixture
def build(start_package: Callable[..., Robot], tmp_path: Path) -> Callable[..., Robot]:
    """Generate a system, import what was generated and build a machine.

    The package of the last system is there when another machine of it is built.
    """
    roots = (tmp_path / (f"out{number}" if number else "out") for number in itertools.count())
    last: tuple[System, Path] | None = None

    def build(system: System, module: str, **params: Any) -> Robot:
        nonlocal last
        if last is None or last[0] is not system:
            last = (system, write(system, next(roots)))
        return start_package(last[1], module, system, **params)

    return build


def write(system: System, root: Path) -> Path:
    """Write what is generated of a system below a folder; return the folder of its package."""
    files, report = emit(system)
    assert not list(report)
    for file in files:
        path = root / file.path
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(file.text, encoding="utf-8")
    return root / files[0].path.partition("/")[0]


@pytest.fixture
def robot(build: Callable[..., Robot], compiled: Callable[[str], System]) -> Callable[..., Robot]:
    """Build the machine of the text of a model."""

    def robot(text: str, module: str = "work", **params: Any) -> Robot:
        return build(compiled(text), module, **params)

    return robot


@pytest.fixture
def example(build: Callable[..., Robot], examples: Path) -> Callable[..., Robot]:
    """Build a machine of an example."""

    def example(folder: str, module: str) -> Robot:
        paths = sorted((examples / folder).glob("*.swarm"))
        result = pipeline.check(paths)
        assert result.system is not None
        return build(result.system, module)

    return example
