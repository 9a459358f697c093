"""Logs keep all they have, and say of generated files where these come from."""

from __future__ import annotations

import os
import random
import subprocess
import sys
from io import BytesIO
from itertools import pairwise
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.cli import run as swarmc
from swarmdsl.output import manifest
from swarmdsl.tools.trace.annotations import Annotator
from swarmdsl.tools.trace.command import run
from swarmdsl.tools.trace.generated_files import OutputFolders
from swarmdsl.tools.trace.stream import Tracer

from .conftest import Build, Trace, line_of

STATE = """  --> model.swarm:30:3
   |
30 |   in  "state"              : Sample
   |   ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
"""


def test_a_traceback_has_the_places_below_its_frames(build: Build, trace: Trace) -> None:
    base = build() / "climb" / "src" / "climb" / "base.py"
    hears = line_of(base, "self.on_state(message)")
    log = f"""Traceback (most recent call last):
  File "/usr/lib/python3/dist-packages/rospy/topics.py", line 750, in _invoke_callback
    cb(msg)
  File "/home/robot/ws/install/lib/python3/dist-packages/climb/base.py", line {hears}, in _hear
    self.on_state(message)
    ~~~~~~~~~~~~~^^^^^^^^^
@  File "/home/robot/ws/install/lib/python3/dist-packages/climb/implementation.py", line 7, in on
    return self.aborted(x)
+NameError: name 'x' is not defined
"""
    yours = "  = note: `implementation.py` is yours to implement, for model.swarm:28:10\n"

    assert trace(log.replace("@", "").replace("+", "")) == log.replace("@", STATE).replace(
        "+", yours
    )


def test_a_compiler_has_the_places_below_its_lines(build: Build, trace: Trace) -> None:
    header = build("skeleton", "language=cpp") / "climb" / "include" / "climb" / "climb_base.h"
    at = line_of(header, "#include <demo/Sample.h>")
    log = f"""In file included from /ws/src/climb/include/climb/climb_base.h:{at},
@1                 from /ws/src/climb/include/climb/climb.h:9,
                 from /ws/src/climb/src/climb.cpp:5:
/ws/src/climb/include/climb/climb.h:12:1: note: in it
@2\x1b[01m\x1b[K/w/climb/include/climb/climb_base.h:{at}:10:\x1b[m\x1b[K \x1b[01;31merror:\x1b[m
   14 | #include <demo/Sample.h>
      |          \x1b[01;31m\x1b[K^~~~~\x1b[m\x1b[K
@3compilation terminated.
"""
    yours = "  = note: `climb.h` is yours to implement, for model.swarm:28:10\n"
    notes = {"@1": "  --> model.swarm:30:3\n", "@2": yours, "@3": STATE}

    def with_notes(told: bool) -> str:
        text = log
        for mark, note in notes.items():
            text = text.replace(mark, note if told else "")
        return text

    assert trace(with_notes(False)) == with_notes(True)


def test_a_process_keeps_its_prefix(build: Build, trace: Trace) -> None:
    base = build() / "climb" / "src" / "climb" / "base.py"
    log = f'[climb-1]   File "/x/climb/base.py", line {line_of(base, "self.steps =")}, in x\n'

    assert trace(log + "[climb-1]     y\n[climb-1] KeyError\n").splitlines()[2:] == [
        "[climb-1]   --> model.swarm:36:9",
        "[climb-1]    |",
        "[climb-1] 36 |   param steps     : int32    = 3",
        "[climb-1]    |         ^^^^^",
        "[climb-1] KeyError",
    ]


@pytest.mark.parametrize(
    "line",
    [
        "[ERROR] [1700000000.1]: no way (/opt/ws/lib/python3/dist-packages/climb/base.py:{})",
        "1700000000.1 ERROR /climb [/opt/climb/base.py:{}(_hear_state)] [topics: /rosout] no",
        "[climb.py-1] [INFO] [17.1] [climb]: no way (_hear_state() at /opt/ws/climb/base.py:{})",
        "CMake Warning at src\\climb\\base.py:{} (message):",
        "see '/opt/ws/climb/base.py:{}'.",
        "/opt/ws/climb/base.py:{}: in on_state",
        'in "/opt/my ws/climb/base.py", line {}, column 3',
    ],
)
def test_a_place_in_a_line_of_any_program(build: Build, trace: Trace, line: str) -> None:
    base = build() / "climb" / "src" / "climb" / "base.py"
    log = line.format(line_of(base, "self.on_state(message)")) + "\nmore\n"

    assert "--> model.swarm:30:3\n" in trace(log)


