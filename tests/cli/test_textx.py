"""The language and its targets in textX's own command line."""

import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner
from textx import TextXError
from textx.cli import textx as command_line

from swarmdsl.cli import textx
from swarmdsl.codegen import registry
from swarmdsl.driver import pipeline

DIAGNOSTICS = Path(__file__).resolve().parents[1] / "diagnostics"
TEXTX = "from textx.cli import textx; textx()"


def run_textx(*arguments: object) -> "subprocess.CompletedProcess[str]":
    command = [sys.executable, "-c", TEXTX, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True)


def test_the_language_is_listed():
    listed = run_textx("list-languages")
    assert "swarm (*.swarm)" in listed.stdout + listed.stderr


def test_the_bundled_targets_are_listed():
    listed = run_textx("list-generators")
    for target in registry.BUILT_IN:
        assert f"swarm -> {target}" in listed.stdout + listed.stderr
        assert getattr(textx, target).description


def test_check_of_good_models(examples):
    ran = run_textx("check", *sorted(examples.rglob("*.swarm")))
    assert ran.returncode == 0, ran.stderr


def test_check_says_where_the_first_mistake_is(bad):
    ran = run_textx("check", bad)
    assert ran.returncode == 1
    assert f"{bad}:8:21: no state called `Of`" in ran.stderr
    assert "and 1 more; run `swarmc check`" in ran.stderr
    assert "Traceback" not in ran.stderr


def test_check_agrees_with_swarmc(examples):
    """In the process: as a command it would take a second each."""
    models = [*examples.rglob("*.swarm"), *DIAGNOSTICS.glob("*.swarm")]
    # Of nothing textX makes no model, and so nothing is checked.
    nothing = {"SW0005_comments_only.swarm", "SW0005_empty.swarm"}
    metamodel = textx.swarm.metamodel()
    wrong = 0
    for model in sorted(model for model in models if model.name not in nothing):
        if pipeline.check([model]).report.has_errors:
            wrong += 1
            with pytest.raises((TextXError, UnicodeDecodeError)):
                metamodel.model_from_file(str(model))
        else:
            metamodel.model_from_file(str(model))
    assert 20 < wrong < len(models) - 20


def test_check_of_a_file_with_a_syntax_error(tmp_path):
    path = tmp_path / "x.swarm"
    path.write_text("member {")
    ran = run_textx("check", path)
    assert ran.returncode == 1
    assert f"{path}:1:" in ran.stderr
    assert "Traceback" not in ran.stderr


def test_check_of_a_deep_model(tmp_path):
    path = tmp_path / "deep.swarm"
    depth = 100
    inner = "state A { initial A\n" * depth + "}" * depth
    path.write_text(f"statemachine M {{ initial A\n{inner}\nfinal F }}\n")
    ran = run_textx("check", path)
    assert ran.returncode == 1
    assert "nested deeper than" in ran.stderr


def test_generate_without_a_model():
    ran = run_textx("generate", "--language", "swarm", "--target", "scxml", "--profile", "portable")
    assert ran.returncode == 1
    assert "give a .swarm file to generate from" in ran.stderr


def test_generate(good, tmp_path):
    for target in ("scxml", "adf"):
        ran = run_textx("generate", good, "--target", target, "-o", tmp_path / "made")
        assert ran.returncode == 0, ran.stderr
        files = [path for path in (tmp_path / "made" / target).rglob("*") if path.is_file()]
        assert files, target


def test_generate_for_other_tools(examples, tmp_path):
    """In the process: as a command it would take a second each."""
    model = examples / "emergency_exit" / "emergency_exit.swarm"
    for target in sorted(registry.ON_REQUEST):
        arguments = ["generate", str(model), "--target", target, "-o", str(tmp_path)]
        ran = CliRunner().invoke(command_line, arguments)
        assert ran.exit_code == 0, ran.output
        assert [path for path in (tmp_path / target).rglob("*") if path.is_file()], target


def test_generate_with_an_option(good, tmp_path):
    ran = run_textx(
        *("generate", good, "--target", "scxml", "-o", tmp_path, "--profile", "portable"),
    )
    assert ran.returncode == 0, ran.stderr
    assert [path.name for path in (tmp_path / "scxml").iterdir()] == ["Blinking.scxml"]


def test_generate_overwrites_only_when_told(good, tmp_path):
    run_textx("generate", good, "--target", "scxml", "-o", tmp_path)
    edited = next((tmp_path / "scxml").glob("*.scxml"))
    edited.write_text("mine")
    good.write_text(good.read_text().replace("Off", "Dark"))
    refused = run_textx("generate", good, "--target", "scxml", "-o", tmp_path)
    assert refused.returncode == 1
    assert "the generator changes edited lines" in refused.stderr
    assert edited.read_text() == "mine"
    forced = run_textx("generate", good, "--target", "scxml", "-o", tmp_path, "--overwrite")
    assert forced.returncode == 0, forced.stderr
    assert edited.read_text() != "mine"


def test_generate_from_a_model_with_mistakes(bad, tmp_path):
    ran = run_textx("generate", bad, "--target", "scxml", "-o", tmp_path / "made")
    assert ran.returncode == 1
    assert not (tmp_path / "made").exists()


def test_the_metamodel_is_textx_s_own_and_checks(good):
    made = textx.swarm.metamodel()
    assert type(made.model_from_file(str(Path(good)))).__name__ == "Model"


def test_the_project_file_counts(tmp_path, good):
    (tmp_path / "lib").mkdir()
    (tmp_path / "lib" / "kit.swarm").write_text("package kit\nevent Go : std_msgs/Empty\n")
    good.write_text("import kit.*\n" + good.read_text().removeprefix("package lamps\n"))
    assert "no package called `kit`" in run_textx("check", good).stderr
    settings = '[project]\nlibraries = ["lib"]\n[targets.scxml]\nprofile = "portable"\n'
    (tmp_path / "swarm.toml").write_text(settings)

    assert run_textx("check", good).returncode == 0
    out = tmp_path / "out"
    assert run_textx("generate", good, "--target", "scxml", "-o", out).returncode == 0
    assert [path.name for path in (out / "scxml").iterdir()] == ["Blinking.scxml"]
    (tmp_path / "swarm.toml").write_text("[nothing]\n")
    assert f"{tmp_path / 'swarm.toml'}:1:2: " in run_textx("check", good).stderr
