"""Builds that fail half-way, or meet another one."""

import os
from pathlib import Path
from threading import Thread

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import OutputFile
from swarmdsl.output import WriteOptions, texts, write
from swarmdsl.output.lock import locked
from swarmdsl.output.manifest import NAME
from swarmdsl.output.prepare import open_plan

from .builds import everything, files, write_ok


def fail_at(monkeypatch, name: str, error: BaseException) -> None:
    """Let `os.open` and `os.replace` fail for a file of this name, or when it is staged."""
    real_open, real_replace = os.open, os.replace

    def open_(path, flags, *mode):
        if Path(path).name.startswith(name) and flags & os.O_CREAT:
            raise error
        return real_open(path, flags, *mode)

    def replace(source, destination):
        if Path(destination).name.startswith(name):
            raise error
        real_replace(source, destination)

    monkeypatch.setattr(os, "open", open_)
    monkeypatch.setattr(os, "replace", replace)


FULL = OSError(28, "No space left on device")


@pytest.mark.parametrize("error", [FULL, KeyboardInterrupt()], ids=["full", "interrupted"])
@pytest.mark.parametrize("before", [False, True], ids=["new", "changed"])
def test_what_fails_before_a_file_is_replaced_changes_nothing(tmp_path, monkeypatch, error, before):
    out = tmp_path / "out"
    if before:
        write_ok(files(a="1"), out)
    there = everything(tmp_path)
    report = Diagnostics()
    with monkeypatch.context() as patch:
        fail_at(patch, ".swarmc-", error)
        if isinstance(error, OSError):
            assert write(files(a="2", b="2"), out, report) is None
            (found,) = report
            place = out / texts.NAME
            assert found.message == f"cannot write `{place}`: no space left on device"
        else:
            with pytest.raises(KeyboardInterrupt):
                write(files(a="2", b="2"), out, report)
    assert everything(tmp_path) == there


def test_what_fails_later_is_completed_by_the_next_build(tmp_path, monkeypatch):
    write_ok(files(a="1", b="1"), tmp_path)
    with monkeypatch.context() as patch:
        fail_at(patch, "b", OSError(5, "Input/output error"))
        report = Diagnostics()
        assert write(files(a="2", b="2"), tmp_path, report) is None
    (found,) = report
    assert found.message == f"cannot write `{tmp_path / 't/b'}`: input/output error"
    assert ((tmp_path / "t/a").read_text(), (tmp_path / "t/b").read_text()) == ("2", "1")
    assert write_ok(files(a="2", b="2"), tmp_path).unchanged == ("t/a", "t/b")
    assert everything(tmp_path).keys() == {NAME, texts.NAME, "t", "t/a", "t/b"}


def test_one_build_waits_for_another(tmp_path):
    write_ok(files(a="1"), tmp_path)
    done = []
    with locked(tmp_path):
        other = Thread(target=lambda: done.append(write_ok(files(a="2"), tmp_path)))
        other.start()
        other.join(0.2)
        assert (tmp_path / "t/a").read_text() == "1"
        assert done == []
    other.join()
    assert [each.written for each in done] == [("t/a",)]


def test_the_first_build_is_waited_for_too(tmp_path):
    out, done = tmp_path / "new/out", []
    with open_plan(out, WriteOptions(), Diagnostics()) as plan:
        assert plan is not None
        other = Thread(target=lambda: done.append(write_ok(files(a="2"), out)))
        other.start()
        other.join(0.2)
        assert done == []
        (out / "mine").touch()
    other.join()
    assert [each.written for each in done] == [("t/a",)]


def test_a_folder_to_which_nothing_is_written_is_not_made(tmp_path):
    report = Diagnostics()
    too_long = {"t": [OutputFile("a" * 300, "1")]}
    assert write(too_long, tmp_path / "new/out", report) is None
    assert all(found.help for found in report)
    assert everything(tmp_path) == {}
