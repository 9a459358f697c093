"""Two versions of a file, merged by what they declare."""

from __future__ import annotations

import random
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.cli import run
from swarmdsl.syntax.parse import parse
from swarmdsl.tools.merge.outline import Item, outline
from swarmdsl.tools.merge.three_way import merge

ROOT = Path(__file__).resolve().parents[2]
FILES = sorted((ROOT / "examples").rglob("*.swarm"))
BASE = """\
// All that happens.
event Go : std_msgs/Empty
event Stop : std_msgs/Empty

/// How it behaves.
statemachine M {
  var count : int32
  initial A

  state A {
    on Go -> B
  }
  state B {
    on Go / count = 1 -> A
    on Stop -> C
  }
  final C
}
"""


def read(text: str) -> Item:
    report = Diagnostics()
    source = Source("model.swarm", text)
    parsed = parse(source, report)
    assert not report.has_errors, [found.message for found in report]
    return outline(source, parsed.model)


def merged(base: str, ours: str, theirs: str) -> tuple[str, int]:
    found = merge(read(base), read(ours), read(theirs))
    return found.text, found.conflicts


def changed(*changes: tuple[str, str]) -> str:
    text = BASE
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return text


LAST = "event Stop : std_msgs/Empty\n"
ONE, TWO = (f"event {name} : std_msgs/Empty\n" for name in ("One", "Two"))
ONE_MORE = (LAST, f"{LAST}{ONE}")
TWO_MORE = (LAST, f"{LAST}{TWO}")
CLEAN = {
    "something new on both sides in one place": (
        [ONE_MORE],
        [TWO_MORE],
        [(LAST, f"{LAST}{ONE}{TWO}")],
    ),
    "lines beside each other": (
        [("on Go / count = 1 -> A", "on Go / count = 2 -> A")],
        [("on Stop -> C", "on Stop -> A")],
        [("on Go / count = 1 -> A", "on Go / count = 2 -> A"), ("on Stop -> C", "on Stop -> A")],
    ),
    "a comment and what it is for": (
        [("How it behaves", "What it does")],
        [("statemachine M", "endless statemachine M")],
        [("How it behaves", "What it does"), ("statemachine M", "endless statemachine M")],
    ),
    "the same on both sides": ([ONE_MORE], [ONE_MORE], [ONE_MORE]),
    "gone here, the same there": ([("    on Stop -> C\n", "")], [], [("    on Stop -> C\n", "")]),
    "another order, and something new": (
        [
            ("event Go : std_msgs/Empty\nevent Stop", "event Stop"),
            ("\n\n///", "\nevent Go : std_msgs/Empty\n\n///"),
        ],
        [TWO_MORE],
        None,
    ),
    "a state moved down, a line in it changed": (
        [
            ("  state A {\n    on Go -> B\n  }\n", ""),
            ("  final C\n", "  state A {\n    on Go -> B\n  }\n  final C\n"),
        ],
        [("on Go -> B", "on Go -> C")],
        None,
    ),
}


@pytest.mark.parametrize("case", CLEAN)
def test_changes_that_do_not_touch_each_other(case: str) -> None:
    ours, theirs, both = CLEAN[case]
    text, conflicts = merged(BASE, changed(*ours), changed(*theirs))
    back, others = merged(BASE, changed(*theirs), changed(*ours))

    assert conflicts == others == 0
    if both is not None:
        assert text == changed(*both)
    assert sorted(text.splitlines()) == sorted(back.splitlines())
    read(text)


@pytest.mark.parametrize(
    ("ours", "theirs", "said"),
    [
        (
            ("on Stop -> C", "on Stop -> A"),
            ("on Stop -> C", "on Stop -> B"),
            "<<<<<<< ours\n    on Stop -> A\n=======\n    on Stop -> B\n>>>>>>> theirs\n",
        ),
        (
            ("    on Stop -> C\n", ""),
            ("on Stop -> C", "on Stop -> B"),
            "<<<<<<< ours\n=======\n    on Stop -> B\n>>>>>>> theirs\n",
        ),
        (
            ("  final C\n", "  final C\n  final D\n"),
            ("  final C\n", "  final C\n  final  D\n"),
            "<<<<<<< ours\n  final D\n=======\n  final  D\n>>>>>>> theirs\n",
        ),
    ],
)
def test_changes_of_the_same_are_a_conflict(
    ours: tuple[str, str], theirs: tuple[str, str], said: str
) -> None:
    text, conflicts = merged(BASE, changed(ours), changed(theirs))

    assert conflicts == 1
    assert said in text
    assert "on Go / count = 1 -> A\n" in text


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_any_edits(path: Path) -> None:
    """One side alone is taken whole; of two, no line that only one of them has is lost."""
    text = path.read_text(encoding="utf-8")
    base = read(text)
    assert base.text == text
    chance = random.Random(7)
    variants = [item for _ in range(12) if (item := _edited(text, chance)) is not None]
    for ours in variants:
        assert merge(base, ours, base).text == merge(base, base, ours).text == ours.text
        assert merge(base, ours, ours).text == ours.text
    for ours, theirs in pairwise(variants):
        found = merge(base, ours, theirs)
        new = {*ours.text.splitlines(), *theirs.text.splitlines()} - set(text.splitlines())
        assert new <= set(found.text.splitlines())


