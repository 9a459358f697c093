"""Regions of generated files that are the user's: kept wherever they move, never lost unasked."""

from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import OutputFile
from swarmdsl.output import Action, WriteOptions, Written, texts, write
from swarmdsl.output.manifest import NAME

FIRST = "one\n# swarmc:begin m.a\n# swarmc:end m.a\ntwo\n# swarmc:begin m.b\n# swarmc:end m.b\n"
CONFLICT = "merge conflict in `OUT/t/f`: the generator changes edited lines"
MOVED = "new\n# swarmc:begin m.b\n# swarmc:end m.b\n1\n# swarmc:begin m.a\n# swarmc:end m.a\n"


def build(text: str | None, out: Path, **options: bool) -> tuple[Written | None, list[str]]:
    report = Diagnostics()
    files = [] if text is None else [OutputFile("f", text)]
    written = write({"t": files}, out, report, WriteOptions(**options))
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

    assert build(MOVED, out)[1] == [CONFLICT]
    assert "\n2\n" in (out / "t/f").read_text()
    assert "\nmine\n" in (out / "t/f.swarmc-new").read_text()
    assert build(MOVED, out, force=True)[1] == []
    assert "\nmine\n" in (out / "t/f").read_text()
    assert not (out / "t/f.swarmc-new").exists()


def test_an_edit_outside_is_merged_beside_them(out: Path) -> None:
    edit(out, "two", "2")
    text = (out / "t/f").read_text()

    assert build("zero\n" + FIRST, out)[1] == ["generated file `OUT/t/f` has been edited"]
    assert (out / "t/f").read_text() == "zero\n" + text


@pytest.mark.parametrize(
    ("old", "new", "fault", "line"),
    [
        ("# swarmc:end m.a\n", "", "region `m.b` begins inside region `m.a`", 7),
        ("# swarmc:begin m.a\n", "", "region `m.a` ends where it has not begun", 5),
        ("# swarmc:end m.b\n", "", "region `m.b` has no end", 8),
        (
            "b\n# swarmc:end m.b\n",
            "# swarmc:end m.b\n# swarmc:begin m.b\n",
            "region `m.b` begins a second time",
            10,
        ),
    ],
)
@pytest.mark.parametrize("options", [{}, {"force": True}], ids=str)
def test_damaged_marks_are_named_and_nothing_is_lost(
    out: Path, old: str, new: str, fault: str, line: int, options: dict[str, bool]
) -> None:
    edit(out, old, new)
    before = (out / "t/f").read_bytes()
    report = Diagnostics()
    write({"t": [OutputFile("f", FIRST)]}, out, report, WriteOptions(**options))

    (found,) = report
    assert found.name == "damaged-region"
    assert found.message == f"damaged region in `{out / 't/f'}`: {fault}"
    assert found.primary is not None
    assert found.primary.span.line == line
    assert build(MOVED, out, **options)[1] == [CONFLICT, f"damaged region in `OUT/t/f`: {fault}"]
    assert (out / "t/f").read_bytes() == before


def test_a_region_that_is_not_generated_is_named(out: Path) -> None:
    edit(out, "two\n", "two\n# swarmc:begin m.c\nmine too\n# swarmc:end m.c\n")
    report = Diagnostics()
    write({"t": [OutputFile("f", "zero\n" + FIRST)]}, out, report)

    (found,) = report
    assert found.message == f"damaged region in `{out / 't/f'}`: no region `m.c` is generated"
    assert found.help == "did you mean `m.b`?"
    assert found.primary is not None
    assert found.primary.span.text == "# swarmc:begin m.c"
    text = (out / "t/f").read_text()
    assert text.startswith("zero\n")
    assert "\nmine too\n" in text


def test_a_region_that_is_gone_is_not_lost(out: Path) -> None:
    without = FIRST.replace("# swarmc:begin m.a\n# swarmc:end m.a\n", "")

    for _ in range(2):
        assert build(without, out)[1] == [
            CONFLICT,
            "damaged region in `OUT/t/f`: no region `m.a` is generated",
        ]
        assert "\nmine\n" in (out / "t/f").read_text()
    edit(out, "mine\n\n  é\n", "\n")
    assert build(without, out)[1] == []


def test_force_does_not_take_what_is_in_a_region_that_is_gone(out: Path) -> None:
    without = FIRST.replace("# swarmc:begin m.a\n# swarmc:end m.a\n", "")

    assert (
        "damaged region in `OUT/t/f`: no region `m.a` is generated"
        in build(without, out, force=True)[1]
    )
    assert "\nmine\n" in (out / "t/f").read_text()


def test_regions_in_a_file_with_other_line_ends(out: Path) -> None:
    of_user = (out / "t/f").read_bytes().replace(b"\n", b"\r\n")
    (out / "t/f").write_bytes(of_user)
    assert build(FIRST, out)[1] == []
    assert (out / "t/f").read_bytes() == of_user

    assert build("zero\n" + FIRST, out)[1] == []
    assert (out / "t/f").read_bytes() == b"zero\r\n" + of_user


def test_a_file_that_is_not_made_any_more_is_put_aside_with_what_is_in_it(out: Path) -> None:
    written, said = build(None, out)

    assert said == ["`OUT/t/f` is parked: it is no longer generated"]
    assert written is not None
    assert written.paths(Action.PARK) == (".parked/t/f",)
    assert not (out / "t/f").exists()
    assert build(MOVED, out)[1] == []
    assert "\nmine\n" in (out / "t/f").read_text()
    assert not (out / ".parked").exists()


def test_without_lines_of_the_user_it_goes(tmp_path: Path) -> None:
    build(FIRST, tmp_path)
    build(None, tmp_path)

    assert sorted(path.name for path in tmp_path.iterdir()) == [NAME, texts.NAME]


def test_marks_in_a_text_that_are_none_do_no_harm(tmp_path: Path) -> None:
    text = "see swarmc:begin x for more\n"
    assert build(text, tmp_path)[1] == []
    assert build(text + "more\n", tmp_path)[1] == []
    assert (tmp_path / "t/f").read_text() == text + "more\n"
