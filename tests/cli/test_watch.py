"""`swarmc check --watch` and `swarmc build --watch`, with files that change."""

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from queue import Empty, Queue
from threading import Thread

import pytest

pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")

RIGHT = "package a\nevent Start : std_msgs/Empty\n"
WRONG = "package a\nevent Start : std_msgs/Emty\n"
MACHINE = "statemachine Work { initial A state A { after 1 s -> B } final B }\n"
SECONDS = 60


class Watching:
    """A running `swarmc ... --watch`."""

    def __init__(self, *arguments: str) -> None:
        command = [sys.executable, "-m", "swarmdsl", *arguments, "--watch"]
        pipe = subprocess.PIPE
        self.process = subprocess.Popen(command, stdout=pipe, stderr=subprocess.STDOUT, text=True)
        self._lines: Queue[str] = Queue()
        self._reader = Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self._lines.put(line)
        self.process.stdout.close()

    def run(self) -> str:
        """What is printed until it waits again."""
        text = ""
        while "waiting for changes" not in text:
            try:
                text += self._lines.get(timeout=SECONDS)
            except Empty:
                pytest.fail(f"it does not wait: {text}")
        return text

    def end(self) -> int:
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(timeout=SECONDS)

    def stop(self) -> None:
        self.process.kill()
        self.process.wait()
        self._reader.join()


@pytest.fixture
def model(tmp_path: Path) -> Path:
    path = tmp_path / "model" / "a.swarm"
    path.parent.mkdir()
    path.write_text(RIGHT, encoding="utf-8")
    return path


@pytest.fixture
def watching(model: Path) -> Iterator[Watching]:
    found = Watching("check", str(model.parent))
    yield found
    found.stop()


def test_check(model: Path, watching: Watching) -> None:
    assert "error[" not in watching.run()
    model.write_text(WRONG, encoding="utf-8")
    assert "did you mean `std_msgs/Empty`?" in watching.run()
    model.write_text(RIGHT, encoding="utf-8")
    assert "error[" not in watching.run()
    other = model.with_name("b.swarm")
    other.write_text('import "gone.swarm"\n', encoding="utf-8")
    assert "gone.swarm" in watching.run()
    model.with_name("gone.swarm").write_text("package gone\nevent E : std_msgs/Empty\n")
    assert "error[" not in watching.run()
    other.unlink()
    assert "error[" not in watching.run()
    assert watching.end() == 0


def test_build(model: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    model.write_text(MACHINE, encoding="utf-8")
    watching = Watching("build", str(model.parent), "--target", "scxml", "--out", str(out))
    try:
        watching.run()
        (first,) = out.rglob("*.scxml")
        model.write_text(MACHINE.replace("-> B", "-> Lost"), encoding="utf-8")
        assert "error[" in watching.run()
        assert first.exists()
        model.write_text(MACHINE.replace("Work", "Rest"), encoding="utf-8")
        assert "error[" not in watching.run()
        (second,) = out.rglob("*.scxml")
        assert second != first
        assert watching.end() == 0
    finally:
        watching.stop()
