"""Builds that only look, and cleans: `check`, `dry`, `clean`."""

from __future__ import annotations

import json
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import OutputFile
from swarmdsl.output import texts, write
from swarmdsl.output.clean import clean

from .builds import build, names, plain, skeleton, text, tree


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
        "parked": "is not generated any more, and has edits of yours",
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
