"""Pipes, devices, sockets and the like in place of files: one word about it, and no waiting."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.base import find_files, read_files
from swarmdsl.base.find_files import MOST_ENTRIES
from swarmdsl.driver import pipeline

from ..conftest import Ran
from ..fuzz.odd_files import KINDS, odd_file

# What waits for a pipe waits for ever.
pytestmark = [
    pytest.mark.timeout(60),
    pytest.mark.skipif(os.name != "posix", reason="files of POSIX"),
]

MODEL = """package lamps
event Go : std_msgs/Empty
statemachine Blinking {
  initial Off
  state Off { on Go -> End }
  final End
}
member Blinker { behavior Blinking }
"""
SPECIAL = {
    "a pipe": "a pipe",
    "a device without end": "a device",
    "a full device": "a device",
    "a socket": "a socket",
}
READERS = {
    "check": ("check odd.swarm", "odd.swarm"),
    "fmt": ("fmt odd.swarm", "odd.swarm"),
    "build": ("build odd.swarm -o out", "odd.swarm"),
    "doc": ("doc odd.swarm", "odd.swarm"),
    "diagram": ("diagram odd.swarm", "odd.swarm"),
    "import of a model": ("check importing.swarm", "odd.swarm"),
    "simulate": ("simulate odd.swarm", "odd.swarm"),
    "document": ("simulate odd.scxml", "odd.scxml"),
    "scenario": ("simulate model.swarm --scenario odd.toml", "odd.toml"),
    "events": ("simulate model.swarm --events odd.jsonl", "odd.jsonl"),
    "trace": ("simulate model.swarm --replay odd.jsonl", "odd.jsonl"),
    "test": ("test odd.swarmtest.toml", "odd.swarmtest.toml"),
    "scxml": ("import scxml odd.scxml", "odd.scxml"),
    "adf": ("import adf odd.json", "odd.json"),
    "described": ("import scxml machine.scxml --adf odd.json", "odd.json"),
    "message": ("import ros package", "package/msg/Odd.msg"),
    "message of a model": ("check ros.swarm", "package/msg/Odd.msg"),
    "manifest": ("import ros package", "package/package.xml"),
    "parameters": ("import ros package", "package/config/odd.yaml"),
    "log": ("trace odd.log", "odd.log"),
    "merge": ("merge odd.swarm model.swarm model.swarm", "odd.swarm"),
    "diff": ("diff odd.swarm model.swarm", "odd.swarm"),
    "rename": ("rename Go Start odd.swarm", "odd.swarm"),
}
WRITERS = {
    "trace": "simulate model.swarm --until 1s --trace-file {}",
    "timeline": "simulate model.swarm --until 1s --timeline {}",
    "page": "doc model.swarm -o {}",
    "diagram": "diagram model.swarm -o {}",
    "model": "import scxml machine.scxml -o {}",
    "build": "build model.swarm -o {}",
    "results": "test lamps.swarmtest.toml --junit {}",
}
TEST = '[[test]]\nname = "waits"\nsteps = [{ expect = { in = "Off" } }]\n'
MACHINE = '<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0"><state id="A"/></scxml>'


@pytest.fixture
def project(folder: Path) -> Path:
    """A project in the current folder."""
    (folder / "swarm.toml").write_text('[project]\nsources = ["model.swarm"]\n')
    (folder / "model.swarm").write_text(MODEL)
    (folder / "importing.swarm").write_text('import "odd.swarm"\n')
    (folder / "ros.swarm").write_text('import ros "package"\n')
    (folder / "machine.scxml").write_text(MACHINE)
    (folder / "lamps.swarmtest.toml").write_text(TEST)
    (folder / "package/msg").mkdir(parents=True)
    (folder / "package/config").mkdir()
    (folder / "package/msg/Fine.msg").write_text("int32 x\n")
    return folder


# The whole machine is searched for some seconds.
@pytest.mark.parametrize("kind", [each for each in KINDS if each != "the root folder"])
@pytest.mark.parametrize("reader", READERS)
def test_what_is_read(
    reader: str, kind: str, project: Path, swarmc: Callable[..., Ran], locked_to_all: None
) -> None:
    command, name = READERS[reader]
    odd = odd_file(kind, project / name)
    if (reader, kind) == ("log", "bytes"):
        return  # it is passed on, whatever it is
    words = [str(odd) if word == name else word for word in command.split()]

    done = swarmc(*words)

    assert done.code in (0, 1, 2)
    said = done.out + done.err
    if kind in SPECIAL and reader != "manifest":
        assert f"is {SPECIAL[kind]}, not " in said
        assert done.code


@pytest.fixture
def locked_to_all(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let no user open locked files, not even root."""
    opened = os.open

    def refuse(path: str | Path, flags: int, mode: int = 0o777, **more: int) -> int:
        if Path(path).is_file() and not Path(path).stat().st_mode & 0o777:
            raise PermissionError(13, "Permission denied", str(path))
        return opened(path, flags, mode, **more)

    monkeypatch.setattr(os, "open", refuse)


