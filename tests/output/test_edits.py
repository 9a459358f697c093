"""Edits of generated files: merged, told where they are in conflict, never lost."""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.codegen.api import OutputFile
from swarmdsl.output import Action, texts

from .builds import build, names, plain, text, tree


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
    assert found.notes == ("one change of the generator merged into it",)


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
    assert notes.message == f"generated file `{beside}` has been edited"
    assert notes.notes == ("it does not have the latest generated content",)
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

    assert (found.name, found.notes) == (
        "merge-conflict",
        ("the version that it was generated from is unknown",),
    )
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
