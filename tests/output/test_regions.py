"""Regions of generated files that are the user's: kept wherever they move, never lost unasked."""

from pathlib import Path

import pytest

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.generator import OutputFile
from swarmdsl.manifest import NAME
from swarmdsl.output import Written, write

FIRST = "one\n# swarmc:begin m.a\n# swarmc:end m.a\ntwo\n# swarmc:begin m.b\n# swarmc:end m.b\n"
MOVED = "new\n# swarmc:begin m.b\n# swarmc:end m.b\n1\n# swarmc:begin m.a\n# swarmc:end m.a\n"


def build(text: str | None, out: Path, **options: bool) -> tuple[Written | None, list[str]]:
    report = Diagnostics()
    files = [] if text is None else [OutputFile("f", text)]
    written = write({"t": files}, out, report, **options)
    return written, [found.message.replace(out.as_posix(), "OUT") for found in report]


def edit(out: Path, old: str, new: str) -> None:
    path = out / "t/f"
    text = path.read_text()
    assert text.count(old) == 1
    path.write_text(text.replace(old, new))


@pytest.fixture
def out(tmp_path: Path) -> Path:
    """An output folder in which a user has written into both regions."""
    assert build(FIRST, tmp_path)[1] == []
    edit(tmp_path, "# swarmc:end m.a", "mine\n\n  é\n# swarmc:end m.a")
    edit(tmp_path, "# swarmc:end m.b", "b\n# swarmc:end m.b")
    return tmp_path


def test_what_is_in_them_is_not_an_edit(out: Path) -> None:
    before = (out / "t/f").read_bytes()
    written, said = build(FIRST, out)

    assert said == []
    assert written is not None
    assert written.unchanged == ("t/f",)
    assert (out / "t/f").read_bytes() == before


def test_they_move_with_their_marks(out: Path) -> None:
    assert build(MOVED, out)[1] == []
    text = (
        "new\n# swarmc:begin m.b\nb\n# swarmc:end m.b\n"
        "1\n# swarmc:begin m.a\nmine\n\n  é\n# swarmc:end m.a\n"
    )
    assert (out / "t/f").read_text() == text
    written, said = build(MOVED, out)
    assert said == []
    assert written is not None
    assert written.unchanged == ("t/f",)


def test_an_edit_outside_is_found(out: Path) -> None:
    edit(out, "two", "2")

    assert build(MOVED, out)[1] == ["`OUT/t/f` would be overwritten, but it has been edited"]
    assert build(MOVED, out, force=True)[1] == []
    assert "\nmine\n" in (out / "t/f").read_text()


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ("# swarmc:end m.a\n", "", "region `m.b` begins inside region `m.a`"),
        ("# swarmc:begin m.a\n", "", "region `m.a` ends where it has not begun"),
        ("# swarmc:end m.b\n", "", "region `m.b` has no end"),
        (
            "b\n# swarmc:end m.b\n",
            "# swarmc:end m.b\n# swarmc:begin m.b\n",
            "there are two regions `m.b`",
        ),
    ],
)
def test_marks_that_were_damaged_are_reported(out: Path, old: str, new: str, reason: str) -> None:
    edit(out, old, new)
    before = (out / "t/f").read_bytes()

    assert build(MOVED, out) == (None, [f"`OUT/t/f` would be overwritten, but {reason}"])
    assert (out / "t/f").read_bytes() == before


def test_a_region_that_is_gone_is_not_lost(out: Path) -> None:
    without = FIRST.replace("# swarmc:begin m.a\n# swarmc:end m.a\n", "")
    reason = "region `m.a` has lines of yours, and is not part of it any more"

    assert build(without, out) == (None, [f"`OUT/t/f` would be overwritten, but {reason}"])
    edit(out, "mine\n\n  é\n", "\n")
    assert build(without, out)[1] == []


def test_a_file_that_is_not_made_any_more_stays_with_what_is_in_it(out: Path) -> None:
    written, said = build(None, out)

    assert said == []
    assert written is not None
    assert written.left == ("t/f",)
    assert "mine" in (out / "t/f").read_text()


def test_without_lines_of_the_user_it_goes(tmp_path: Path) -> None:
    build(FIRST, tmp_path)
    build(None, tmp_path)

    assert sorted(path.name for path in tmp_path.iterdir()) == [NAME]


def test_marks_in_a_text_that_are_none_do_no_harm(tmp_path: Path) -> None:
    text = "see swarmc:begin x for more\n"
    assert build(text, tmp_path)[1] == []
    assert build(text + "more\n", tmp_path)[1] == []
    assert (tmp_path / "t/f").read_text() == text + "more\n"
