"""Three-way merge: what both sides have made of a text, and where nobody can tell."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from swarmdsl.output.merge import first_difference, merge

BASE = b"a\nb\nc\nd\ne\n"
TEXTS = st.lists(st.sampled_from("abcdef"), max_size=8).map(
    lambda lines: "".join(f"{line}\n" for line in lines).encode()
)


@pytest.mark.parametrize(
    ("of_user", "generated", "made", "taken"),
    [
        (BASE, b"x\n", b"x\n", 1),
        (b"x\n", BASE, b"x\n", 0),
        (b"A\nb\nc\nd\ne\n", b"a\nb\nc\nd\nE\n", b"A\nb\nc\nd\nE\n", 1),
        (b"a\nb\nmine\nc\nd\ne\n", b"b\nc\nd\n", b"b\nmine\nc\nd\n", 2),
        (b"a\nX\nc\nd\ne\n", b"a\nX\nc\nd\ne\n", b"a\nX\nc\nd\ne\n", 0),
        (b"a\nb\nc\nd\ne\nmine", b"0\na\nb\nc\nd\ne\n", b"0\na\nb\nc\nd\ne\nmine", 1),
    ],
)
def test_what_only_one_side_changes_is_taken(
    of_user: bytes, generated: bytes, made: bytes, taken: int
) -> None:
    merged = merge(BASE, of_user, generated)

    assert (merged.text, merged.conflicts, merged.taken) == (made, (), taken)


@pytest.mark.parametrize(
    ("of_user", "generated", "lines"),
    [
        (b"a\nX\nc\nd\ne\n", b"a\nY\nc\nd\ne\n", (1, 2)),
        (b"a\nb\nmine\nc\nd\ne\n", b"a\nB\nc\nd\ne\n", (1, 3)),
        (b"a\nb\nmine\nc\nd\ne\n", b"a\nd\ne\n", (1, 4)),
        (b"a\nb\nd\ne\n", b"a\nb\nC\nd\ne\n", (2, 2)),
    ],
)
def test_what_both_sides_change_is_a_conflict(
    of_user: bytes, generated: bytes, lines: tuple[int, int]
) -> None:
    merged = merge(BASE, of_user, generated)

    assert (merged.text, merged.conflicts) == (None, (lines,))


@given(TEXTS, TEXTS)
def test_one_side_alone_decides(base: bytes, changed: bytes) -> None:
    assert merge(base, base, changed).text == changed
    assert merge(base, changed, base).text == changed
    assert merge(base, changed, changed).text == changed


@given(TEXTS, TEXTS, st.sets(st.integers(0, 8), max_size=3))
def test_no_line_of_the_user_is_lost(base: bytes, generated: bytes, places: set[int]) -> None:
    lines = base.splitlines(keepends=True)
    for number, place in enumerate(sorted(places, reverse=True)):
        lines.insert(place, f"mine {number}\n".encode())
    merged = merge(base, b"".join(lines), generated)

    if merged.text is not None:
        found = merged.text.splitlines()
        assert sorted(line for line in found if line.startswith(b"mine")) == sorted(
            f"mine {number}".encode() for number in range(len(places))
        )


@pytest.mark.skipif(shutil.which("git") is None, reason="no git: apt-get install git")
@pytest.mark.parametrize("seed", range(12))
def test_git_merges_the_same(seed: int, tmp_path: Path) -> None:
    """Of lines that are all different, so that there is one way to match them."""
    base = [f"line {number}\n" for number in range(20)]
    user, ours = list(base), list(base)
    user[seed] = "mine\n"
    user.insert(19 - seed, "more of mine\n")
    ours[(seed * 7 + 3) % 20] = "new\n"
    del ours[(seed * 5 + 9) % 20]
    texts = {"user": user, "base": base, "ours": ours}
    for name, lines in texts.items():
        (tmp_path / name).write_text("".join(lines), encoding="utf-8")
    ran = subprocess.run(
        ["git", "merge-file", "-p", "user", "base", "ours"],
        cwd=tmp_path,
        capture_output=True,
        check=False,
    )
    merged = merge(*("".join(texts[name]).encode() for name in ("base", "user", "ours")))

    assert merged.text == (ran.stdout if ran.returncode == 0 else None)


def test_the_first_difference() -> None:
    assert first_difference(b"a\nb\n", b"a\nc\n") == 1
    assert first_difference(b"a\nb\n", b"a\n") == 1
    assert first_difference(b"", b"a\n") == 0