@pytest.mark.parametrize(
    "kind",
    [
        each
        for each in KINDS
        if each not in ("an empty file", "bytes", "a locked file", "the root folder")
    ],
)
@pytest.mark.parametrize("writer", WRITERS)
def test_what_is_written(writer: str, kind: str, project: Path, swarmc: Callable[..., Ran]) -> None:
    suffix = {"trace": ".jsonl", "timeline": ".svg", "page": ".html", "diagram": ".svg"}
    suffix |= {"results": ".xml"}
    odd = odd_file(kind, project / f"odd{suffix.get(writer, '.swarm')}")
    before = os.lstat(odd).st_mode if os.path.lexists(odd) else None

    done = swarmc(*WRITERS[writer].format(odd).split())

    assert done.code in (0, 1, 2)
    if kind in SPECIAL or kind == "a null device":
        assert done.code == 1
        assert "cannot write" in done.out + done.err
    if before is not None and kind != "a link to nothing":
        assert os.lstat(odd).st_mode == before


@pytest.mark.parametrize("name", [".swarmdsl.json", ".swarmdsl.pending", ".swarmdsl.texts"])
@pytest.mark.parametrize("kind", ["a pipe", "a device without end", "a folder", "a link to itself"])
def test_what_a_build_keeps(
    name: str, kind: str, project: Path, swarmc: Callable[..., Ran]
) -> None:
    (project / "out").mkdir()
    odd_file(kind, project / "out" / name)
    assert swarmc("build", "model.swarm", "-o", "out").code in (0, 1)


def test_a_file_that_is_too_large(project: Path, swarmc: Callable[..., Ran]) -> None:
    with (project / "large.swarm").open("wb") as file:
        file.truncate(read_files.MOST + 1)
    done = swarmc("check", "large.swarm")
    assert done.code == 1
    assert "error[SW1217]: `large.swarm` is larger than 8 MB" in done.out


def test_files_of_the_kernel_have_no_size() -> None:
    assert read_files.read_file("/proc/self/status").startswith(b"Name:")


def test_standard_input_that_is_too_large(
    project: Path, swarmc: Callable[..., Ran], monkeypatch: pytest.MonkeyPatch
) -> None:
    with Path("/dev/zero").open() as endless:
        monkeypatch.setattr("sys.stdin", endless)
        done = swarmc("fmt", "-")
    assert done.code == 1
    assert "error[SW1217]: `<stdin>` is larger than 8 MB" in done.err


def test_a_line_without_end_is_cut() -> None:
    pieces = iter([b"one\ntw", b"o\n", b"x" * read_files.MOST, b"xx", b"three", b""])
    lines = [line for lines in read_files.lines_of(lambda: next(pieces)) for line in lines]
    assert lines == [b"one", b"two", b"x" * read_files.MOST + b"xx", b"three"]


@pytest.mark.parametrize("command", ["check", "fmt --check", "build -o out", "test", "doc"])
def test_sources_with_too_many_files(
    command: str, project: Path, swarmc: Callable[..., Ran], monkeypatch: pytest.MonkeyPatch
) -> None:
    """`sources = ["/"]` is the whole machine."""
    assert MOST_ENTRIES == 100_000
    monkeypatch.setattr(find_files, "MOST_ENTRIES", 20)
    for number in range(25):
        (project / f"{number}.txt").touch()
    (project / "swarm.toml").write_text('[project]\nsources = ["."]\n')
    done = swarmc(*command.split())
    assert done.code == 1
    assert "SW0018" in done.out + done.err
    assert "it has more than 20 files and folders" in done.out + done.err


@pytest.mark.parametrize(
    ("model", "name"),
    [('import ros "packages"', "packages"), ("import many.*", "many")],
)
def test_imports_with_too_many_files(
    model: str, name: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(find_files, "MOST_ENTRIES", 20)
    (folder / name).mkdir()
    for number in range(25):
        (folder / name / f"{number}.txt").touch()
    (folder / "model.swarm").write_text(f"{model}\nevent E : std_msgs/Empty\n")
    found = list(pipeline.check([folder / "model.swarm"]).report)
    (many,) = (each for each in found if each.name == "too-many-files")
    assert many.primary is not None
    assert many.primary.span.text in (f'"{name}"', "many.*")


def test_models_that_are_too_large_together(
    folder: Path, swarmc: Callable[..., Ran], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(find_files, "MOST_TOGETHER", 2**20)
    for number in range(3):
        with (folder / f"{number}.swarm").open("wb") as file:
            file.truncate(2**19)
    done = swarmc("check", ".")
    assert done.code == 1
    assert "error[SW0018]: cannot search `.`: it has more than 1 MB of .swarm files" in done.out


def test_documents_that_are_too_large(project: Path, swarmc: Callable[..., Ran]) -> None:
    """Parsers of XML, JSON, YAML and TOML would fill the memory with them."""
    for name in ("large.toml", "large.scxml", "large.json", "package/config/large.yaml"):
        with (project / name).open("wb") as file:
            file.truncate(read_files.MOST_DATA + 1)
    for command in (
        "simulate model.swarm --scenario large.toml",
        "simulate large.scxml",
        "import scxml large.scxml",
        "import adf large.json",
        "import ros package",
        "test large.toml",
    ):
        done = swarmc(*command.split())
        assert done.code == 1
        assert "is larger than 2 MB" in done.out + done.err
