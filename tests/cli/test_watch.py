"""`swarmc check --watch` and `swarmc build --watch`, with files that change."""

import os
import re
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
MACHINE = "statemachine Work { initial A; state A { after 1 s -> B } final B }\n"
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
        """Return the output up to the next wait for changes."""
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


def put(path: Path, text: str) -> None:
    """Write a file at once: nobody sees half of it, nor a change of a folder that is watched."""
    half = path.parents[2] / "half"
    half.write_text(text, encoding="utf-8")
    half.replace(path)


def test_check(model: Path, watching: Watching) -> None:
    first = watching.run()
    assert ("error[" in first, "changed:" in first) == (False, False)
    put(model, WRONG)
    told = watching.run()
    assert told.startswith("changed: a.swarm\n")
    assert "did you mean `std_msgs/Empty`?" in told
    put(model, RIGHT)
    assert "error[" not in watching.run()
    other = model.with_name("b.swarm")
    put(other, 'import "gone.swarm"\n')
    assert "gone.swarm" in watching.run()
    put(model.with_name("gone.swarm"), "package gone\nevent E : std_msgs/Empty\n")
    assert "error[" not in watching.run()
    other.unlink()
    assert "error[" not in watching.run()
    assert watching.end() == 0


def test_build(model: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    put(model, MACHINE)
    watching = Watching("build", str(model.parent), "--target", "scxml", "--out", str(out))
    try:
        watching.run()
        (first,) = out.rglob("*.scxml")
        put(model, MACHINE.replace("-> B", "-> Lost"))
        assert "error[" in watching.run()
        assert first.exists()
        put(model, MACHINE.replace("Work", "Rest"))
        assert "error[" not in watching.run()
        (second,) = out.rglob("*.scxml")
        assert second != first
        assert watching.end() == 0
    finally:
        watching.stop()


def test_a_build_is_a_line(model: Path, tmp_path: Path) -> None:
    """With what changed, when, how long it took and what became of how many files."""
    out = tmp_path / "out"
    two = MACHINE + MACHINE.replace("Work", "Rest")
    put(model, two)
    options = ("--target", "scxml", "--option", "scxml.profile=portable")
    watching = Watching("build", str(model.parent), *options, "--out", str(out))
    try:
        line = r"waiting for changes \((a.swarm, )?\d\d:\d\d:\d\d, \d+ ms\): "
        first = watching.run()
        assert re.fullmatch(f"{line}2 written; no errors in 1 file \\(end with Ctrl-C\\)\n", first)
        before = {path: path.stat().st_mtime_ns for path in out.rglob("*") if path.is_file()}
        put(model, two)
        same = watching.run()
        assert re.fullmatch(f"{line}2 unchanged; no errors in 1 file\n", same)
        put(model, two.replace("-> B", "-> Lost"))
        said = watching.run()
        assert re.search(f"^{line}2 errors in 1 file$", said, re.MULTILINE)
        now = {path: path.stat().st_mtime_ns for path in out.rglob("*") if path.is_file()}
        assert now == before
        put(model, two.replace("1 s", "2 s", 1))
        # What was wrong is so no longer, which an editor is told.
        mended = watching.run()
        assert mended.startswith("changed: a.swarm\n")
        assert mended.endswith("): 1 written, 1 unchanged; no errors in 1 file\n")
    finally:
        watching.stop()


def test_a_dry_run_that_watches(model: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    put(model, MACHINE)
    arguments = ("build", str(model.parent), "--target", "scxml", "--out", str(out), "--dry-run")
    watching = Watching(*arguments)
    try:
        assert f"create    {out}/scxml/Work.scxml\n" in watching.run()
        put(model, MACHINE.replace("Work", "Rest"))
        assert f"create    {out}/scxml/Rest.scxml\n" in watching.run()
        assert not out.exists()
    finally:
        watching.stop()


def test_what_a_target_cannot_express_is_told_at_its_place(model: Path, tmp_path: Path) -> None:
    """This is one in the file, although a declaration is checked on its own."""
    put(model, f"{RIGHT}{MACHINE}")
    option = ("--option", "scxml.profile=cpswarm")
    watching = Watching("build", str(model), "-t", "scxml", *option, "--out", str(tmp_path / "out"))
    try:
        said = watching.run()
        assert "cannot express a transition after a time" in said
        assert f" --> {model}:3:42\n" in said
    finally:
        watching.stop()


def test_the_project_file_is_watched(model: Path, watching: Watching) -> None:
    assert "no errors in 1 file" in watching.run()
    project = model.with_name("swarm.toml")
    put(project, '[lint]\nwarn = ["unused-declaration"]\n')
    assert "event `Start` is never used" in watching.run()
    put(project, "[lint")
    assert "swarm.toml:1:" in watching.run()
    project.unlink()
    assert "no errors in 1 file" in watching.run()


def test_a_project_file_that_does_not_go_with_the_command_line(model: Path, tmp_path: Path) -> None:
    put(model, MACHINE)
    project = model.with_name("swarm.toml")
    put(project, "[targets.scxml]\n")
    option = ("--option", "scxml.profile=portable")
    watching = Watching("build", str(model.parent), *option, "--out", str(tmp_path / "out"))
    try:
        assert "no errors in 1 file" in watching.run()
        put(project, "[targets.adf]\n")
        assert "target `scxml` is not built" in watching.run()
        put(project, "[targets.scxml]\n")
        assert "no errors in 1 file" in watching.run()
    finally:
        watching.stop()


def test_a_package_that_comes_and_grows(model: Path) -> None:
    text = "package a\nimport things.*\nevent Start : std_msgs/Empty\nconst B : int32 = MORE\n"
    put(model, text)
    watching = Watching("check", str(model))
    try:
        assert "error[SW0008]" in watching.run()
        package = model.parent / "things"
        made = model.parent / "made"
        made.mkdir()
        put(made / "one.swarm", "const ONE : int32 = 1\n")
        made.rename(package)
        assert "no value called `MORE`" in watching.run()
        put(package / "two.swarm", "const MORE : int32 = 1\n")
        assert "error[" not in watching.run()
    finally:
        watching.stop()


def test_new_interfaces_of_ros(model: Path, tmp_path: Path, watching: Watching) -> None:
    watching.run()
    messages = tmp_path / "x_msgs" / "msg"
    messages.mkdir(parents=True)
    put(messages / "A.msg", "int32 a\n")
    text = 'package a\nimport ros "../x_msgs"\nevent Start : x_msgs/B\n'
    put(model, text)
    assert "x_msgs/B" in watching.run()
    put(messages / "B.msg", "int32 b\n")
    assert "error[" not in watching.run()


# A finalizer in which a signal arrives: Python drops the exception of its handler there.
FINALIZER = """
import os, sys
from swarmdsl.cli import main, watch

class Garbage:
    def __del__(self):
        os.kill(os.getpid(), {number})
        for _ in range(1000):
            pass

garbage = [Garbage()]
sleep = watch.sleep

def collect(seconds):
    garbage.clear()
    sleep(seconds)

watch.sleep = collect
main()
"""


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 0), (signal.SIGTERM, 143)])
def test_signal_in_a_finalizer_is_not_lost(model: Path, number: int, code: int) -> None:
    script = FINALIZER.format(number=int(number))
    command = [sys.executable, "-c", script, "check", str(model), "--watch"]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS)
    assert "Exception ignored in: <function Garbage.__del__" in ended.stderr
    assert ended.returncode == code
