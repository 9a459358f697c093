"""`swarmc test` for programs: a list of tests, single tests by their ids, a stream of results."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.execution.testing.selection import Selection, read_selection

from .conftest import Ran

TESTS = """[[test]]
name  = "lamps wait"
steps = [{ in = "Off", for = "1 h" }]

[[test]]
name  = "a :: b // c"
machine = "Watching"
steps = [{ send = "Ping" }, { in = "Awake" }]
"""
WRONG = """
[[test]]
name  = "lamps are on"
steps = [{ send = "Start", to = "lamp[0]" }, { in = "Off", of = "lamp" }]

[[test]]
name  = "lamps wait"
steps = [{ in = "Off" }]

[[test]]
name  = "two steps ahead"
seeds = 3
steps = [{ pass = "1 s" }, { who = "lamp[0]", in = "On" }]
"""


def write(folder: Path, text: str, name: str = "a") -> None:
    path = folder / f"{name}.swarmtest.toml"
    path.parent.mkdir(exist_ok=True)
    path.write_text(text, encoding="utf-8")


def records(text: str) -> list[dict[str, Any]]:
    return [json.loads(line) for line in text.splitlines()]


def kinds(text: str, kind: str) -> list[dict[str, Any]]:
    return [each for each in records(text) if each.get("type") == kind]


def test_a_list_has_ids_places_and_subjects(swarmc: Callable[..., Ran], folder: Path) -> None:
    write(folder, TESTS)
    shown = swarmc("test", "--list")
    assert (shown.code, shown.err) == (0, "")
    assert shown.out.splitlines() == [
        "a.swarmtest.toml::lamps wait  line 2  (Lamps)",
        "a.swarmtest.toml::a :: b // c  line 6  (Watching)",
    ]
    found = swarmc("test", "--list", "--format", "json")
    file, first, second = records(found.out)
    assert file == {"type": "file", "file": "a.swarmtest.toml", "read": True, "problems": []}
    assert first["subject"] == {"kind": "swarm", "name": "Lamps"}
    assert second == {
        "type": "test",
        "id": "a.swarmtest.toml::a :: b // c",
        "name": "a :: b // c",
        "file": "a.swarmtest.toml",
        "line": 6,
        "column": 9,
        "subject": {"kind": "machine", "name": "Watching"},
        "seeds": 1,
        "problems": [],
    }
    assert len(kinds(swarmc("test", "--list", "-k", "WAIT", "--format", "json").out, "test")) == 1
    assert "`-k no` leaves out all" in swarmc("test", "--list", "-k", "no").err
    for options in ((), ("--list",)):
        said = swarmc("test", "a.swarmtest.toml::lamps wait", "-k", "no", *options)
        assert "no test in `a.swarmtest.toml`" in said.out + said.err


def test_a_list_has_tests_with_mistakes(swarmc: Callable[..., Ran], folder: Path) -> None:
    write(folder, TESTS + WRONG)
    found = swarmc("test", "--list", "--format", "json")
    assert found.code == 1
    assert [(each["name"], bool(each["problems"])) for each in kinds(found.out, "test")] == [
        *(("lamps wait", False), ("a :: b // c", False), ("lamps are on", True)),
        *(("lamps wait (2)", True), ("two steps ahead", False)),
    ]
    shown = swarmc("test", "--list")
    assert "a.swarmtest.toml::lamps wait (2)  line 15  (unread)" in shown.out
    assert "SW0201" in shown.err  # the name is taken


@pytest.mark.parametrize(
    ("before", "after", "problem"),
    [
        ("", "steps = [", "SW0011"),  # no TOML
        ('swam = "Lamps"\n', "", "SW0012"),
        ('model = "none.swarm"\n', "", "SW0001"),
        ('model = "more/bad.swarm"\n', "", "SW0102"),
    ],
)
def test_a_list_has_the_tests_of_files_with_mistakes(
    swarmc: Callable[..., Ran], folder: Path, before: str, after: str, problem: str
) -> None:
    bad = folder / "more" / "bad.swarm"
    bad.parent.mkdir()
    bad.write_text("statemachine {")
    write(folder, before + TESTS + after)
    found = swarmc("test", "--list", "--format", "json")
    (file,) = kinds(found.out, "file")
    assert file["read"] is False
    assert problem in [each["code"] for each in file["problems"]]
    line = 2 + before.count("\n")
    assert [(each["name"], each["line"]) for each in kinds(found.out, "test")] == [
        ("lamps wait", line),
        ("a :: b // c", line + 4),
    ]
    results = kinds(swarmc("test", "--results", "-").out, "result")
    assert [each["outcome"] for each in results] == ["unread", "unread"]
    assert results[0]["problems"] == file["problems"]


def test_tests_run_by_their_ids(swarmc: Callable[..., Ran], folder: Path) -> None:
    write(folder, TESTS)
    write(folder, f'model = "../lamps.swarm"\n{TESTS}', "in/b")
    one = "a.swarmtest.toml::a :: b // c"
    ran = swarmc("test", one, "--results", "-")
    assert ran.code == 0
    assert [each["id"] for each in kinds(ran.out, "result")] == [one]
    assert ran.err.endswith("s\n")
    assert "1 passed, 1 left out" in ran.err

    several = swarmc("test", one, "in", "in/b.swarmtest.toml::lamps wait", "--results", "-")
    assert len(kinds(several.out, "result")) == 3  # all of the folder

    absolute = f"{folder / 'a.swarmtest.toml'}::lamps wait"
    (result,) = kinds(swarmc("test", absolute, "--results", "-").out, "result")
    assert result["id"] == f"{(folder / 'a.swarmtest.toml').as_posix()}::lamps wait"


@pytest.mark.parametrize(
    ("id_", "said"),
    [
        ("a.swarmtest.toml::lamps wiat", "did you mean `lamps wait`?"),
        ("a.swarmtest.toml::", "`swarmc test --list` shows the tests"),
        ("b.swarmtest.toml::lamps wait", "no such file: `b.swarmtest.toml`"),
        ("in::lamps wait", "no such file: `in::lamps wait`"),
        ("lamps.swarm::lamps wait", "`lamps.swarm` is a .swarm file, not a test file"),
    ],
)
def test_an_id_of_no_test_is_reported(
    swarmc: Callable[..., Ran], folder: Path, id_: str, said: str
) -> None:
    (folder / "in").mkdir()
    write(folder, TESTS)
    for flags in ([], ["--list"]):
        ran = swarmc("test", id_, *flags)
        assert ran.code == 1
        assert said in ran.out + ran.err


def test_a_list_has_no_results(swarmc: Callable[..., Ran], folder: Path) -> None:
    write(folder, TESTS)
    for flag in ("--play", "--junit", "--results"):
        ran = swarmc("test", "--list", flag, "out")
        assert ran.code == 2
        assert f"`--list` and `{flag}` conflict" in ran.err
    assert not (folder / "out").exists()


@pytest.mark.skipif(os.name == "nt", reason="names of files cannot have colons on Windows")
def test_a_file_may_have_the_separator_in_its_name(folder: Path) -> None:
    write(folder, TESTS, "x::y")
    path = Path("x::y.swarmtest.toml")
    assert read_selection([str(path)]) == Selection((path,), {})
    assert read_selection([f"{path}::a :: b"]) == Selection((), {path: frozenset({"a :: b"})})


def test_results_tell_what_happens(swarmc: Callable[..., Ran], folder: Path) -> None:
    write(folder, TESTS + WRONG)
    ran = swarmc("test", "--results", "out.jsonl", "--coverage")
    assert ran.code == 1
    assert "  FAILED  two steps ahead (0 of 3 seeds)" in ran.out  # as without the option
    text = (folder / "out.jsonl").read_text()
    assert [(each["type"], each.get("outcome")) for each in records(text)] == [
        ("file", None),
        *(("started", None), ("result", "passed")) * 2,
        *(("result", "unread"),) * 2,
        *(("started", None), ("result", "failed")),
        *(("coverage", None),) * 2,
        ("end", None),
    ]
    failed = kinds(text, "result")[-1]
    assert failed["expected"] == "`lamp[0]` in `On`"
    assert failed["actual"] == "after 1 s: `lamp[0]` is in `Off`"
    assert (failed["seeds"], failed["failed_seeds"]) == (3, [0, 1, 2])
    (problem,) = failed["problems"]
    assert (problem["code"], problem["line"]) == ("SW1101", 21)
    assert any("lamp[0]  (start) -> Off" in line for line in failed["trace"])
    blinking, watching = kinds(text, "coverage")
    reached = {each["name"]: each["reached"] for each in watching["transitions"]}
    assert reached == {"Off: on Ping -> Awake": True, "Awake: after 1 min -> Off": False}
    lines = (folder / "lamps.swarm").read_text().splitlines()
    for element in (*blinking["states"], *blinking["transitions"]):
        line = lines[element["line"] - 1]
        part = line[element["column"] - 1 : element["end_column"] - 1]
        assert part
        assert element["name"].endswith(" ".join(part.split()))
    assert kinds(text, "end") == [{"type": "end", "passed": False, "problems": []}]


def test_results_that_cannot_be_written(swarmc: Callable[..., Ran], folder: Path) -> None:
    write(folder, TESTS)
    ran = swarmc("test", "--results", "no/folder.jsonl")
    assert ran.code == 1
    assert "cannot write `no/folder.jsonl`" in ran.out
    assert "2 passed" in ran.err
    assert swarmc("test", "--results", "a.swarmtest.toml").code == 2
    assert (folder / "a.swarmtest.toml").read_text() == TESTS


def test_a_result_is_there_before_the_next_test_ends(folder: Path) -> None:
    endless = 'steps = [{ send = "Start" }, { pass = "300000 h" }]'
    write(folder, f'{TESTS}\n[[test]]\nname = "for ever"\n{endless}\n')
    program = [sys.executable, "-m", "swarmdsl", "test", "--results", "-"]
    with subprocess.Popen(
        program, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as process:
        assert process.stdout is not None
        seen = []
        while not seen or seen[-1] != ("started", "for ever"):
            record = json.loads(process.stdout.readline())
            seen.append((record["type"], record.get("name")))
        process.kill()
    assert ("result", "a :: b // c") in seen


def test_the_only_test_is_played(swarmc: Callable[..., Ran], folder: Path) -> None:
    write(folder, TESTS)
    page = folder / "run.html"
    assert swarmc("test", "--play", page).code == 0
    assert not page.exists()
    ran = swarmc("test", "a.swarmtest.toml::a :: b // c", "--play", page)
    assert ran.code == 0
    assert ran.err.endswith(f"a :: b // c: {page}\n")
    assert "<!doctype html>" in page.read_text()
