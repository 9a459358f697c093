"""Matching of lines in long files."""

from __future__ import annotations

import difflib
from random import Random

import pytest

from swarmdsl.base import line_matching
from swarmdsl.base.line_matching import line_matcher
from swarmdsl.base.unified_diff import unified_diff


def versions(dice: Random, lines: int, words: int) -> tuple[list[str], list[str]]:
    """Return two versions of a file, of lines of which some are repeated."""
    before = [f"line {dice.randrange(words)}\n" for _ in range(lines)]
    after = list(before)
    for _ in range(lines // 8):
        at = dice.randrange(len(after))
        match dice.randrange(3):
            case 0:
                del after[at]
            case 1:
                after.insert(at, f"line {dice.randrange(words)}\n")
            case _:
                after[at] = "changed\n"
    return before, after


@pytest.mark.parametrize("words", [3, 300, 10**6])
@pytest.mark.parametrize("seed", range(5))
def test_blocks_are_common_lines_in_order(
    words: int, seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(line_matching, "_FEW_LINES", 0)
    before, after = versions(Random(seed), 400, words)

    rebuilt: list[str] = []
    rest: list[str] = []
    for tag, low, high, start, end in line_matcher(before, after).get_opcodes():
        if tag == "equal":
            assert before[low:high] == after[start:end]
        rest += before[low:high]
        rebuilt += after[start:end]

    assert (rest, rebuilt) == (before, after)


@pytest.mark.parametrize("seed", range(5))
def test_a_long_file_has_about_as_few_changes_as_a_short_one(
    seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    before, after = versions(Random(seed), 400, 10**6)
    best = sum(block.size for block in line_matcher(before, after).get_matching_blocks())
    monkeypatch.setattr(line_matching, "_FEW_LINES", 0)
    found = sum(block.size for block in line_matcher(before, after).get_matching_blocks())

    assert found >= 0.98 * best


@pytest.mark.parametrize("seed", range(5))
def test_diffs_of_short_files_are_those_of_difflib(seed: int) -> None:
    before, after = versions(Random(seed), 200, 150)
    expected = difflib.unified_diff(before, after, "old", "new")
    made = unified_diff("".join(before).encode(), "".join(after).encode(), "old", "new")
    assert made == "".join(expected)


def test_a_long_file_is_not_read_again_after_each_difference(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    read = 0
    original = difflib.SequenceMatcher.find_longest_match

    def counted(
        matcher: difflib.SequenceMatcher[str], low: int, high: int, start: int, end: int
    ) -> difflib.Match:
        nonlocal read
        read += high - low
        return original(matcher, low, high, start, end)

    monkeypatch.setattr(difflib.SequenceMatcher, "find_longest_match", counted)
    lines = [line for at in range(5_000) for line in (f"state S{at} {{\n", "  on Go -> A\n", "}\n")]
    after = [line.replace("Go", "Went") for line in lines]
    changes = line_matcher(lines, after).get_opcodes()

    assert sum(tag == "replace" for tag, *_ in changes) == 5_000
    assert read < 2 * len(lines)
