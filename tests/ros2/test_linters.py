"""`ament_flake8` and `ament_pep257` find nothing in generated packages."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from .conftest import write_package
from .test_composed import MODEL as GUARDED

LINTERS = ("ament_flake8", "ament_pep257")
RUN = "import sys; from {}.main import main; sys.exit(main(sys.argv[1:]))"


@pytest.fixture
def lint(ros_folder: Path, tmp_path: Path) -> Callable[[list[Path]], list[str]]:
    """Return what the linters say of some folders or files, nothing if they find nothing."""
    python = ros_folder / "venv" / "bin" / "python"

    def lint(paths: list[Path]) -> list[str]:
        said: list[str] = []
        for linter in LINTERS:
            command = [python, "-c", RUN.format(linter), *paths]
            run = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
            assert "Traceback" not in run.stderr, run.stderr
            if run.returncode != 0:
                said += (run.stdout + run.stderr).splitlines()
        return said

    return lint


@pytest.mark.thorough
def test_examples_pass(lint: Callable[[list[Path]], list[str]], packages: list[Path]) -> None:
    """Modules that all packages have are read once."""
    modules = {path.read_bytes(): path for each in packages for path in each.rglob("*.py")}
    assert len(modules) > 5 * len(packages)
    assert lint([*modules.values()]) == []


def test_managed_nodes_pass(
    lint: Callable[[list[Path]], list[str]], variant: Callable[..., Path]
) -> None:
    options = {"lifecycle": "true", "monitors": "true", "copyright": "2026 Example Robotics"}
    package = variant("tests/ros2/models", **options)
    assert lint([package]) == []


def test_packages_with_all_nodes_pass(
    lint: Callable[[list[Path]], list[str]], tmp_path: Path
) -> None:
    """Also the container, and watchdogs, which no other model here has."""
    model = tmp_path / "guarded.swarm"
    model.write_text(GUARDED, encoding="utf-8")
    package = write_package(model, tmp_path, composed="true", monitors="true")
    names = {path.name for path in package.rglob("*.py")}
    assert {
        "container.py",
        "lease.py",
        "watchdog.py",
        "field_monitor.py",
        "robot.launch.py",
    } <= names
    assert lint([package]) == []


@pytest.mark.parametrize("options", [{"target": "yasmin"}, {"target": "smach", "ros": "2"}])
def test_machines_in_libraries_pass(
    lint: Callable[[list[Path]], list[str]],
    variant: Callable[..., Path],
    options: dict[str, str],
) -> None:
    package = variant("tests/ros2/models", **options)
    modules = [*package.rglob("*_fsm.py"), *package.rglob("*_smach.py")]
    modules += [package / package.name / f"{each}.py" for each in ("following", "runner", "states")]
    assert lint(modules) == []


def test_offboard_control_passes(
    lint: Callable[[list[Path]], list[str]], variant: Callable[..., Path]
) -> None:
    package = variant("tests/ros2/px4")
    modules = [*package.rglob("*offboard*.py"), *package.rglob("*.launch.py")]
    assert len(modules) == 7
    assert lint(modules) == []


def test_the_linters_work(lint: Callable[[list[Path]], list[str]], tmp_path: Path) -> None:
    (tmp_path / "bad.py").write_text('import sys\nimport os\n\n\ndef f(id):\n    """does"""\n')
    found = "\n".join(lint([tmp_path]))
    for code in ("F401", "I100", "A002", "D400"):
        assert code in found
