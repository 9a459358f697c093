"""Generated files that somebody has edited: merged, told, put aside, moved; never lost."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from swarmdsl.diagnostics import Diagnostic, Diagnostics
from swarmdsl.fitting_code import fits
from swarmdsl.generator import OutputFile
from swarmdsl.output import Action, How, Written, texts, write
from swarmdsl.output.clean import clean

LINES = [f"line {number}\n" for number in range(1, 10)]


def text(**changes: str) -> str:
    """Nine lines, some of them changed: `text(l3="x")`."""
    lines = list(LINES)
    for name, line in changes.items():
        lines[int(name[1:]) - 1] = line
    return "".join(lines)


def build(out: Path, *files: OutputFile, **how: object) -> tuple[Written | None, list[Diagnostic]]:
    report = Diagnostics()
    written = write({"t": files}, out, report, How(**how))  # type: ignore[arg-type]
    return written, list(report)


def names(found: tuple[Written | None, list[Diagnostic]]) -> list[str]:
    return [each.name for each in found[1]]


def tree(out: Path) -> dict[str, str]:
    """All files but the lists of swarmc."""
    return {
        path.relative_to(out).as_posix(): path.read_text(encoding="utf-8")
        for path in out.rglob("*")
        if path.is_file() and not path.name.startswith(".swarmdsl")
    }


def plain(content: str) -> OutputFile:
    return OutputFile("f", content)


def skeleton(name: str, *facts: str, body: str = "pass") -> list[OutputFile]:
    """The package of an element: one file to fill in, and one that is generated."""
    cls = name.capitalize()
    facts = (f"class {cls}", *facts)
    mine = f"# {fits(facts)}\nfrom {name}.base import {cls}Base\nclass {cls}({cls}Base):\n {body}\n"
    return [
        OutputFile(f"{name}/{name}.py", mine, keep=True, owner=name, facts=facts),
        OutputFile(f"{name}/base.py", f"class {cls}Base:\n  {len(facts)}\n", owner=name),
    ]


# ---- merges


def test_what_changes_elsewhere_is_merged(tmp_path: Path) -> None:
    build(tmp_path, plain(text()))
    (tmp_path / "t/f").write_text(text(l2="mine\n"), encoding="utf-8")
    written, (found,) = build(tmp_path, plain(text(l8="new\n")))

    assert written is not None
    assert written.paths(Action.MERGE) == ("t/f",)
    assert tree(tmp_path) == {"t/f": text(l2="mine\n", l8="new\n")}
    assert found.name == "edited-output"
    assert found.primary is not None
    assert (found.primary.span.line, found.primary.span.text) == (2, "mine")
    assert found.notes == ("one change of what is generated merged into it",)


def test_after_a_merge_the_same_model_changes_nothing(tmp_path: Path) -> None:
    build(tmp_path, plain(text()))
    (tmp_path / "t/f").write_text(text(l2="mine\n"), encoding="utf-8")
    for content in (text(l8="new\n"), text(l8="new\n"), text(l9="newer\n"), text(l9="newer\n")):
        build(tmp_path, plain(content))
    stamps = {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*")}
    written, _ = build(tmp_path, plain(text(l9="newer\n")))

    assert written is not None
    assert (written.changes, written.edited) == ((), ("t/f",))
    assert tree(tmp_path) == {"t/f": text(l2="mine\n", l9="newer\n")}
    assert {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*")} == stamps


@pytest.fixture
def conflict(tmp_path: Path) -> Path:
    """An output folder with a conflict in line 2."""
    build(tmp_path, plain(text()), OutputFile("g", "1"))
    (tmp_path / "t/f").write_text(text(l2="mine\n"), encoding="utf-8")
    _, (found,) = build(tmp_path, plain(text(l2="new\n")), OutputFile("g", "2"))
    assert found.name == "merge-conflict"
    assert found.primary is not None
    assert (found.primary.span.line, found.primary.span.text) == (2, "mine")
    return tmp_path


def test_a_conflict_leaves_the_file_and_puts_the_new_one_beside_it(conflict: Path) -> None:
    expected = {"t/f": text(l2="mine\n"), "t/f.swarmc-new": text(l2="new\n"), "t/g": "2"}
    assert tree(conflict) == expected
    for _ in range(2):
        again = build(conflict, plain(text(l2="new\n")), OutputFile("g", "2"))
        assert names(again) == ["merge-conflict"]
        assert again[0] is not None
        assert again[0].changes == ()
        assert tree(conflict) == expected


def test_a_conflict_ends_when_the_new_text_is_taken_over(conflict: Path) -> None:
    (conflict / "t/f").write_text(text(l2="new\n", l9="mine\n"), encoding="utf-8")

    assert names(build(conflict, plain(text(l2="new\n")))) == ["edited-output"]
    assert tree(conflict) == {"t/f": text(l2="new\n", l9="mine\n")}


def test_a_conflict_ends_when_the_new_text_is_deleted(conflict: Path) -> None:
    (conflict / "t/f.swarmc-new").unlink()

    for _ in range(2):
        assert names(build(conflict, plain(text(l2="new\n")))) == ["edited-output"]
    assert tree(conflict) == {"t/f": text(l2="mine\n")}
    build(conflict, plain(text(l2="new\n", l8="newer\n")))
    assert tree(conflict) == {"t/f": text(l2="mine\n", l8="newer\n")}


def test_a_conflict_ends_when_the_new_text_is_moved_over(conflict: Path) -> None:
    (conflict / "t/f.swarmc-new").replace(conflict / "t/f")

    assert names(build(conflict, plain(text(l2="new\n")))) == []
    assert tree(conflict) == {"t/f": text(l2="new\n")}


def test_a_conflict_ends_when_the_edit_is_given_up(conflict: Path) -> None:
    written, found = build(conflict, plain(text(l2="new\n")), force=True)

    assert written is not None
    assert written.paths(Action.OVERWRITE) == ("t/f",)
    assert found == []
    assert tree(conflict) == {"t/f": text(l2="new\n")}


def test_an_edited_text_beside_a_file_is_not_overwritten_which_is_told(conflict: Path) -> None:
    beside = conflict / "t/f.swarmc-new"
    beside.write_text("my notes\n", encoding="utf-8")

    _, (notes, _) = build(conflict, plain(text(l2="newer\n")))
    assert notes.message == f"`{beside}` is generated, and has been edited"
    assert notes.notes == ("what is generated now is not in it",)
    assert tree(conflict)["t/f.swarmc-new"] == "my notes\n"
    (conflict / "t/f").write_text(text(l2="newer\n"), encoding="utf-8")
    build(conflict, plain(text(l2="newer\n")))
    assert tree(conflict) == {
        "t/f": text(l2="newer\n"),
        ".parked/t/f.swarmc-new": "my notes\n",
    }


def test_an_edited_text_beside_a_file_that_is_taken_over_is_older_than_what_is_new(
    conflict: Path,
) -> None:
    """Else the change of line 8, which nobody has seen, were lost."""
    beside = conflict / "t/f.swarmc-new"
    beside.write_text(text(l2="new, and mine\n"), encoding="utf-8")
    for _ in range(2):
        build(conflict, plain(text(l2="new\n", l8="newer\n")))
    beside.replace(conflict / "t/f")

    assert names(build(conflict, plain(text(l2="new\n", l8="newer\n")))) == ["edited-output"]
    assert tree(conflict) == {"t/f": text(l2="new, and mine\n", l8="newer\n")}


def test_without_the_texts_there_is_no_merge(tmp_path: Path) -> None:
    build(tmp_path, plain(text()))
    (tmp_path / "t/f").write_text(text(l2="mine\n"), encoding="utf-8")
    (tmp_path / texts.NAME).unlink()
    _, (found,) = build(tmp_path, plain(text(l8="new\n")))

    assert (found.name, found.notes) == ("merge-conflict", ("what it was made from is not known",))
    assert tree(tmp_path)["t/f"] == text(l2="mine\n")
    assert tree(tmp_path)["t/f.swarmc-new"] == text(l8="new\n")


def test_what_is_no_text_is_not_lost(tmp_path: Path) -> None:
    build(tmp_path, plain(text()))
    (tmp_path / "t/f").write_bytes(b"\xff\x00\r\nmine")
    build(tmp_path, plain(text(l8="new\n")))

    assert (tmp_path / "t/f").read_bytes() == b"\xff\x00\r\nmine"


def of_windows(content: str) -> bytes:
    return content.replace("\n", "\r\n").encode()


def test_other_line_ends_are_no_edit_and_stay(tmp_path: Path) -> None:
    build(tmp_path, plain(text()))
    (tmp_path / "t/f").write_bytes(of_windows(text()))

    written, found = build(tmp_path, plain(text()))
    assert (written and written.changes, found) == ((), [])
    assert names(build(tmp_path, plain(text(l2="new\n")))) == []
    assert (tmp_path / "t/f").read_bytes() == of_windows(text(l2="new\n"))


def test_a_merge_keeps_other_line_ends(tmp_path: Path) -> None:
    build(tmp_path, plain(text()))
    (tmp_path / "t/f").write_bytes(of_windows(text(l2="mine\n")))

    assert names(build(tmp_path, plain(text(l8="new\n")))) == ["edited-output"]
    assert (tmp_path / "t/f").read_bytes() == of_windows(text(l2="mine\n", l8="new\n"))
    # One line that an editor has left with its old end is no conflict either.
    mixed = of_windows(text(l2="mine\n", l8="new\n")).replace(b"line 4\r\n", b"line 4\n")
    (tmp_path / "t/f").write_bytes(mixed)
    assert names(build(tmp_path, plain(text(l8="newer\n")))) == ["edited-output"]
    assert (tmp_path / "t/f").read_bytes() == mixed.replace(b"new\r\n", b"newer\r\n")


def test_what_is_beside_a_conflict_has_the_line_ends_of_the_file(tmp_path: Path) -> None:
    build(tmp_path, plain(text()))
    (tmp_path / "t/f").write_bytes(of_windows(text(l2="mine\n")))

    assert names(build(tmp_path, plain(text(l2="new\n")))) == ["merge-conflict"]
    assert (tmp_path / "t/f.swarmc-new").read_bytes() == of_windows(text(l2="new\n"))


# ---- files to fill in


def test_a_file_to_fill_in_follows_the_model_until_it_is_edited(tmp_path: Path) -> None:
    build(tmp_path, *skeleton("rise"))
    assert names(build(tmp_path, *skeleton("rise", "goal.height : float64"))) == []
    file = tmp_path / "t/rise/rise.py"
    assert file.read_text().startswith(f"# {fits(['class Rise', 'goal.height : float64'])}\n")
    file.write_text(file.read_text() + "mine\n", encoding="utf-8")
    _, (found,) = build(tmp_path, *skeleton("rise", "goal.height : float32", body="return 1"))

    assert found.name == "outdated-code"
    assert found.notes[:2] == ("- goal.height : float64", "+ goal.height : float32")
    assert file.read_text().endswith("mine\n")
    note = tree(tmp_path)["t/rise/rise.py.swarmc-changes"]
    assert "\n    - goal.height : float64\n    + goal.height : float32\n" in note
    assert "\n- pass\n+ return 1\n" in note.replace("-  pass", "- pass").replace(
        "+  return", "+ return"
    )
    # With the new mark the note goes.
    new = fits(["class Rise", "goal.height : float32"])
    old = fits(["class Rise", "goal.height : float64"])
    file.write_text(file.read_text().replace(old, new), encoding="utf-8")
    assert names(build(tmp_path, *skeleton("rise", "goal.height : float32", body="return 1"))) == []
    assert set(tree(tmp_path)) == {"t/rise/rise.py", "t/rise/base.py"}


@pytest.mark.parametrize("texts_there", [True, False], ids=["texts", "no texts"])
def test_a_file_without_its_mark_is_still_known_to_be_outdated(
    tmp_path: Path, texts_there: bool
) -> None:
    build(tmp_path, *skeleton("rise", "goal.height : float64"))
    file = tmp_path / "t/rise/rise.py"
    old = file.read_text()
    mine = old[old.index("\n") + 1 :] + "mine\n"
    file.write_text(mine, encoding="utf-8")
    assert names(build(tmp_path, *skeleton("rise", "goal.height : float64"))) == []
    if not texts_there:
        (tmp_path / texts.NAME).unlink()
    for _ in range(2):
        _, (found,) = build(tmp_path, *skeleton("rise", "goal.height : float32"))
        assert found.name == "outdated-code"
        assert "- goal.height : float64" in found.notes or not texts_there
    mark = fits(["class Rise", "goal.height : float32"])
    assert f"a comment with `{mark}`" in str(found.help)
    file.write_text(f"{mine}# {mark}\n", encoding="utf-8")
    assert names(build(tmp_path, *skeleton("rise", "goal.height : float32"))) == []


def test_what_was_filled_in_is_put_aside_and_comes_back(tmp_path: Path) -> None:
    build(tmp_path, *skeleton("rise"), *skeleton("land"))
    file = tmp_path / "t/rise/rise.py"
    file.chmod(0o640)
    file.write_text(file.read_text() + "mine\n", encoding="utf-8")
    mine = file.read_text()
    assert names(build(tmp_path, *skeleton("land"))) == ["parked-code"]
    assert set(tree(tmp_path)) == {".parked/t/rise/rise.py", "t/land/land.py", "t/land/base.py"}
    for _ in range(2):
        assert names(build(tmp_path, *skeleton("land"))) == []
    written, found = build(tmp_path, *skeleton("rise"), *skeleton("land"))

    assert written is not None
    assert (found, written.paths(Action.RESTORE)) == ([], ("t/rise/rise.py",))
    assert file.read_text() == mine
    assert file.stat().st_mode & 0o777 == 0o640
    assert not (tmp_path / ".parked").exists()


def test_two_that_are_put_aside_under_one_name(tmp_path: Path) -> None:
    for mine in ("one", "two"):
        build(tmp_path, plain("1"))
        (tmp_path / "t/f").write_text(mine, encoding="utf-8")
        aside = tmp_path / ".parked/t/f"
        if mine == "two":
            aside.parent.mkdir(parents=True, exist_ok=True)
            aside.write_text("one", encoding="utf-8")
        build(tmp_path)
        if mine == "one":
            aside.unlink()
    assert tree(tmp_path) == {".parked/t/f": "one", ".parked/t/f.1": "two"}


# ---- other names


def test_a_new_name_is_recognized(tmp_path: Path) -> None:
    build(tmp_path, *skeleton("rise", "input pose: Pose"))
    file = tmp_path / "t/rise/rise.py"
    file.write_text(file.read_text() + "mine\n", encoding="utf-8")
    climb = skeleton("climb", "input pose: Pose")
    land = skeleton("land", "input state: State")
    found = build(tmp_path, *climb, *land, command="swarmc build m.swarm")

    assert names(found) == ["parked-code", "renamed-element"]
    assert found[1][1].message == "`climb` looks like `rise` under another name"
    assert "`swarmc build m.swarm --rename rise=climb`" in str(found[1][1].help)
    assert names(build(tmp_path, *climb, *land)) == []


def test_what_may_be_two_is_not_guessed(tmp_path: Path) -> None:
    build(tmp_path, *skeleton("rise"))
    file = tmp_path / "t/rise/rise.py"
    file.write_text(file.read_text() + "mine\n", encoding="utf-8")

    assert names(build(tmp_path, *skeleton("climb"), *skeleton("land"))) == ["parked-code"]


@pytest.mark.parametrize("before", [False, True], ids=["at once", "after a build"])
def test_files_move_to_the_new_name(tmp_path: Path, before: bool) -> None:
    build(tmp_path, *skeleton("rise"))
    folder = tmp_path / "t/rise"
    mine = (folder / "rise.py").read_text().replace(" pass", " def rise(self): pass  # Rise")
    (folder / "rise.py").write_text(f"import math\n{mine}", encoding="utf-8")
    (folder / "base.py").write_text("class RiseBase:\n  1\n\n\n# mine\n", encoding="utf-8")
    (folder / "more_rise.txt").write_text("all mine\n", encoding="utf-8")
    (folder / "more_climb.txt").write_text("mine too\n", encoding="utf-8")
    if before:
        build(tmp_path, *skeleton("climb"))
    written, found = build(tmp_path, *skeleton("climb"), renames=(("rise", "climb"),))

    assert written is not None
    assert tree(tmp_path) == {
        "t/climb/climb.py": (
            f"import math\n# {fits(['class Climb'])}\nfrom climb.base import ClimbBase\n"
            "class Climb(ClimbBase):\n def rise(self): pass  # Climb\n"
        ),
        "t/climb/base.py": "class ClimbBase:\n  1\n\n\n# mine\n",
        "t/climb/more_climb.txt": "mine too\n",
        "t/rise/more_rise.txt": "all mine\n",
    }
    told = {each.name: each for each in found}
    assert set(told) == {"edited-output", "old-name"}
    place = told["old-name"].primary
    assert place is not None
    assert (place.span.line, place.span.text) == (5, "rise")
    assert told["old-name"].help == "write `climb` where the element is meant; this is told once"
    # Of the next build nothing of this is left.
    again, found = build(tmp_path, *skeleton("climb"))
    assert again is not None
    assert again.changes == ()
    assert [each.name for each in found] == ["edited-output"]


def test_regions_move_to_the_new_name(tmp_path: Path) -> None:
    def file(name: str) -> OutputFile:
        marks = f"# swarmc:begin {name}.more\n# swarmc:end {name}.more\n"
        return OutputFile(f"{name}/CMakeLists.txt", f"project({name})\n{marks}", owner=name)

    build(tmp_path, file("rise"))
    place = tmp_path / "t/rise/CMakeLists.txt"
    place.write_text(place.read_text().replace("# swarmc:end", "mine\n# swarmc:end"), "utf-8")
    _, found = build(tmp_path, file("climb"), renames=(("rise", "climb"),))

    assert found == []
    assert tree(tmp_path) == {
        "t/climb/CMakeLists.txt": (
            "project(climb)\n# swarmc:begin climb.more\nmine\n# swarmc:end climb.more\n"
        )
    }


@pytest.mark.parametrize(
    ("rename", "fault"),
    [
        (("rise", "clim"), "nothing is generated for `clim`"),
        (("ris", "climb"), "nothing was generated for `ris`"),
        (("land", "climb"), "the model still has `land`"),
    ],
)
def test_a_rename_that_cannot_be_meant(tmp_path: Path, rename: tuple[str, str], fault: str) -> None:
    build(tmp_path, *skeleton("rise"), *skeleton("land"))
    before = tree(tmp_path)
    written, (found,) = build(tmp_path, *skeleton("climb"), *skeleton("land"), renames=(rename,))

    assert written is None
    assert found.name == "bad-rename"
    assert fault in found.message
    assert tree(tmp_path) == before


def test_a_rename_does_not_overwrite_what_was_filled_in(tmp_path: Path) -> None:
    build(tmp_path, *skeleton("rise"))
    (tmp_path / "t/rise/rise.py").write_text("mine\n", encoding="utf-8")
    build(tmp_path, *skeleton("climb"))
    (tmp_path / "t/climb/climb.py").write_text("mine too\n", encoding="utf-8")
    before = tree(tmp_path)
    written, (found,) = build(tmp_path, *skeleton("climb"), renames=(("rise", "climb"),))

    assert written is None
    assert found.name == "bad-rename"
    assert tree(tmp_path) == before


# ---- nothing is written, or only removed


def changed_output(out: Path) -> list[OutputFile]:
    """A folder in which something of each kind is the matter, and what is to be generated."""
    kept = OutputFile("kept", "1", keep=True)
    names = ("same", "stale", "edited", "merged", "gone", "parked", "missing")
    build(out, *(OutputFile(name, text()) for name in names), kept)
    for name in ("edited", "merged", "parked", "kept"):
        (out / "t" / name).write_text(text(l2="mine\n"), encoding="utf-8")
    (out / "t/missing").unlink()
    new = {"stale": text(l9="new\n"), "merged": text(l9="new\n")}
    wanted = ("same", "stale", "edited", "merged", "missing", "fresh")
    return [OutputFile(name, new.get(name, text())) for name in wanted] + [kept]


def test_a_check_says_what_is_the_matter_with_each_file(tmp_path: Path) -> None:
    files = changed_output(tmp_path)
    before = {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*")}
    _, found = build(tmp_path, *files, check=True)

    assert {each.name for each in found} == {"stale-output"}
    said = dict(each.message.replace(f"{tmp_path}/t/", "").split("` ") for each in found)
    assert {name.strip("`"): text.partition(":")[0] for name, text in said.items()} == {
        "stale": "is out of date",
        "edited": "has been edited",
        "merged": "has been edited, and is out of date",
        "gone": "is not generated any more",
        "parked": "is not generated any more, and has lines of yours",
        "missing": "is missing",
        "fresh": "is missing",
    }
    assert {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*")} == before


def test_after_a_build_a_check_finds_nothing(tmp_path: Path) -> None:
    files = [plain(text()), *skeleton("rise")]
    build(tmp_path, *files)

    assert names(build(tmp_path, *files, check=True)) == []


def test_a_dry_run_says_what_a_build_does(tmp_path: Path) -> None:
    files = changed_output(tmp_path)
    before = tree(tmp_path)
    dry, said = build(tmp_path, *files, dry=True)

    assert tree(tmp_path) == before
    assert dry is not None
    assert {change.path: change.action.value for change in dry.changes} == {
        "t/stale": "change",
        "t/merged": "merge",
        "t/gone": "remove",
        ".parked/t/parked": "park",
        "t/missing": "create",
        "t/fresh": "create",
    }
    done, told = build(tmp_path, *files)
    assert done == dry
    assert [each.message for each in told] == [each.message for each in said]
    for change in dry.changes:
        place = tmp_path / change.path
        assert (place.read_bytes() if place.exists() else None) == change.after


def test_clean_removes_what_is_as_it_was_generated(tmp_path: Path) -> None:
    build(tmp_path, *changed_output(tmp_path))
    (tmp_path / "t/mine").write_text("mine", encoding="utf-8")
    report = Diagnostics()
    dry = clean(tmp_path, (), report, dry=True)
    assert (tmp_path / "t/same").exists()
    assert clean(tmp_path, (), report, dry=False) == dry

    assert len(report) == 0
    assert set(tree(tmp_path)) == {"t/edited", "t/merged", "t/kept", "t/mine", ".parked/t/parked"}
    # What it knows of them it has not forgotten.
    assert names(build(tmp_path, OutputFile("edited", text(l9="new\n")))) == [
        "parked-code",
        "parked-code",
        "edited-output",
    ]
    assert tree(tmp_path)["t/edited"] == text(l2="mine\n", l9="new\n")


def test_clean_removes_what_was_generated_for_one_target(tmp_path: Path) -> None:
    write({"a": [plain("1")], "b": [plain("2")]}, tmp_path, Diagnostics())
    clean(tmp_path, ["a"], Diagnostics(), dry=False)
    assert tree(tmp_path) == {"b/f": "2"}
    clean(tmp_path, ["b"], Diagnostics(), dry=False)
    assert list(tmp_path.iterdir()) == []


def test_only_texts_that_are_needed_are_kept(tmp_path: Path) -> None:
    for number in range(4):
        build(tmp_path, plain(f"{number}" * 20), *skeleton("rise", f"fact {number}"))
    stored = texts.Texts(tmp_path)

    assert [bool(stored.knows((f"{n}" * 20).encode())) for n in range(4)] == [0, 0, 1, 1]
    assert json.loads((tmp_path / ".swarmdsl.json").read_text())["owners"]
