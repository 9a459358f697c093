"""Files of odd kinds, documents with mistakes and any arguments: a diagnostic, soon, in bounds.

Each kind of case has a process of its own, in which commands run one after the other. A case that
fails can be run again: `python -m tests.fuzz.worker KIND SEED NUMBER 1`.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from .cases import KINDS, case
from .worker import HANG, MEMORY

pytestmark = pytest.mark.skipif(os.name != "posix", reason="limits and files of POSIX")

ROOT = Path(__file__).resolve().parents[2]
SEED = 1


@pytest.mark.timeout(24 * 3600)
@pytest.mark.parametrize("kind", KINDS)
def test_no_internal_error_no_hang_no_bomb(
    kind: str, request: pytest.FixtureRequest, record_property: pytest.RecordProperty
) -> None:
    count = -(-int(request.config.getoption("--cases")) // len(KINDS))
    failed, figures, words = _ran(kind, count)

    slowest, memory = figures.get("slowest", 0), figures.get("memory", 0)
    record_property(
        "figure",
        f"{figures.get('cases', 0)} cases of {kind}: the slowest in {slowest:.2f} s, "
        f"{memory / 2**20:.0f} MB of memory at most, exit codes {figures.get('codes')}",
    )
    assert failed == []
    assert figures, words
    assert slowest < HANG
    assert memory < MEMORY


def _ran(kind: str, count: int) -> tuple[list[object], dict[str, float], str]:
    """Run cases; return those that failed, the figures, and the end of what a crash told."""
    command = [sys.executable, "-m", "tests.fuzz.worker", kind, str(SEED), "0", str(count)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    told = [json.loads(line) for line in done.stdout.splitlines()]
    figures = [each for each in told if "cases" in each]
    failed = [each for each in told if "cases" not in each]
    return failed, (figures or [{}])[0], done.stderr[-4000:]


@pytest.mark.parametrize("kind", KINDS)
def test_cases_are_the_same_again(kind: str) -> None:
    cases = [case(kind, SEED, number) for number in range(50)]
    assert cases == [case(kind, SEED, number) for number in range(50)]
    assert len({str(each) for each in cases}) > 25
