"""Real messages of Python and gcc about generated files that were moved."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from .conftest import Build, Trace

STUBS = Path(__file__).parents[1] / "skeleton" / "stubs"
CLIMB = """  --> model.swarm:29:3
   |
29 |   action "cmd/climb" : Climb
   |   ^^^^^^^^^^^^^^^^^^^^^^^^^^
"""


def test_a_traceback_of_python(build: Build, trace: Trace, tmp_path: Path) -> None:
    """A node whose interfaces are not built: the model says which."""
    installed = tmp_path / "install" / "lib" / "python3" / "dist-packages"
    shutil.copytree(build() / "climb" / "src", installed)
    for module in ("rospy", "actionlib"):
        (installed / f"{module}.py").touch()
    command = [sys.executable, "-c", "import climb.implementation"]
    run = subprocess.run(command, cwd=installed, capture_output=True, text=True, check=False)
    said = trace(run.stderr)

    assert run.stderr.splitlines()[-1] == "ModuleNotFoundError: No module named 'demo'"
    assert "  = note: `implementation.py` is yours to implement" in said
    assert said.endswith(f"    import demo.msg\n{CLIMB}{run.stderr.splitlines()[-1]}\n")


@pytest.fixture
def compiled(build: Build, tmp_path: Path) -> str:
    """Return gcc's errors for a moved C++ skeleton with a wrong message type."""
    if shutil.which("g++") is None:
        pytest.skip("no g++: apt-get install g++")
    package = tmp_path / "moved" / "climb"
    shutil.copytree(build("skeleton", "language=cpp", "ros=2") / "climb", package)
    shutil.copytree(STUBS, tmp_path / "stubs")
    sample = tmp_path / "stubs" / "demo" / "msg" / "sample.hpp"
    sample.write_text("namespace demo::msg { struct Other {}; }\n", encoding="utf-8")
    command = ["g++", "-std=c++17", "-fsyntax-only", "-fdiagnostics-color=always"]
    command += [f"-I{package / 'include'}", f"-I{tmp_path / 'stubs'}"]
    command.append(str(package / "src" / "climb_base.cpp"))
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.returncode == 1
    return run.stderr


def test_errors_of_gcc(trace: Trace, compiled: str) -> None:
    said = trace(compiled)
    noted = [line for line in said.splitlines() if line.lstrip().startswith("--> ")]

    assert "\x1b[" in compiled
    assert "".join(line for line in said.splitlines(True) if not _is_note(line)) == compiled
    # The input, the output, the function as a whole: each is quoted once.
    assert {line.strip() for line in noted} >= {"--> model.swarm:30:3", "--> model.swarm:32:3"}
    assert said.count('30 |   in  "state"') == said.count('32 |   out "pos/goal_position"') == 1


def test_a_header_that_is_missing(build: Build, trace: Trace, tmp_path: Path) -> None:
    if shutil.which("g++") is None:
        pytest.skip("no g++: apt-get install g++")
    package = build("skeleton", "language=cpp", "ros=2") / "climb"
    shutil.copytree(STUBS, tmp_path / "stubs", ignore=shutil.ignore_patterns("demo"))
    run = subprocess.run(
        ["g++", "-fsyntax-only", "-std=c++17", "-I../include", f"-I{tmp_path}/stubs", "climb.cpp"],
        cwd=package / "src", capture_output=True, text=True, check=False,
    )  # fmt: skip
    said = trace(run.stderr)

    assert "fatal error: demo/action/climb.hpp" in said
    assert f"~~~~~~~~~\n{CLIMB}compilation terminated.\n" in said


def _is_note(line: str) -> bool:
    return line.startswith(("  --> model", "   |\n", "   | ", "  = note")) or line[2:5] == " | "
