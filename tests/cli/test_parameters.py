"""Command lines that are read without Click: what Click makes of them, or nothing."""

import os

import click
import pytest
from hypothesis import given
from hypothesis import strategies as st

from swarmdsl.cli import PLAIN, build, check
from swarmdsl.cli.commands import cli
from swarmdsl.cli.parameters import read

OPTIONS = {"build": build.OPTIONS, "check": check.OPTIONS}
FLAGS = sorted({flag for options in OPTIONS.values() for one in options for flag in one.flags})
WORDS = [
    *(
        *FLAGS,
        "--format=json",
        "--out=o",
        "-oo",
        "-t=x",
        "--forc",
        "--watch=1",
        "--debug",
        "--help",
    ),
    *("", "-", "--", "-1", "a.swarm", "folder", "a=b", "=", "text", "json", "JSON", "xml", "--=x"),
]


def by_click(name: str, words: list[str]) -> dict[str, object] | None:
    command = cli.get_command(click.Context(cli), name)
    assert command is not None
    try:
        return command.make_context(name, list(words)).params
    except (click.ClickException, click.exceptions.Exit):
        return None


@given(st.sampled_from(PLAIN), st.lists(st.sampled_from(WORDS), max_size=8))
def test_what_is_read_is_what_click_reads(name, words):
    values = read(OPTIONS[name], words)
    if values is not None:
        assert values == by_click(name, words)


@pytest.mark.parametrize(
    "words",
    [
        [],
        ["a.swarm", "folder"],
        ["a.swarm", "--format", "json", "b.swarm", "--allow", "x", "--watch", "--allow", "y"],
    ],
)
@pytest.mark.parametrize("name", PLAIN)
def test_plain_command_lines_are_read(name, words):
    assert read(OPTIONS[name], words) == by_click(name, words) is not None


def test_all_options_of_a_build_are_read():
    words = ["m", "-t", "scxml", "--target", "adf", "--out", "o", "--option", "adf.x=-1"]
    words += ["--force", "--dump-ir", "--deny", "warnings", "--warn", "x", "--format", "sarif"]
    assert read(build.OPTIONS, words) == by_click("build", words) is not None


def test_click_says_that_a_file_cannot_be_read(good, monkeypatch):
    monkeypatch.setattr(os, "access", lambda *_: False)
    assert read(check.OPTIONS, [str(good)]) is by_click("check", [str(good)]) is None
    assert read(build.OPTIONS, ["-o", str(good)]) is by_click("build", ["-o", str(good)]) is None


def test_wrong_usage_is_told_by_click(swarmc, good):
    ran = swarmc("build", good, "--watch", "--dump-ir")
    assert (ran.code, ran.out) == (2, "")
    assert ran.err.startswith("Usage: swarmc build [OPTIONS] [FILE|FOLDER]...\n")
    assert ran.err.endswith("`--watch` and `--dump-ir` conflict: it prints once\n")
