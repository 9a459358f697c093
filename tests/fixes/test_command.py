"""`swarmc check --fix`: what is written, printed and left alone."""

import json

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.cli import fix_command
from swarmdsl.cli import run as command
from swarmdsl.driver.fixes.application import fix_all
from swarmdsl.syntax.formatter import format_source

MODEL = """\
package lamps

event Go : std_msgs/Empty

enum Mode {
  OFF
  ON
}

endless statemachine Lamp {
  var mode : Mode = OFF

  initial Dark

  state Dark {
    on Go [mode == Mode.OFF] -> Brihgt
  }

  state Bright {
    on Go, Go -> Dark
  }
}

member Robot {
  behavior Lamp
}

swarm Lamps {
  robot : Robot[2]
}
"""


@pytest.fixture
def model(tmp_path):
    path = tmp_path / "lamps.swarm"
    path.write_text(MODEL, encoding="utf-8")
    return path


@pytest.fixture
def swarmc(capsys):
    def run(*words):
        code = command([str(word) for word in words])
        printed = capsys.readouterr()
        return code, printed.out, printed.err

    return run


def test_safe_fixes_are_written(swarmc, model):
    _, _, err = swarmc("check", model)
    said = "3 problems can be fixed with `--fix --unsafe-fixes`, 2 of them with `--fix` alone\n"
    assert err.endswith(f"file\n{said}")
    code, out, err = swarmc("check", model, "--fix", "--format", "concise")
    after = model.read_text()
    assert after == MODEL.replace("= OFF", "= Mode.OFF").replace("Go, Go", "Go")
    assert (code, out.count("\n")) == (1, 1)
    assert "Brihgt" in out
    assert "Change to `Mode.OFF`" in err
    assert "Remove `Go`" in err
    assert "2 problems in 1 file fixed\n1 error in 1 file\n" in err
    assert swarmc("check", model, "--fix", "--unsafe-fixes")[0] == 0
    assert "fixed with" not in swarmc("check", model)[2]
    assert model.read_text() == after.replace("Brihgt", "Bright")
    assert format_source(Source("m.swarm", model.read_text()), Diagnostics()) == model.read_text()


def test_diff_writes_nothing(swarmc, model):
    code, out, err = swarmc("check", model, "--diff", "--unsafe-fixes")
    assert code == 1
    assert model.read_text() == MODEL
    assert (
        "-    on Go [mode == Mode.OFF] -> Brihgt\n+    on Go [mode == Mode.OFF] -> Bright\n" in out
    )
    assert "3 problems in 1 file would be fixed\n" in err


def test_other_bytes_stay(swarmc, model):
    model.write_bytes(b"\xef\xbb\xbf" + MODEL.replace("\n", "\r\n").encode())
    swarmc("check", model, "--fix")
    text = MODEL.replace("= OFF", "= Mode.OFF").replace("Go, Go", "Go")
    assert model.read_bytes() == b"\xef\xbb\xbf" + text.replace("\n", "\r\n").encode()


def test_a_broken_file_gets_syntax_fixes_only(swarmc, model):
    text = MODEL.replace("event Go :", "event Go : :")
    model.write_text(text)
    assert swarmc("check", model, "--fix", "--unsafe-fixes")[0] == 1
    assert model.read_text() == text
    model.write_text(MODEL.replace("  ON\n", "  ON /// bright\n"))
    code, _, err = swarmc("check", model, "--fix", "--unsafe-fixes")
    assert code == 0, err
    assert "  /// bright\n" in model.read_text()


def test_a_fix_that_would_cause_an_error_is_undone(swarmc, model):
    text = MODEL.replace("Brihgt", "Bright").replace("= OFF", "= Mode.OFF").replace("Go, Go", "Go")
    text = text.replace(
        "event Go : std_msgs/Empty", "event Go : std_msgs/Empty\nevent Good : lamps/X"
    )
    model.write_text(text)
    swarmc("check", model, "--fix", "--unsafe-fixes")
    assert "event Good : lamps/X" in model.read_text()


