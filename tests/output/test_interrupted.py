"""Builds that are killed, at each file operation: the next one goes on, and loses nothing."""

from __future__ import annotations

import json
import os
import shutil
import sys
import warnings
from pathlib import Path

import pytest

from swarmdsl import output
from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics
from swarmdsl.codegen.api import OutputFile
from swarmdsl.codegen.user_code_marks import fits
from swarmdsl.output import WriteOptions, journal, write
from swarmdsl.output.apply import apply_plan
from swarmdsl.output.clean import clean
from swarmdsl.output.disk import Disk
from swarmdsl.output.plan import Plan

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="copies in a process of its own")

MINE = "line of mine"
CHANGES = {"os.mkdir", "os.rename", "os.remove", "os.rmdir", "os.chmod"}


def package(name: str, body: str = "pass") -> list[OutputFile]:
    """Files generated for an element: one to fill in, one with a region, one plain."""
    facts = (f"class {name}",)
    region = f"# swarmc:begin {name}.more\n# swarmc:end {name}.more\n"
    return [
        OutputFile(f"{name}/{name}.py", f"# {fits(facts)}\n{body}\n", True, name, facts=facts),
        OutputFile(f"{name}/list.txt", f"project {name}\n{region}", owner=name),
        OutputFile(f"{name}/base.py", f"class {name}\n1\n2\n3\n4\n{body}\n", owner=name),
    ]


BEFORE = [*package("rise"), *package("land"), *package("scan"), OutputFile("gone", "1")]
AFTER = [*package("climb", "new"), *package("land", "new"), OutputFile("deep/er/one", "1")]
RENAMES = (("rise", "climb"),)


def build(out: Path, files: list[OutputFile], **how: object) -> list[Diagnostic]:
    report = Diagnostics()
    write({"t": files}, out, report, WriteOptions(**how))  # type: ignore[arg-type]
    return list(report)


def edited(out: Path) -> Path:
    """An output folder in which a user has written into files of each kind."""
    build(out, BEFORE)
    for number, path in enumerate(
        ("rise/rise.py", "rise/base.py", "land/base.py", "scan/scan.py", "land/land.py")
    ):
        place = out / "t" / path
        place.write_text(f"{MINE} {number}\n{place.read_text()}", encoding="utf-8")
    place = out / "t/rise/list.txt"
    text = place.read_text().replace("# swarmc:end", f"{MINE} 5\n# swarmc:end")
    place.write_text(text, encoding="utf-8")
    (out / "t/rise/notes").write_text(f"{MINE} 6\n", encoding="utf-8")
    return out


def tree(out: Path) -> dict[str, bytes]:
    """All files but the texts of generated ones, which have two generations."""
    return {
        path.relative_to(out).as_posix(): path.read_bytes()
        for path in sorted(out.rglob("*"))
        if path.is_file() and path.name != ".swarmdsl.texts"
    }


def lines(out: Path) -> set[str]:
    """The lines of the user, wherever they are, but for what waits to be put in its place."""
    return {
        line
        for path, content in tree(out).items()
        for line in content.decode(errors="replace").splitlines()
        if line.startswith(MINE) and ".swarmc-" not in path
    }


def killed(out: Path, into: Path, *wanted: OutputFile, **how: object) -> list[Path]:
    """The folder as it is before each file operation of a build: so a kill leaves it there.

    It is copied in a process of its own, which the hook for that ends with.
    """
    copying, number = False, 0
    into.mkdir()

    def copy(event: str, arguments: tuple[object, ...]) -> None:
        nonlocal copying, number
        writes = event == "open" and isinstance(arguments[2], int) and arguments[2] & os.O_CREAT
        if not copying and (event in CHANGES or writes):
            copying = True
            shutil.copytree(out, into / f"{number:03}")
            copying, number = False, number + 1

    with warnings.catch_warnings():
        # A worker of pytest-xdist has a thread that receives messages; the child does not need it.
        warnings.simplefilter("ignore", DeprecationWarning)
        child = os.fork()
    if child == 0:
        sys.addaudithook(copy)
        build(out, list(wanted), **how)
        os._exit(0)
    assert os.waitpid(child, 0)[1] == 0
    return sorted(into.iterdir())