@pytest.mark.parametrize(
    ("path", "known"),
    [
        ("{src}/skeleton/climb/src/climb/base.py", True),
        ("/elsewhere/install/lib/python3.10/site-packages/climb/base.py", True),
        ("climb/base.py", True),
        ("./src/skeleton/climb/scripts/climb_node", True),
        ("/elsewhere/devel/lib/climb/climb_node", True),
        ("/elsewhere/share/climb/launch/climb.launch", True),
        ("C:\\ws\\climb\\base.py", True),
        ("climb_node", True),
        ("base.py", False),
        ("/elsewhere/base.py", False),
        ("/elsewhere/other/base.py", False),
        ("/home/climb/other/base.py", False),
        ("/elsewhere/src/base.py", False),
        ("/elsewhere/climb/other.py", False),
        ("", False),
        ("/", False),
        ("\0/climb/base.py", False),
    ],
)
def test_which_file_a_path_means(build: Build, path: str, known: bool) -> None:
    src = build().parent
    file = OutputFolders([src]).file(path.format(src=src))

    assert (file is not None) == known


def test_files_of_the_same_name_are_told_apart_by_what_is_above_them(build: Build) -> None:
    folders = OutputFolders([build("skeleton", "ros=2").parent])
    paths = {
        "/i/climb/lib/python3.10/site-packages/climb/base.py": "skeleton/climb/climb/base.py",
        "/i/camera/lib/python3.10/site-packages/camera/base.py": "skeleton/camera/camera/base.py",
        "/i/camera/package.xml": "skeleton/camera/package.xml",
    }
    for path, own in paths.items():
        file = folders.file(path)
        assert file is not None
        assert file.path == own


def test_a_logged_file_leads_to_the_folder_that_it_is_in(
    build: Build, trace: Trace, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    build()
    (tmp_path / "far" / "away").mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "far" / "away")
    log = f"{tmp_path}/src/skeleton/climb/setup.py:2: bad\n"

    assert f"--> {tmp_path}/model.swarm:28:10\n" in trace(log)
    assert "the whole of `setup.py` is generated from this" in trace(log)


def test_a_place_is_shown_once_and_told_again(build: Build, trace: Trace) -> None:
    base = build() / "climb" / "src" / "climb" / "base.py"
    line = f"climb/base.py:{line_of(base, 'self.on_state(message)')}\n"

    assert trace(line * 3) == line + STATE + (line + "  --> model.swarm:30:3\n") * 2


def test_lines_of_the_user_in_a_generated_file_move_those_below(build: Build, trace: Trace) -> None:
    cmake = build("skeleton", "language=cpp") / "climb" / "CMakeLists.txt"
    text = cmake.read_text(encoding="utf-8")
    cmake.write_text(
        text.replace("components\n  # swarmc:end", "components\n  tf2\n  # swarmc:end")
    )
    mine = line_of(cmake, "  tf2")

    assert trace(f"CMake Error at climb/CMakeLists.txt:{mine} (find_package):\n").endswith(
        "  = note: you wrote this line of `CMakeLists.txt`\n"
    )
    assert "--> model.swarm:28:10" in trace(f"climb/CMakeLists.txt:{mine + 5}\n")


@pytest.mark.parametrize("with_texts", [True, False])
def test_lines_that_an_edit_has_moved(build: Build, trace: Trace, with_texts: bool) -> None:
    base = build() / "climb" / "src" / "climb" / "base.py"
    text = base.read_text(encoding="utf-8")
    base.write_text(text.replace("import rospy\n", "import rospy\nimport sys\n"), encoding="utf-8")
    if not with_texts:
        # Then nobody knows what was generated.
        (base.parents[4] / ".swarmdsl.texts").unlink()
    line = f"climb/base.py:{line_of(base, 'self.on_state(message)')}\n"
    mine = f"climb/base.py:{line_of(base, 'import sys')}\n"

    assert "--> model.swarm:30:3\n" in trace(line)
    assert ("`base.py` was edited after the build" in trace(line)) != with_texts
    assert ("you wrote this line" in trace(mine)) == with_texts