def test_programs_get_the_fixes(swarmc, model):
    _, out, _ = swarmc("check", model, "--format", "json")
    found = {each["line"]: each["fixes"] for each in map(json.loads, out.splitlines())}
    [edit] = found[11][0]["edits"]
    assert (found[11][0]["safe"], edit["text"], edit["column"]) == (True, "Mode.OFF", 21)
    assert found[16][0]["safe"] is False
    _, out, _ = swarmc("check", model, "--format", "sarif")
    results = json.loads(out)["runs"][0]["results"]
    [change] = results[0]["fixes"][0]["artifactChanges"]
    [replacement] = change["replacements"]
    assert replacement["insertedContent"]["text"] == "Mode.OFF"
    assert replacement["deletedRegion"]["startLine"] == 11


@pytest.mark.parametrize(
    "words", [("--unsafe-fixes",), ("--watch", "--fix"), ("--watch", "--diff")]
)
def test_options_that_do_not_fit(swarmc, model, words):
    code, _, err = swarmc("check", model, *words)
    assert code == 2
    assert "`--" in err


def test_a_file_that_changes_meanwhile_stays_as_it_is(swarmc, model, monkeypatch):
    """Another program writes it after it was read, or removes it."""

    def meanwhile(act):
        def fixed(*given, **named):
            done = fix_all(*given, **named)
            act()
            return done

        monkeypatch.setattr(fix_command, "fix_all", fixed)
        return swarmc("check", model, "--fix", "--format", "concise")

    code, out, _ = meanwhile(lambda: model.write_text("event Other : std_msgs/Empty\n"))
    assert (code, model.read_text()) == (1, "event Other : std_msgs/Empty\n")
    assert "error[SW0909]" in out
    assert "another program has changed it meanwhile" in out
    model.write_text(MODEL)
    code, out, _ = meanwhile(model.unlink)
    assert (code, model.exists()) == (1, False)
    assert "error[SW0001]" in out


def test_files_of_corrected_imports_are_fixed(swarmc, model):
    modes = model.with_name("modes.swarm")
    modes.write_text("package modes\n\nevent Off : std_msgs/Emty\n")
    model.write_text(MODEL.replace("\n\nevent Go", '\n\nimport "mods.swarm"\n\nevent Go', 1))
    code, _, err = swarmc("check", model, "--fix", "--unsafe-fixes")
    assert code == 0, err
    assert 'import "modes.swarm"' in model.read_text()
    assert "std_msgs/Empty" in modes.read_text()


def test_declarations_of_files_beside_are_imported(swarmc, model):
    """Nothing is declared a second time; one that several files have is no certain choice."""
    events = model.with_name("events.swarm")
    events.write_text("package events\n\nswarm operator event Go : std_msgs/Empty\n")
    wrong = MODEL.replace("Brihgt", "Bright").replace("event Go : std_msgs/Empty\n\n", "")
    model.write_text(wrong)
    assert swarmc("check", model, "--fix")[0] == 0
    assert model.read_text().count("Go : ") == 0
    assert 'import "events.swarm"\n' in model.read_text()
    model.with_name("more.swarm").write_text("package more\n\nevent Go : std_msgs/Empty\n")
    model.write_text(wrong)
    assert swarmc("check", model, "--fix")[0] == 1
    assert "import" not in model.read_text()
    _, out, _ = swarmc("check", model)
    assert 'add `import "events.swarm"` or `import "more.swarm"`\n' in out
    assert swarmc("check", model, "--fix", "--unsafe-fixes")[0] == 0


def test_files_outside_of_the_project_stay_as_they_are(swarmc, model):
    other = model.parent / "elsewhere" / "other.swarm"
    inside = model.parent / "inside" / "lamps.swarm"
    for path, text in ((other, "event Off : std_msgs/Emty\n"), (inside, MODEL)):
        path.parent.mkdir()
        path.write_text(text)
    inside.write_text(MODEL.replace("\n\n", '\n\nimport "../elsewhere/other.swarm"\n\n', 1))
    for option in ("--fix", "--diff"):
        code, out, err = swarmc("check", inside, option, "--unsafe-fixes", "--format", "concise")
        assert code == 1
        assert "SW0017" in out + err
        assert "---" not in out
    assert other.read_text() == "event Off : std_msgs/Emty\n"
