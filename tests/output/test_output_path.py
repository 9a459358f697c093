"""Paths that stay in the output folder, and paths that are one file."""

import posixpath

import pytest
from hypothesis import given
from hypothesis import strategies as st

from swarmdsl.base.relative_paths import clash_key, stays_inside


@pytest.mark.parametrize("path", ["a", "a/b.c", "..a", "a..b/c", ".hidden", "ä/日本"])
def test_inside(path):
    assert stays_inside(path)


@pytest.mark.parametrize(
    "path",
    [
        "",
        "/",
        "/a",
        "a/",
        "a//b",
        ".",
        "a/./b",
        "..",
        "../a",
        "a/../b",
        "a\\b",
        "C:a",
        "a\0",
        "a\n",
    ],
)
def test_outside(path):
    assert not stays_inside(path)


@given(st.text(alphabet="a./\\:\0", max_size=12))
def test_what_stays_inside_cannot_climb(path):
    if stays_inside(path):
        assert posixpath.normpath(posixpath.join("/out", path)) == f"/out/{path}"


@pytest.mark.parametrize(
    ("one", "other"), [("Robot.py", "robot.py"), ("é", "e\N{COMBINING ACUTE ACCENT}"), ("ß", "SS")]
)
def test_paths_that_some_file_systems_take_for_one(one, other):
    assert clash_key(one) == clash_key(other)