def test_a_model_that_has_changed_is_not_shown(build: Build, trace: Trace, tmp_path: Path) -> None:
    build()
    (tmp_path / "model.swarm").write_text("package other\n", encoding="utf-8")
    said = trace("climb/setup.py:1\n")
    (tmp_path / "model.swarm").unlink()

    assert said == (
        "climb/setup.py:1\n"
        "  --> model.swarm:28:10\n"
        "  = note: `model.swarm` was edited after the build: the line may be wrong\n"
    )
    Annotator.__init__.__globals__["_read_model"].cache_clear()
    assert "note: `model.swarm` is missing, so its line cannot be shown" in trace(
        "climb/setup.py:1\n"
    )


@pytest.mark.parametrize("target", ["smach", "ros2", "yasmin", "scxml"])
def test_other_targets(build: Build, trace: Trace, target: str) -> None:
    model = Path(__file__).parents[2] / "examples" / "minimal" / "blinker.swarm"
    folder = build(target, model=model)
    log = "".join(
        f"{target}/{path.relative_to(folder).as_posix()}:{number}\n"
        for path in folder.rglob("*")
        if path.suffix in (".py", ".scxml")
        for number, _ in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
    )
    lines = model.read_text(encoding="utf-8").splitlines()
    states = [number for number, line in enumerate(lines, 1) if line.strip().startswith("state ")]
    said = trace(log)

    assert states
    for number in states:
        assert f"--> blinker.swarm:{number}:" in said


def test_a_file_that_stands_for_no_place_says_so_once(build: Build, trace: Trace) -> None:
    model = Path(__file__).parents[2] / "examples" / "minimal" / "blinker.swarm"
    folder = build("smach", model=model)
    [package] = (path.parent.name for path in folder.glob("*/package.xml"))
    line = f"{package}/src/{package}/chart.py:12\n"

    assert trace(line * 2) == (
        f"{line}  = note: `chart.py` is generated, but not from a single element of the model\n"
        f"{line}"
    )


def junk(seed: int) -> bytes:
    """A log with all that may come, and with lines that are cut anywhere."""
    chance = random.Random(seed)
    pieces = [
        b'  File "/x/climb/base.py", line 30, in x\n',
        b"    code\n",
        b"climb/base.py:20:1: error: x\n",
        b"   20 | code\n",
        b"      | ^~~\n",
        b"In file included from climb/base.py:9,\n",
        b"[a-1] climb/base.py:31\n",
        b"climb/implementation.py:3:4: x\r\n",
        b"\xff\xfe\0climb/base.py:9\xe2\x82\n",
        b"\x1b[1mclimb/base.py:9\x1b[0m\n",
        b"\x1b[\x1b]8;;\n",
        b"\n",
        b"\r50%\r60%",
        b"x" * 100_000,
        b":" * 5000,
        bytes(chance.randrange(256) for _ in range(300)),
        b'", line 5' * 400,
    ]
    return b"".join(chance.choices(pieces, k=60))


@pytest.mark.parametrize("seed", range(8))
def test_nothing_is_lost_and_nothing_depends_on_how_it_comes(build: Build, seed: int) -> None:
    src, log = build().parent, junk(seed)

    def traced(*cuts: int) -> bytes:
        tracer = Tracer(OutputFolders([src]), Annotator(colour=False))
        bounds = [0, *cuts, len(log)]
        out = b"".join(tracer.feed(log[start:end]) for start, end in pairwise(bounds))
        return out + tracer.end()

    whole = traced()
    chance = random.Random(seed)
    for _ in range(3):
        assert traced(*sorted(chance.choices(range(len(log)), k=200))) == whole
    assert b"--> model.swarm" in whole
    # Without its notes it is the log.
    rest = memoryview(whole).tobytes().splitlines(keepends=True)
    of_log = iter(rest)
    for line in log.splitlines(keepends=True):
        assert any(each.rstrip(b"\n") == line.rstrip(b"\n") for each in of_log), line[:80]


def test_what_comes_goes_on_at_once(build: Build) -> None:
    """A line that has not ended, and one whose note waits for the code below it."""
    tracer = Tracer(OutputFolders([build().parent]), Annotator(colour=False))

    assert tracer.feed(b"[ 50%] buil") == b"[ 50%] buil"
    assert tracer.feed(b"ding\nclimb/setup.py:1") == b"ding\nclimb/setup.py:1"
    assert tracer.feed(b"\n").startswith(b"\n  --> model.swarm")
    assert tracer.feed(b"climb/setup.py:1:2: error\n") == b"climb/setup.py:1:2: error\n"
    assert tracer.feed(b"    1 | co") == b""
    assert tracer.feed(b"de\n") == b"    1 | code\n"
    assert tracer.feed(b"next") == b""
    assert tracer.feed(b"\n") == b"  --> model.swarm:28:10\nnext\n"
    assert tracer.end() == b""


