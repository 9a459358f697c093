"""Writing: all or nothing, never over what the user wrote, never outside the folder."""

import json
import os

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import OutputFile
from swarmdsl.output import Action, WriteOptions, texts, write
from swarmdsl.output.clean import clean
from swarmdsl.output.manifest import NAME

from .builds import errors, everything, files, write_ok


def test_files_lie_below_the_folder_of_their_target(tmp_path):
    output = {"a": [OutputFile("x/y.txt", "é\n")], "b": [OutputFile("run", "", executable=True)]}
    written = write_ok(output, tmp_path / "deep" / "out")
    out = tmp_path / "deep" / "out"
    assert everything(out).keys() == {NAME, texts.NAME, "a", "a/x", "a/x/y.txt", "b", "b/run"}
    assert (out / "a/x/y.txt").read_bytes() == "é\n".encode()
    assert os.access(out / "b/run", os.X_OK)
    assert not os.access(out / "a/x/y.txt", os.X_OK)
    assert written.written == ("a/x/y.txt", "b/run")


def test_the_manifest_lists_hashes_in_order_and_is_deterministic(tmp_path):
    write_ok({"t": [OutputFile("b", "1"), OutputFile("a", "2")]}, tmp_path / "one")
    write_ok({"t": [OutputFile("a", "2"), OutputFile("b", "1")]}, tmp_path / "two")
    assert (tmp_path / "one" / NAME).read_bytes() == (tmp_path / "two" / NAME).read_bytes()
    listed = json.loads((tmp_path / "one" / NAME).read_text())["files"]
    # sha256 of "2" and "1", by coreutils.
    assert list(listed.items()) == [
        ("t/a", "d4735e3a265e16eee03f59718b9b5d03019c07d8b6c51f90da3a666eec13ab35"),
        ("t/b", "6b86b273ff34fce19d6b804eff5a3f5747ada4eaa22f1d49c01e52ddb7875b4b"),
    ]


def test_what_is_up_to_date_is_not_touched(tmp_path):
    write_ok(files(a="1", b="1"), tmp_path)
    for name in ("t/a", "t/b", NAME):
        os.utime(tmp_path / name, (1, 1))
    written = write_ok(files(a="1", b="2"), tmp_path)
    assert (written.unchanged, written.written) == (("t/a",), ("t/b",))
    assert (tmp_path / "t/a").stat().st_mtime == 1
    assert (tmp_path / "t/b").stat().st_mtime != 1
    os.utime(tmp_path / NAME, (1, 1))
    write_ok(files(a="1", b="2"), tmp_path)
    assert (tmp_path / NAME).stat().st_mtime == 1


def test_a_lost_executable_bit_comes_back(tmp_path):
    output = {"t": [OutputFile("run", "x", executable=True)]}
    write_ok(output, tmp_path)
    (tmp_path / "t/run").chmod(0o644)
    assert write_ok(output, tmp_path).written == ("t/run",)
    assert os.access(tmp_path / "t/run", os.X_OK)


def test_a_file_from_elsewhere_stops_everything(tmp_path):
    (tmp_path / "t").mkdir()
    (tmp_path / "t/b").write_text("mine")
    assert errors(files(a="1", b="1"), tmp_path) == ["would-overwrite"]
    assert not (tmp_path / "t/a").exists()
    assert write_ok(files(a="1", b="1"), tmp_path, force=True).written == ("t/a", "t/b")
    assert (tmp_path / "t/b").read_text() == "1"


def test_a_file_from_elsewhere_with_the_same_content_is_adopted(tmp_path):
    (tmp_path / "t").mkdir()
    (tmp_path / "t/a").write_text("1")
    assert write_ok(files(a="1"), tmp_path).unchanged == ("t/a",)
    assert write_ok(files(a="2"), tmp_path).written == ("t/a",)


