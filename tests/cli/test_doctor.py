"""`swarmc doctor`, `swarmc --version --verbose` and `swarmc completion`."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from swarmdsl.cli import run
from swarmdsl.tools import doctor


@pytest.fixture
def only(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The only folder with commands."""
    monkeypatch.setenv("PATH", str(tmp_path))
    return tmp_path


def command(folder: Path, name: str) -> None:
    path = folder / name
    path.write_text("#!/bin/sh\n", encoding="utf-8")
    path.chmod(0o755)


def test_what_is_there_and_how_to_get_the_rest(
    only: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    command(only, "c++")

    assert run(["doctor", "skeleton"]) == 1
    assert capsys.readouterr().out.splitlines() == [
        "skeleton: to compile skeletons in C++",
        f"  ok  c++    {only / 'c++'}",
        "  --  cmake  on Debian and Ubuntu: apt install cmake",
    ]
    command(only, "cmake")
    assert run(["doctor", "skeleton"]) == 0


@pytest.mark.usefixtures("only")
def test_without_a_purpose_nothing_is_demanded(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["doctor"]) == 0
    printed = capsys.readouterr().out
    assert f"Python: {sys.version.split()[0]} in {sys.executable}\n" in printed
    assert all(f"\n{purpose.name}: to {purpose.what}\n" in printed for purpose in doctor.PURPOSES)


@pytest.mark.usefixtures("only")
def test_ros_2_from_wheels(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(doctor, "_find_modules", lambda names: {})
    assert run(["doctor", "ros2"]) == 1
    # It is installed from here.
    root = Path(__file__).resolve().parents[2]
    assert doctor.checkout() == root
    monkeypatch.setattr(doctor, "checkout", lambda: tmp_path)
    capsys.readouterr()
    for ending in (f"make ros2, in {tmp_path}", f". {tmp_path / '.ros2' / 'setup.sh'}"):
        assert run(["doctor", "ros2"]) == 1
        assert capsys.readouterr().out.splitlines()[-1].endswith(ending)
        (tmp_path / ".ros2").mkdir(exist_ok=True)
        (tmp_path / ".ros2" / "setup.sh").touch()
    monkeypatch.setattr(doctor, "checkout", lambda: None)
    assert run(["doctor", "ros2"]) == 1
    assert "make ros2" not in capsys.readouterr().out


def test_modules_of_the_python_that_comes_first(only: Path) -> None:
    (only / "rclpy.py").touch()
    python = only / "python3"
    python.write_text(f'#!/bin/sh\nPYTHONPATH={only} exec {sys.executable} "$@"\n')
    python.chmod(0o755)

    assert doctor._find_modules(["rclpy"])["rclpy"] == str(only / "rclpy.py")


@pytest.mark.usefixtures("only")
def test_for_programs(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["doctor", "git", "--format", "json"]) == 1
    found = json.loads(capsys.readouterr().out)
    assert found["tools"] == {"git": {"git": None}}
    assert {"swarmdsl", "Python", "textx", "click"} <= found["environment"].keys()


def test_modules_of_python_are_found(monkeypatch: pytest.MonkeyPatch) -> None:
    wanted = doctor.Tool("import jinja2", "")
    monkeypatch.setattr(doctor, "PURPOSES", (doctor.Purpose("a", "b", (wanted,)),))
    ((found,),) = doctor.find().values()

    assert found.place is not None
    assert Path(found.place).name == "__init__.py"


def test_an_unknown_purpose(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["doctor", "ros3"]) == 2
    assert "there is no purpose `ros3`: did you mean" in capsys.readouterr().err


def test_a_version_with_all_that_a_report_needs(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["--verbose", "--version"]) == 0
    first, *rest = capsys.readouterr().out.splitlines()
    assert first.startswith("swarmc, version ")
    assert [line.partition(":")[0] for line in rest][:3] == ["swarmdsl", "Python", "system"]
    assert run(["--verbose"]) == 2
    assert "needs `--version`" in capsys.readouterr().err


@pytest.mark.skipif(shutil.which("bash") is None, reason="no bash: apt-get install bash")
def test_a_shell_completes(tmp_path: Path) -> None:
    """A real bash, asked as the key does it."""
    script = """
eval "$(swarmc completion bash)"
COMP_WORDS=(swarmc expl) COMP_CWORD=1
_swarmc_completion swarmc
echo "${COMPREPLY[@]}"
"""
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-c", script], env={**os.environ, "PATH": path}, capture_output=True, text=True
    )
    assert (done.stdout, done.returncode) == ("explain\n", 0), done.stderr


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion_of_shells(shell: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["completion", shell]) == 0
    assert f"{shell}_complete" in capsys.readouterr().out
