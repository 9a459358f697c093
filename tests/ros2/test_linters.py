"""Linters of `ament_flake8` and `ament_pep257` pass on generated packages.

The linters of ROS are in no package index, but the programs and plugins that they call are. How
they call them is said in ament_lint: `ament_flake8.ini`, and the convention `ament` of
ament_pep257.
"""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

FLAKE8 = """[flake8]
extend-ignore = B902,C816,D100,D101,D102,D103,D104,D105,D106,D107,D203,D212,D404,I202
import-order-style = google
max-line-length = 99
show-source = true
"""
PEP257 = "D100,D101,D102,D103,D104,D105,D106,D107,D203,D212,D404"


@pytest.fixture(scope="session")
def lint(
    ros_folder: Path, tmp_path_factory: pytest.TempPathFactory
) -> Callable[[list[Path]], list[str]]:
    config = tmp_path_factory.mktemp("linters") / "ament_flake8.ini"
    config.write_text(FLAKE8)
    python = ros_folder / "venv" / "bin" / "python"

    def lint(packages: list[Path]) -> list[str]:
        commands = (
            [python, "-m", "flake8", "--config", config, *packages],
            [python, "-m", "pydocstyle", f"--ignore={PEP257}", "--match=.*\\.py", *packages],
        )
        runs = [subprocess.run(c, capture_output=True, text=True, check=False) for c in commands]
        assert not any("No module" in run.stderr for run in runs)
        return [line for run in runs for line in (run.stdout + run.stderr).splitlines()]

    return lint


def test_examples_pass(lint: Callable[[list[Path]], list[str]], packages: list[Path]) -> None:
    assert lint(packages) == []


def test_managed_nodes_pass(
    lint: Callable[[list[Path]], list[str]], variant: Callable[..., Path]
) -> None:
    package = variant("tests/ros2/models", lifecycle="true", copyright="2026 Example Robotics")
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


def test_the_linters_work(lint: Callable[[list[Path]], list[str]], tmp_path: Path) -> None:
    (tmp_path / "bad.py").write_text('import sys\nimport os\n\n\ndef f(id):\n    """does"""\n')
    found = "\n".join(lint([tmp_path]))
    for code in ("F401", "I100", "A002", "D400"):
        assert code in found