@pytest.fixture(scope="module")
def kills(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """Kills of a build that makes, changes, moves, parks and removes files."""
    folder = tmp_path_factory.mktemp("kills")
    states = killed(edited(folder / "out"), folder / "states", *AFTER, renames=RENAMES)
    assert len(states) > 40
    return states


def test_a_killed_rename_goes_on(kills: list[Path], tmp_path: Path) -> None:
    """With the same command, or without the rename as soon as anything has moved."""
    for name in ("never", "whole"):
        edited(tmp_path / name)
    build(tmp_path / "whole", AFTER, renames=RENAMES)
    build(tmp_path / "never", AFTER)
    whole, never = tree(tmp_path / "whole"), tree(tmp_path / "never")
    mine = lines(tmp_path / "whole")
    assert len(mine) == 7
    states = set()
    for state in kills:
        assert lines(state) == mine, state
        moved = any(path.endswith(("/climb.py", "/deep/er/one")) for path in tree(state))
        plain, same = tmp_path / f"plain{state.name}", tmp_path / f"same{state.name}"
        for out in (plain, same):
            shutil.copytree(state, out)
        build(plain, AFTER)
        now = tree(plain)
        assert now in (whole, never), state
        assert now == whole or not moved
        states.add(now == whole)
        found = build(same, AFTER, renames=RENAMES)
        assert "bad-rename" not in {each.name for each in found}, state
        assert tree(same) == whole, state
    assert states == {False, True}


def test_what_is_edited_after_a_kill_stays(kills: list[Path], tmp_path: Path) -> None:
    for state in kills[::2]:
        out = shutil.copytree(state, tmp_path / state.name)
        late = 0
        for path in tree(out):
            if "/" in path and ".swarmc-" not in path:
                late += 1
                with (out / path).open("a", encoding="utf-8") as file:
                    file.write(f"{MINE}, late {late}\n")
        there = lines(out)
        for _ in range(2):
            build(out, AFTER)
            assert lines(out) == there, state


@pytest.mark.parametrize("lost", ["t/gone", ".swarmdsl.texts"])
def test_a_list_that_stays_as_it_is_outlives_a_kill(tmp_path: Path, lost: str) -> None:
    """As where a file was deleted that is generated again: the list names it already."""
    out = edited(tmp_path / "out")
    build(out, BEFORE)
    mine, listed = lines(out), (out / ".swarmdsl.json").read_bytes()
    (out / lost).unlink()
    states = killed(out, tmp_path / "kills", *BEFORE)
    assert len(states) > 4
    for state in states:
        build(state, BEFORE)
        assert (state / ".swarmdsl.json").read_bytes() == listed, state
        assert (state / lost).exists()
        assert lines(state) == mine
        assert list(state.rglob(".swarmc-*")) == []


def test_a_second_kill_loses_nothing(kills: list[Path], tmp_path: Path) -> None:
    """After the first kill, the user creates files at the targets of moves."""
    first = next(state for state in kills if (state / "t/climb/climb.py").exists())
    before = kills[kills.index(first) - 1]
    out = shutil.copytree(before, tmp_path / "out")
    filled = [f"t/climb/{name}" for name in ("climb.py", "base.py", "list.txt", "notes")]
    for number, path in enumerate([*filled, ".parked/t/scan/scan.py"]):
        (out / path).parent.mkdir(parents=True, exist_ok=True)
        (out / path).write_text(f"{MINE}, late {number}\n", encoding="utf-8")
    mine = lines(out)
    for state in killed(out, tmp_path / "kills", *AFTER):
        build(state, AFTER)
        assert lines(state) == mine, state


def test_what_is_half_written_is_not_put_in_place(kills: list[Path], tmp_path: Path) -> None:
    """As after a loss of power, which takes away what was not on the disk yet."""
    for state in kills[::2]:
        out = shutil.copytree(state, tmp_path / state.name)
        mine = lines(out)
        for path in out.rglob(".swarmc-*"):
            path.write_bytes(path.read_bytes()[:3])
        build(out, AFTER)
        assert lines(out) == mine, state
        assert list(out.rglob(".swarmc-*")) == []


def test_a_clean_completes_what_was_interrupted_first(kills: list[Path], tmp_path: Path) -> None:
    for state in kills[::2]:
        out = shutil.copytree(state, tmp_path / state.name)
        mine = lines(out)
        clean(out, (), Diagnostics(), dry=False)
        assert lines(out) == mine, state
        assert list(out.rglob(".swarmc-*")) == []
        assert not (out / journal.NAME).exists()


def test_what_writes_nothing_says_that_a_build_was_interrupted(
    kills: list[Path], tmp_path: Path
) -> None:
    out = tmp_path / "out"
    shutil.copytree(next(each for each in kills if (each / "t/deep/er/one").exists()), out)
    before = tree(out)
    for how in ("check", "dry"):
        (found,) = build(out, AFTER, **{how: True})
        assert found.name == "interrupted-build"
    assert clean(out, (), Diagnostics(), dry=True) is None
    assert tree(out) == before
    build(out, AFTER)
    assert {each.name for each in build(out, AFTER, dry=True)} == {"edited-output"}


@pytest.mark.parametrize("content", ["", "{", "[]", '{"steps": [], "renames": []}', '{"steps": 3}'])
def test_a_journal_that_is_none_goes(tmp_path: Path, content: str) -> None:
    build(tmp_path, BEFORE)
    before = tree(tmp_path)
    (tmp_path / journal.NAME).write_text(content, encoding="utf-8")

    assert build(tmp_path, BEFORE) == []
    assert tree(tmp_path) == before


def test_a_journal_is_not_written_through_a_link(tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.mkdir()
    (out / journal.NAME).symlink_to(tmp_path / "elsewhere")

    assert build(out, BEFORE) == []
    assert not (tmp_path / "elsewhere").exists()
    assert not (out / journal.NAME).is_symlink()


@pytest.fixture
def half_way(kills: list[Path], tmp_path: Path) -> Path:
    """A build that is killed when the first files were moved."""
    first = next(state for state in kills if (state / "t/climb/climb.py").exists())
    return shutil.copytree(first, tmp_path / "half_way")


def test_a_moved_file_that_is_deleted_after_a_kill_is_no_obstacle(tmp_path: Path) -> None:
    """It took the place of one that was generated under the new name before."""
    out = edited(tmp_path / "out")
    build(out, AFTER)
    states = killed(out, tmp_path / "kills", *AFTER, renames=RENAMES)
    parked = ".parked/t/rise/rise.py"
    moved = [state for state in states if MINE in (state / "t/climb/climb.py").read_text()]
    state = next(state for state in moved if (state / parked).exists())
    (state / "t/climb/climb.py").unlink()
    assert "cannot-write" not in {each.name for each in build(state, AFTER)}
    assert not (state / journal.NAME).exists()
    assert MINE in (state / parked).read_text()


def test_what_stands_in_the_way_of_the_rest_is_told(half_way: Path) -> None:
    obstacle = half_way / "t/deep/er/one"
    obstacle.unlink(missing_ok=True)
    obstacle.mkdir(parents=True)
    for _ in range(2):
        (found,) = build(half_way, AFTER)
        assert found.name == "cannot-write"
        assert str(obstacle) in found.message
    obstacle.rmdir()
    build(half_way, AFTER)
    assert obstacle.read_text() == "1"


def test_a_folder_in_place_of_the_journal_is_told(tmp_path: Path) -> None:
    (tmp_path / journal.NAME).mkdir()
    (found,) = build(tmp_path, BEFORE)
    assert (found.name, bool(found.help)) == ("cannot-write", True)


def test_the_rest_waits_for_a_list_that_can_be_read(half_way: Path) -> None:
    place = half_way / ".swarmdsl.json"
    listed = place.read_bytes()
    place.write_bytes(b"<<<<<<< mine\n" + listed)
    before = tree(half_way)
    (found,) = build(half_way, AFTER)
    assert found.name == "unreadable-list"
    assert tree(half_way) == before
    place.write_bytes(listed)
    assert "unreadable-list" not in {each.name for each in build(half_way, AFTER)}
    assert not (half_way / journal.NAME).exists()


@pytest.mark.parametrize("path", ["t/land/base.py", "t/rise/notes", "t/climb/list.txt"])
def test_what_is_saved_while_a_build_decides_stays(
    tmp_path: Path, path: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Be it a file that changes, one that moves or one in the place for another."""
    out = edited(tmp_path)

    def save_first(plan: Plan) -> None:
        place = out / path
        place.parent.mkdir(parents=True, exist_ok=True)
        with place.open("a", encoding="utf-8") as file:
            file.write(f"{MINE}, saved\n")
        apply_plan(plan)

    monkeypatch.setattr(output, "apply_plan", save_first)
    found = [
        each.message for each in build(out, AFTER, renames=RENAMES) if each.name == "cannot-write"
    ]
    assert f"{MINE}, saved" in lines(out)
    assert len(lines(out)) == 8
    told = path != "t/rise/notes"  # which is there under both names
    assert len(found) == told
    monkeypatch.undo()
    build(out, AFTER)
    assert len(lines(out)) == 8


@pytest.mark.parametrize("path", ["../victim", "t/link/victim", "/victim", None])
@pytest.mark.parametrize("field", ["path", "staged", "source"])
def test_a_journal_cannot_change_files_outside(
    tmp_path: Path, path: str | None, field: str
) -> None:
    out, victim = tmp_path / "out", tmp_path / "victim"
    build(out, BEFORE)
    victim.write_text("1", encoding="utf-8")
    (out / "t/link").symlink_to(tmp_path)
    one = journal.fingerprint(b"1")
    step = {"path": "t/gone", "before": one, "after": one, "staged": "t/s", "source": "t/x"}
    step |= {"of_source": one, field: str(victim) if path == "/victim" else path}
    listed = journal.Step(".swarmdsl.json", None, one, "t/listed")
    text = journal.to_bytes(journal.Journal((journal.Step(**step),), listed))  # type: ignore[arg-type]
    (out / journal.NAME).write_bytes(text)
    (out / "t/listed").write_text("1", encoding="utf-8")

    assert (journal.read(Disk(out)) is None) == (path is not None or field == "path")
    assert build(out, BEFORE) == []
    assert victim.read_text() == "1"
    assert json.loads((out / ".swarmdsl.json").read_text())["files"]