def test_an_edited_file_is_not_overwritten_unasked(tmp_path):
    write_ok(files(a="1"), tmp_path)
    (tmp_path / "t/a").write_text("edited")
    report = Diagnostics()
    assert write(files(a="2"), tmp_path, report) is not None
    (found,) = report
    assert found.name == "merge-conflict"
    assert "--force" in (found.help or "")
    assert (tmp_path / "t/a").read_text() == "edited"
    assert write_ok(files(a="2"), tmp_path, force=True).paths(Action.OVERWRITE) == ("t/a",)
    assert (tmp_path / "t/a").read_text() == "2"


def test_a_deleted_file_is_written_again(tmp_path):
    write_ok(files(a="1"), tmp_path)
    (tmp_path / "t/a").unlink()
    assert write_ok(files(a="1"), tmp_path).written == ("t/a",)


def test_a_file_to_fill_in_is_the_users_once_it_is_edited(tmp_path):
    def output(text):
        return {"t": [OutputFile("body.py", text, keep=True)]}

    assert write_ok(output("1"), tmp_path).written == ("t/body.py",)
    # As long as nobody has written in it, it follows the model.
    assert write_ok(output("2"), tmp_path).written == ("t/body.py",)
    (tmp_path / "t/body.py").write_text("mine")
    assert write_ok(output("3"), tmp_path, force=True).kept == ("t/body.py",)
    assert (tmp_path / "t/body.py").read_text() == "mine"


def test_what_is_no_longer_generated_is_removed_with_its_folder(tmp_path):
    write_ok({"t": [OutputFile("d/e/old", "1"), OutputFile("new", "1")]}, tmp_path)
    assert write_ok(files(new="1"), tmp_path).removed == ("t/d/e/old",)
    assert everything(tmp_path).keys() == {NAME, texts.NAME, "t", "t/new"}


def test_what_is_no_longer_generated_but_was_edited_is_put_aside(tmp_path):
    write_ok(files(old="1", new="1"), tmp_path)
    (tmp_path / "t/old").write_text("edited")
    report = Diagnostics()
    written = write(files(new="1"), tmp_path, report, WriteOptions(force=True))
    assert written is not None
    assert (written.removed, written.paths(Action.PARK)) == ((), (".parked/t/old",))
    assert [found.name for found in report] == ["parked-code"]
    assert (tmp_path / ".parked/t/old").read_text() == "edited"
    # From now on it is no longer worth a word.
    assert write_ok(files(new="1"), tmp_path).changes == ()


def test_the_output_of_targets_that_are_not_built_stays(tmp_path):
    write_ok({"a": [OutputFile("x", "1")], "b": [OutputFile("y", "1")]}, tmp_path)
    assert write_ok({"a": [OutputFile("x", "2")]}, tmp_path).removed == ()
    assert write_ok({"b": [OutputFile("y", "2")]}, tmp_path).written == ("b/y",)


def test_two_models_in_one_folder_are_told_when_they_take_turns(tmp_path):
    write_ok(files(a="1", both="1"), tmp_path, model="uav")
    for model, name, other in (("rover", "b", "uav"), ("uav", "a", "rover")):
        report = Diagnostics()
        assert (
            write(files(both="1", **{name: "1"}), tmp_path, report, WriteOptions(model=model))
            is not None
        )
        (found,) = report
        assert found.name == "other-model"
        assert found.message == (f"the build removes one file of model `{other}` from `{tmp_path}`")
        write_ok(files(both="1", **{name: "1"}), tmp_path, model=model)
    # Another name alone is no other model.
    write_ok(files(a="2", both="1"), tmp_path, model="plane")
    report = Diagnostics()
    clean(tmp_path, (), report, dry=False)
    assert len(report) == 0


def test_a_clean_leaves_nothing_where_files_were_deleted_before(tmp_path):
    write_ok(files(a="1", b="1"), tmp_path)
    (tmp_path / "t/a").unlink()
    clean(tmp_path, (), Diagnostics(), dry=False)
    assert everything(tmp_path).keys() <= {"t"}


def test_a_target_that_makes_nothing_any_more_leaves_nothing(tmp_path):
    write_ok(files(a="1"), tmp_path)
    assert write_ok({"t": []}, tmp_path).removed == ("t/a",)
    assert everything(tmp_path).keys() == {NAME, texts.NAME}


