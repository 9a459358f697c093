"""Lists and files that cannot be read: they are named, and nothing is done to them."""

import os

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import OutputFile
from swarmdsl.output import WriteOptions, texts, write
from swarmdsl.output.clean import clean
from swarmdsl.output.manifest import NAME

from .builds import errors, everything, files, write_ok


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        ("", "line 1 is not JSON"),
        ('{\n<<<<<<< ours\n  "files": {}\n}', "line 2 is not JSON"),
        ("[]", "it is not an object"),
        ('{"files": 1}', "`files` in it is not a map of paths to strings"),
        ('{"files": {"t/a": 7}}', "`files` in it is not a map of paths to strings"),
        ("\xff", "it is not JSON"),
    ],
)
@pytest.mark.parametrize("options", [{}, {"force": True}, {"check": True}], ids=str)
def test_with_a_spoilt_list_nothing_is_done(tmp_path, content, reason, options):
    write_ok(files(a="1"), tmp_path)
    (tmp_path / NAME).write_text(content, encoding="latin-1")
    before = everything(tmp_path)
    for change in (write, clean_all):
        report = Diagnostics()
        assert change(files(a="2"), tmp_path, report, WriteOptions(**options)) is None
        (found,) = report
        assert found.message == (
            f"cannot read `{tmp_path / NAME}`, the list of generated files: {reason}"
        )
    assert everything(tmp_path) == before


def clean_all(_output, out, report, _how):
    return clean(out, (), report, dry=False)


def test_a_list_that_cannot_be_read_is_told(tmp_path):
    # A folder, since for some users all files can be read.
    (tmp_path / NAME).mkdir(parents=True)
    assert errors(files(a="2"), tmp_path) == ["unreadable-list"]


def test_without_the_list_what_is_as_it_was_written_is_known_by_the_texts(tmp_path):
    write_ok(files(a="1", b="1"), tmp_path)
    (tmp_path / "t/b").write_text("mine")
    (tmp_path / NAME).unlink()
    assert errors(files(a="2", b="2"), tmp_path) == ["would-overwrite"]
    (tmp_path / "t/b").unlink()
    assert write_ok(files(a="2", b="2"), tmp_path).written == ("t/a", "t/b")


def test_without_list_and_texts_every_file_is_the_users(tmp_path):
    write_ok(files(a="1"), tmp_path)
    (tmp_path / NAME).unlink()
    (tmp_path / texts.NAME).unlink()
    assert errors(files(a="2"), tmp_path) == ["would-overwrite"]


@pytest.fixture
def locked_away(tmp_path, monkeypatch):
    """A file that was generated and cannot be read, by no user."""
    write_ok(files(a="1", b="1"), tmp_path)
    place, open_plan = tmp_path / "t/a", os.open

    def open_others(path, *arguments):
        if path == str(place):
            raise PermissionError(13, "Permission denied", path)
        return open_plan(path, *arguments)

    monkeypatch.setattr(os, "open", open_others)
    return place


@pytest.mark.parametrize("names", [{"a": "2"}, {"b": "1"}], ids=["still made", "not any more"])
def test_a_file_that_cannot_be_read_is_named(locked_away, tmp_path, names):
    report = Diagnostics()
    assert write(files(**names), tmp_path, report) is None
    (found,) = report
    assert found.message == f"cannot read `{locked_away}`: permission denied"
    assert locked_away.exists()


def test_a_clean_leaves_what_it_cannot_read_and_says_so(locked_away, tmp_path):
    report = Diagnostics()
    written = clean(tmp_path, (), report, dry=False)
    assert written is not None
    assert written.removed == ("t/b",)
    assert [found.name for found in report] == ["unreadable-file"]
    assert locked_away.exists()


@pytest.mark.skipif(getattr(os, "geteuid", int)() == 0, reason="root can read all files")
def test_a_clean_names_files_in_a_folder_that_cannot_be_read(tmp_path):
    write_ok(files(a="1"), tmp_path)
    (tmp_path / "t").chmod(0)
    report = Diagnostics()
    clean(tmp_path, (), report, dry=False)
    (tmp_path / "t").chmod(0o700)
    assert [found.name for found in report] == ["unreadable-file"]


def test_a_clean_of_a_target_that_is_none(tmp_path):
    write_ok({"smach": [OutputFile("a", "1")], "roster": [OutputFile("a", "1")]}, tmp_path)
    before = everything(tmp_path)
    report = Diagnostics()
    # The one is known but was not built, the other one is of a generator that is not installed.
    clean(tmp_path, ["skeleton"], report, dry=False)
    assert (len(report), everything(tmp_path)) == (0, before)
    clean(tmp_path, ["smatch", "roster"], report, dry=False)
    (found,) = report
    assert (found.name, found.help) == ("unknown-target", "did you mean `smach`?")
    assert everything(tmp_path).keys() == {NAME, texts.NAME, "smach", "smach/a"}
