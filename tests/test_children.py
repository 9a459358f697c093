"""Tests can interrupt their child processes, and a test that hangs fails."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
TEST = """
import subprocess

def test_that_waits_for_ever(tmp_path):
    with subprocess.Popen(["sh", "-c", "sleep 1000 & echo $!; wait"], stdout=-1) as process:
        (tmp_path.parent / "pid").write_bytes(process.stdout.readline())

def test_after_it():
    pass
"""


def pytest_in(folder: Path, *options: str) -> subprocess.CompletedProcess[str]:
    (folder / "conftest.py").write_text("from children import pytest_timeout_set_timer")
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", f"--basetemp={folder}/tmp"]
    environment = {**os.environ, "PYTHONPATH": str(HERE)}
    return subprocess.run(
        [*command, *options], cwd=folder, env=environment, capture_output=True, text=True
    )


def test_a_test_that_waits_for_a_child_fails_in_time(tmp_path: Path) -> None:
    (tmp_path / "test_it.py").write_text(TEST, encoding="utf-8")
    ran = pytest_in(tmp_path, "--timeout=1", "--timeout-method=signal")

    assert "1 failed, 1 passed" in ran.stdout
    assert "Timeout (>1.0s)" in ran.stdout
    sleeping = int((tmp_path / "tmp" / "pid").read_text())
    status = Path(f"/proc/{sleeping}/stat")
    assert not status.exists() or status.read_text().rpartition(")")[2].split()[0] == "Z"


def test_children_can_be_interrupted_where_the_shell_ignores_interrupts(tmp_path: Path) -> None:
    test = "\n".join(
        (
            "import children, signal, subprocess",
            "children.restore_interrupts()",
            "process = subprocess.Popen(['sleep', '1000'])",
            "process.send_signal(signal.SIGINT)",
            "print(process.wait())",
        )
    )
    (tmp_path / "script.sh").write_text(f'"{sys.executable}" -c "{test}" & wait $!')
    ran = subprocess.run(
        ["sh", tmp_path / "script.sh"], cwd=HERE, capture_output=True, text=True, check=True
    )

    assert ran.stdout == f"{-signal.SIGINT}\n"
