"""Tests that share a worker of pytest-xdist."""

from __future__ import annotations

from pathlib import Path

from .scheduling import TOGETHER, spread, unit

ROOT = Path(__file__).resolve().parents[1]


def test_folders_that_share_a_worker_are_there() -> None:
    assert all((ROOT / folder).is_dir() for folder in TOGETHER)


def test_a_file_shares_a_worker() -> None:
    assert unit("tests/cli/test_build.py::test_it[a::b]") == "tests/cli/test_build.py"
    assert unit(f"{TOGETHER[0]}test_grammar.py::test_it") == TOGETHER[0]


def test_files_of_a_folder_are_spread() -> None:
    files = ["tests/a/1.py", "tests/a/1.py", "tests/a/2.py", "tests/b/1.py", "tests/a/3.py"]
    places = spread(files)
    assert sorted(places, key=places.__getitem__) == [
        "tests/a/1.py", "tests/a/2.py", "tests/b/1.py", "tests/a/3.py",
    ]  # fmt: skip