@pytest.mark.parametrize("end", ["", "\n"])
def test_a_log_ends_as_it_ends(build: Build, trace: Trace, end: str) -> None:
    build()

    assert trace(f"a\nb{end}") == f"a\nb{end}"
    assert trace(f"climb/setup.py:1{end}").startswith("climb/setup.py:1\n  --> model.swarm:28:10\n")
    assert trace(f"climb/setup.py:1:1: x\n  1 | b{end}").startswith(
        "climb/setup.py:1:1: x\n  1 | b\n  --> model.swarm:28:10\n"
    )


def test_a_long_line_takes_no_long_time(build: Build, trace: Trace) -> None:
    build()
    for piece in ("a", ":1", "x:", '"', "\x1b[", "[a-1] ", "1:1:1:"):
        log = piece * (400_000 // len(piece))
        assert trace(log) == log


def test_a_pipe(build: Build, tmp_path: Path) -> None:
    build()
    command = [sys.executable, "-m", "swarmdsl", "trace"]
    variables = {**os.environ, "FORCE_COLOR": "1"}
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, cwd=tmp_path, env=variables
    ) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        process.stdin.write(b"climb/setup.py:1\n")
        process.stdin.flush()
        # What was written is there though the pipe is open.
        assert process.stdout.readline() == b"climb/setup.py:1\n"
        assert process.stdout.readline() == b"\x1b[34m  --> \x1b[0mmodel.swarm:28:10\n"
        process.stdin.close()
        assert process.stdout.read().count(b"\x1b[1;36m") == 1
        assert process.wait(20) == 0


def test_logs_in_files(
    build: Build, tmp_path: Path, capfdbinary: pytest.CaptureFixture[bytes]
) -> None:
    build()
    (tmp_path / "first.log").write_bytes(b"climb/setup.py:1\n")
    (tmp_path / "second.log").write_bytes(b"other\xff\n")
    capfdbinary.readouterr()

    assert swarmc(["trace", "first.log", "missing.log", "second.log"]) == 1
    out, err = capfdbinary.readouterr()
    assert out.startswith(b"climb/setup.py:1\n  --> model.swarm:28:10\n")
    assert out.endswith(b"other\xff\n")
    assert b"error[SW0001]" in err
    assert b"missing.log" in err


def complaints(*outs: Path) -> list[tuple[str, str]]:
    stdout, report = BytesIO(), Diagnostics()
    run((), outs, BytesIO(b"a\nb"), stdout, report, colour=False)
    assert stdout.getvalue() == b"a\nb"
    return [(found.name, found.message) for found in report]


@pytest.mark.parametrize(
    "content", ["{", "[]", '{"files": {}}', '{"map": 3}', '{"map": {"version": 2}}']
)
def test_a_manifest_without_maps(build: Build, content: str) -> None:
    out = build().parent
    (out / manifest.NAME).write_text(content, encoding="utf-8")
    message = f"no source map in `{out}`: it was built by a version of swarmc that wrote none"

    assert complaints(out) == [("no-source-map", message)]


def test_without_an_output_folder(
    build: Build, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    build()
    empty = tmp_path / "empty"
    empty.mkdir()

    assert complaints() == []
    assert complaints(empty) == [
        ("no-source-map", f"no source map in `{empty}`: nothing was built into it")
    ]
    (tmp_path / "src" / manifest.NAME).unlink()
    monkeypatch.chdir(empty)
    assert complaints() == [
        (
            "no-source-map",
            "no source map in `.`: nothing was built into it or beside the logged files",
        )
    ]


def test_the_project_file_says_where_the_output_is(
    build: Build, trace: Trace, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    build()
    project = tmp_path / "project" / "inside"
    project.mkdir(parents=True)
    (tmp_path / "src").rename(tmp_path / "made")
    (tmp_path / "project" / "swarm.toml").write_text('[build]\nout = "../made"\n', encoding="utf-8")
    monkeypatch.chdir(project)

    assert "model.swarm:28:10" in trace("climb/setup.py:1\n")
