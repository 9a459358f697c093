"""Generated packages get a copy of the engine: it stands alone."""

from __future__ import annotations

import ast
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

RUNTIME = Path(__file__).resolve().parents[2] / "src" / "swarmdsl" / "execution" / "engine"
MODULES = sorted(RUNTIME.glob("*.py"))
PROGRAM = """
from robot.engine import Event, Instance, Machine, State, Transition
lamp = Machine("lamp", [
    State("off", transitions=(Transition(("press",), ("on",)),)),
    State("on", transitions=(Transition(("press",), ("off",)),)),
])
instance = Instance(lamp, None)
instance.start()
instance.receive(Event("press"))
print(instance.configuration.ids)
"""


@pytest.mark.parametrize("module", MODULES, ids=lambda path: path.name)
def test_it_imports_the_standard_library_and_itself(module: Path) -> None:
    for node in ast.walk(ast.parse(module.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            assert {name.name.partition(".")[0] for name in node.names} <= sys.stdlib_module_names
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            assert (node.module or "").partition(".")[0] in sys.stdlib_module_names
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 1


@pytest.mark.parametrize("module", MODULES, ids=lambda path: path.name)
def test_it_is_written_in_the_python_of_ros_humble(module: Path) -> None:
    assert ast.parse(module.read_text(encoding="utf-8"), feature_version=(3, 10)).body


def test_a_copy_runs(tmp_path: Path) -> None:
    (tmp_path / "robot").mkdir()
    (tmp_path / "robot" / "__init__.py").touch()
    shutil.copytree(RUNTIME, tmp_path / "robot" / "engine")
    command = [sys.executable, "-S", "-c", PROGRAM]
    run = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)

    assert (run.stdout, run.stderr) == ("['on']\n", "")