def _edited(text: str, chance: random.Random) -> Item | None:
    """The outline of the text with a few lines copied, dropped or moved, where it has one."""
    lines = text.splitlines(keepends=True)
    for _ in range(chance.randint(1, 3)):
        at, to = chance.randrange(len(lines)), chance.randrange(len(lines))
        match chance.randrange(3):
            case 0:
                lines[at] = lines[at].replace(":", " :", 1)
            case 1:
                del lines[at]
            case _:
                lines.insert(to, lines[at])
    report = Diagnostics()
    source = Source("model.swarm", "".join(lines))
    parsed = parse(source, report)
    return None if report.has_errors else outline(source, parsed.model)


@pytest.fixture
def versions(tmp_path: Path) -> list[str]:
    texts = (BASE, changed(ONE_MORE), changed(TWO_MORE))
    paths = [tmp_path / name for name in ("base.swarm", "ours.swarm", "theirs.swarm")]
    for path, text in zip(paths, texts, strict=True):
        path.write_text(text, encoding="utf-8")
    return [str(path) for path in paths]


def test_on_the_command_line(
    versions: list[str], capfdbinary: pytest.CaptureFixture[bytes]
) -> None:
    ours = Path(versions[1])
    assert run(["merge", *versions]) == 0
    assert b"event One : std_msgs/Empty\nevent Two" in capfdbinary.readouterr().out
    assert ours.read_text(encoding="utf-8") == changed(ONE_MORE)
    assert run(["merge", *versions, "-o", str(ours)]) == 0
    assert "event Two" in ours.read_text(encoding="utf-8")
    assert run(["merge", *versions[:2], f"{versions[2]}x"]) == 2
    assert b"SW0001" in capfdbinary.readouterr().err


def test_line_ends_stay(versions: list[str]) -> None:
    ours = Path(versions[1])
    ours.write_bytes(ours.read_bytes().replace(b"\n", b"\r\n"))

    assert run(["merge", *versions, "-o", str(ours)]) == 0
    content = ours.read_bytes()
    assert b"event Two : std_msgs/Empty\r\n" in content
    assert content.count(b"\n") == content.count(b"\r\n")


def test_conflicts_have_an_exit_code(
    versions: list[str], capfdbinary: pytest.CaptureFixture[bytes]
) -> None:
    for path, target in zip(versions[1:], "AB", strict=True):
        Path(path).write_text(changed(("on Stop -> C", f"on Stop -> {target}")), encoding="utf-8")

    assert run(["merge", *versions]) == 1
    printed = capfdbinary.readouterr()
    assert b"<<<<<<< ours\n    on Stop -> A\n" in printed.out
    assert b"1 conflict in " in printed.err


def test_what_cannot_be_parsed_is_merged_by_lines(
    versions: list[str], capfdbinary: pytest.CaptureFixture[bytes]
) -> None:
    theirs = Path(versions[2])
    theirs.write_text(BASE.replace("final C", "final"), encoding="utf-8")

    assert run(["merge", *versions]) == 0
    printed = capfdbinary.readouterr()
    assert printed.out.decode() == changed(ONE_MORE).replace("final C", "final")
    assert b"merged by lines" in printed.err


def test_as_a_driver_of_git(tmp_path: Path) -> None:
    """Two events added in one place, a conflict for git alone, merge cleanly."""
    driver = f'"{sys.executable}" -m swarmdsl merge %O %A %B -o %A'

    def git(*words: str) -> None:
        identity = ("-c", "user.name=A", "-c", "user.email=a@example.org")
        command = ["git", *identity, "-c", f"merge.swarm.driver={driver}", *words]
        subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)

    model = tmp_path / "model.swarm"

    def commit(text: str) -> None:
        model.write_text(text, encoding="utf-8")
        git("add", ".")
        git("commit", "--message", "A change")

    git("init", "--initial-branch", "main")
    (tmp_path / ".gitattributes").write_text("*.swarm merge=swarm\n", encoding="utf-8")
    commit(BASE)
    git("switch", "--create", "side")
    commit(changed(TWO_MORE))
    git("switch", "main")
    commit(changed(ONE_MORE))
    git("merge", "side")

    assert model.read_text(encoding="utf-8") == CLEAN_TEXT


CLEAN_TEXT = changed(*CLEAN["something new on both sides in one place"][2])
