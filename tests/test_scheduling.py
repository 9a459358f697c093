"""Tests that share a worker of pytest-xdist."""

from __future__ import annotations

from pathlib import Path

from .scheduling import LATER, TOGETHER, spread, unit

ROOT = Path(__file__).resolve().parents[1]


def test_folders_that_share_a_worker_are_there() -> None:
    assert all((ROOT / folder).is_dir() for folder in TOGETHER)
    assert all((ROOT / each).exists() for each in LATER)


def test_files_that_need_ros_2_are_known() -> None:
    """Each of them begins later: the others are those that ask for it."""
    asking = [
        str(path.relative_to(ROOT)) for path in (ROOT / "tests").rglob("*.py")
        if "ros2.installed import" in path.read_text(encoding="utf-8") and path != Path(__file__)
    ]  # fmt: skip
    assert asking
    assert [each for each in asking if not each.startswith(LATER)] == []


def test_a_file_shares_a_worker() -> None:
    assert unit("tests/cli/test_build.py::test_it[a::b]") == "tests/cli/test_build.py"
    assert unit(f"{TOGETHER[0]}test_grammar.py::test_it") == TOGETHER[0]


def test_files_of_a_folder_are_spread() -> None:
    files = ["tests/a/1.py", "tests/a/1.py", "tests/a/2.py", "tests/b/1.py", "tests/a/3.py"]
    places = spread(files)
    assert sorted(places, key=places.__getitem__) == [
        "tests/a/1.py", "tests/a/2.py", "tests/b/1.py", "tests/a/3.py",
    ]  # fmt: skip
