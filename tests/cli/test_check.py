"""`swarmc check`: what is printed where, and the exit code."""

import json

import pytest


def test_a_good_model(swarmc, good):
    ran = swarmc("check", good)
    assert (ran.code, ran.out, ran.err) == (0, "", "no errors in 1 file\n")


def test_every_mistake_is_found_in_one_run(swarmc, bad):
    ran = swarmc("check", bad)
    assert ran.code == 1
    assert f" --> {bad}:8:21\n" in ran.out
    assert "8 |     on aborted   -> Of\n" in ran.out
    assert "did you mean `Blinking`?" in ran.out
    fixable = "2 problems can be fixed with `--fix --unsafe-fixes`\n"
    assert ran.err == f"2 errors in 1 file\n{fixable}"


def test_one_line_each(swarmc, bad):
    lines = swarmc("check", bad, "--format", "concise").out.splitlines()
    assert [line.partition(": error[SW0202]")[0] for line in lines] == [
        f"{bad}:8:21",
        f"{bad}:12:27",
    ]


def test_json_lines(swarmc, bad):
    ran = swarmc("check", bad, "--format", "json")
    found = [json.loads(line) for line in ran.out.splitlines()]
    assert [(one["line"], one["name"]) for one in found] == [
        (8, "unresolved-name"),
        (12, "unresolved-name"),
    ]


def test_a_folder_stands_for_all_models_below_it(swarmc, good, bad, tmp_path):
    below = tmp_path / "models" / "deep"
    below.mkdir(parents=True)
    good.rename(below / "good.swarm")
    bad.rename(tmp_path / "elsewhere.swarm")
    assert swarmc("check", tmp_path / "models").err == "no errors in 1 file\n"


def test_no_file_stands_for_the_current_folder(swarmc, bad, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    ran = swarmc("check", "--format", "concise")
    assert ran.code == 1
    assert ran.out.startswith("bad.swarm:8:21: ")


def test_a_missing_file(swarmc, tmp_path):
    ran = swarmc("check", tmp_path / "nowhere.swarm")
    assert ran.code == 1
    assert "error[SW0001]: no such file" in ran.out


def test_a_folder_without_models(swarmc, tmp_path):
    ran = swarmc("check", tmp_path)
    assert ran.code == 1
    assert "error[SW0007]" in ran.out


@pytest.mark.parametrize("name", ["x.swarm", "[bold]x.swarm", "a b.swarm", "日本.swarm"])
@pytest.mark.parametrize("content", [b"\xff\xfe\x00", b"\x00", b"", b"\x1b[31m"])
def test_a_file_that_is_no_model(swarmc, tmp_path, name, content):
    path = tmp_path / name
    path.write_bytes(content)
    ran = swarmc("check", path)
    assert ran.code == 1
    assert name in ran.out
    assert "\x1b" not in ran.out


def test_wrong_usage(swarmc, good):
    for arguments in (["check", "--nonsense"], ["nonsense"], ["check", good, "--format", "xml"]):
        ran = swarmc(*arguments)
        assert (ran.code, ran.out) == (2, "")
        assert "Usage: swarmc" in ran.err


def test_a_bug_of_ours_is_called_one(swarmc, good, monkeypatch):
    from swarmdsl.driver import pipeline

    monkeypatch.setattr(pipeline, "validate", lambda project, report: {}["gone"])
    ran = swarmc("check", good)
    assert (ran.code, ran.out) == (3, "")
    assert "swarmc: internal error: KeyError: 'gone'\nthis is a bug in swarmc" in ran.err
    assert "Traceback" not in ran.err


def test_ctrl_c_is_quiet(swarmc, good, monkeypatch):
    from swarmdsl.driver import pipeline

    def interrupt(project, report):
        raise KeyboardInterrupt

    monkeypatch.setattr(pipeline, "validate", interrupt)
    ran = swarmc("check", good)
    assert (ran.code, ran.out, ran.err.strip()) == (130, "", "")
