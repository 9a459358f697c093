"""Tests of the line that tells what tests lack."""

from __future__ import annotations

from .absent import absent


def test_skipped_tests_are_counted_by_what_they_lack() -> None:
    reasons = [
        "Skipped: no ROS 2: `make test-ros2`",
        "Skipped: no real YASMIN: SWARMDSL_YASMIN_PATH names the folders of it",
        "Skipped: about a syntax error",
        "Skipped: no corpus here; SWARMDSL_CORPUS names its folder",
        "no state charts (set SWARMDSL_CORPUS)",
        "Skipped: no real YASMIN: SWARMDSL_YASMIN_PATH names the folders of it",
    ]
    assert absent(reasons) == (
        "not run here: 5 of the tests, 2 without real YASMIN, 1 without ROS 2, 1 without corpus, "
        "1 without state charts"
    )


def test_nothing_is_told_where_nothing_is_lacking() -> None:
    assert absent(["Skipped: root can read every file"]) is None