def test_a_file_renamed_in_case_only_is_not_lost(tmp_path):
    write_ok(files(Robot="1"), tmp_path)
    write_ok(files(robot="1"), tmp_path)
    assert (tmp_path / "t/robot").read_text() == "1"


@pytest.mark.parametrize("path", ["t/../../victim", "/victim", "../victim", "t/link/victim"])
def test_a_manifest_cannot_have_a_file_outside_removed(tmp_path, path):
    out = tmp_path / "out"
    write_ok(files(a="1"), out)
    victim = tmp_path / "victim"
    victim.write_text("1")
    (out / "t/link").symlink_to(tmp_path)
    listed = json.loads((out / NAME).read_text())
    hash_of_1 = listed["files"]["t/a"]
    listed["files"] = {"t/a": hash_of_1, path: hash_of_1, str(victim): hash_of_1}
    (out / NAME).write_text(json.dumps(listed))
    assert write_ok(files(a="1"), out).removed == ()
    assert victim.read_text() == "1"


def test_a_link_that_leads_out_is_refused(tmp_path):
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    out = tmp_path / "out"
    out.mkdir()
    (out / "t").symlink_to(elsewhere)
    report = Diagnostics()
    assert write(files(a="1", b="1"), out, report) is None
    (found,) = report  # for all files behind it
    assert found.name == "outside-output"
    assert f"`{out / 't'}`" in found.message
    assert found.notes == (f"it is a symbolic link to `{elsewhere}`",)
    assert found.help == "remove the link; to write there, give that folder with `-o`"
    assert list(elsewhere.iterdir()) == []


def test_a_link_in_place_of_a_file_is_refused_when_it_leads_out(tmp_path):
    victim = tmp_path / "victim"
    victim.write_text("mine")
    (tmp_path / "out/t").mkdir(parents=True)
    (tmp_path / "out/t/a").symlink_to(victim)
    assert errors(files(a="1"), tmp_path / "out", force=True) == ["outside-output"]
    assert victim.read_text() == "mine"


def test_links_that_lead_in_a_circle_are_an_error(tmp_path):
    (tmp_path / "t").symlink_to(tmp_path / "u")
    (tmp_path / "u").symlink_to(tmp_path / "t")
    report = Diagnostics()
    assert write(files(a="1"), tmp_path, report) is None
    assert [found.name for found in report] == ["cannot-write"]


def test_the_output_folder_itself_may_be_a_link(tmp_path):
    (tmp_path / "real").mkdir()
    (tmp_path / "out").symlink_to(tmp_path / "real")
    write_ok(files(a="1"), tmp_path / "out")
    assert (tmp_path / "real/t/a").read_text() == "1"


@pytest.mark.parametrize("obstacle", ["out", "out/t"])
def test_a_file_where_a_folder_is_needed_is_named(tmp_path, obstacle):
    place = tmp_path / obstacle
    place.parent.mkdir(exist_ok=True)
    place.write_text("mine")
    report = Diagnostics()
    assert write(files(a="1", b="1"), tmp_path / "out", report) is None
    (found,) = report
    assert found.name == "cannot-write"
    assert f"`{place}`" in found.message
    assert place.read_text() == "mine"


def test_a_folder_where_a_file_is_to_be_is_an_error(tmp_path):
    (tmp_path / "t/a").mkdir(parents=True)
    assert errors(files(a="1", b="1"), tmp_path, force=True) == ["cannot-write"]


def test_a_pipe_where_a_file_is_to_be_does_not_hang(tmp_path):
    (tmp_path / "t").mkdir()
    os.mkfifo(tmp_path / "t/a")
    report = Diagnostics()
    assert write(files(a="1"), tmp_path, report, WriteOptions(force=True)) is None
    assert [found.name for found in report] == ["cannot-write"]


def test_text_that_is_not_unicode_is_an_error(tmp_path):
    assert errors(files(a="\ud800", b="1"), tmp_path) == ["cannot-write"]


def test_a_name_too_long_for_the_disk_changes_nothing(tmp_path):
    assert errors({"t": [OutputFile("a", "1"), OutputFile("x" * 300, "1")]}, tmp_path) == [
        "cannot-write"
    ]
