"""`swarmc build`: what is made, and what stands in its way."""

import pytest

from swarmdsl.codegen import registry


def test_one_target(swarmc, good, tmp_path):
    ran = swarmc("build", good, "--target", "adf", "-o", tmp_path / "made")
    assert (ran.code, ran.out) == (0, "")
    assert [path.name for path in (tmp_path / "made").iterdir() if path.is_dir()] == ["adf"]
    lines = ran.err.splitlines()
    assert [line.split() for line in lines[:2]] == [["target", "written"], ["adf", "1"]]
    assert lines[2:] == [f"1 file in {tmp_path / 'made'}", "no errors in 1 file"]


def test_a_second_build_touches_nothing(swarmc, good, tmp_path):
    swarmc("build", good, "-t", "scxml", "-t", "adf", "-o", tmp_path / "made")
    before = {path: path.stat().st_mtime_ns for path in (tmp_path / "made").rglob("*")}
    ran = swarmc("build", good, "-t", "scxml", "-t", "adf", "-o", tmp_path / "made")
    assert ran.code == 0
    assert {path: path.stat().st_mtime_ns for path in (tmp_path / "made").rglob("*")} == before
    rows = [line.split() for line in ran.err.splitlines()[:3]]
    assert rows[0] == ["target", "written", "unchanged"]
    assert [row[:2] for row in rows[1:]] == [["scxml", "-"], ["adf", "-"]]


def test_the_default_is_in_out_all_but_what_has_to_be_asked_for(
    swarmc, good, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    ran = swarmc("build", good)
    assert ran.code == 0
    built = {path.name for path in (tmp_path / "out").iterdir()}
    assert {"scxml", "adf"} <= built
    assert not built & registry.ON_REQUEST
    assert set(registry.target_names()) > registry.ON_REQUEST


def test_a_model_with_errors_makes_nothing(swarmc, bad, tmp_path):
    ran = swarmc("build", bad, "-o", tmp_path / "made", "--format", "concise")
    assert ran.code == 1
    assert len(ran.out.splitlines()) == 2
    assert not (tmp_path / "made").exists()


def test_an_edited_file_is_told_until_the_edit_is_given_up(swarmc, good, tmp_path):
    arguments = ("build", good, "-t", "scxml", "-o", tmp_path / "made")
    swarmc(*arguments)
    edited = next((tmp_path / "made" / "scxml").glob("*.scxml"))
    made = edited.read_text()
    edited.write_text("mine")
    ran = swarmc(*arguments)
    assert ran.code == 0
    assert "warning[SW0918]" in ran.out
    assert "--force" in ran.out
    assert edited.read_text() == "mine"
    ran = swarmc(*arguments, "--force")
    assert (ran.code, ran.out) == (0, "")
    assert f"note: `{edited}` was edited, and is overwritten" in ran.err
    assert edited.read_text() == made


def test_what_was_edited_and_is_no_longer_made_is_put_aside(swarmc, good, tmp_path):
    arguments = ("build", good, "-t", "scxml", "-o", tmp_path / "made")
    swarmc(*arguments)
    edited = next((tmp_path / "made" / "scxml").glob("*.scxml"))
    edited.write_text("mine")
    good.write_text(good.read_text().replace("Blinking", "Flashing"))
    ran = swarmc(*arguments)
    assert ran.code == 0
    aside = tmp_path / "made" / ".parked" / "scxml" / edited.name
    assert f"help: it is in `{aside}`" in ran.out
    assert aside.read_text() == "mine"
    good.write_text(good.read_text().replace("Flashing", "Blinking"))
    assert f"note: `{aside}` is now `{edited}`" in swarmc(*arguments).err
    assert edited.read_text() == "mine"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["-t", "scmxl"], "did you mean `scxml`?"),
        (["-t", "scxml", "--option", "scxml.profil=both"], "did you mean `profile`?"),
        (["-t", "scxml", "--option", "scxml.profile=all"], "takes `both`, `portable` or `cpswarm`"),
    ],
)
def test_mistakes_in_targets_and_options_are_wrong_usage(swarmc, good, tmp_path, arguments, words):
    ran = swarmc("build", good, "-o", tmp_path / "made", *arguments)
    assert ran.code == 2
    assert words in ran.out
    assert not (tmp_path / "made").exists()


def test_an_option_is_shown_as_it_was_written(swarmc, good):
    ran = swarmc("build", good, "-t", "smach", "--option", "smach.email=me")
    assert ran.code == 2
    assert ran.out == (
        "error[SW0904]: target `smach`: `me` is not an e-mail address\n"
        " --> <command line>:1:10\n"
        "  |\n"
        "1 | --option smach.email=me\n"
        "  |          ^^^^^^^^^^^^^^\n\n"
    )


@pytest.mark.parametrize("format_", ["github", "sarif"])
def test_what_is_on_the_command_line_is_in_no_file_that_a_program_could_open(swarmc, good, format_):
    option = ("--option", "smach.email=me")
    ran = swarmc("build", good, "-t", "smach", *option, "--format", format_)
    assert "`me` is not an e-mail address" in ran.out
    assert "command" not in ran.out


@pytest.mark.parametrize("option", ["x", "scxml", "scxml=1", "scxml.=1", "adf.x=1"])
def test_options_that_cannot_be_understood_are_wrong_usage(swarmc, good, option):
    ran = swarmc("build", good, "-t", "scxml", "--option", option)
    assert (ran.code, ran.out) == (2, "")
    assert f"`--option {option}`" in ran.err


def test_an_option_reaches_the_target(swarmc, good, tmp_path):
    swarmc(
        *("build", good, "-o", tmp_path, "-t", "scxml", "--option", "scxml.profile=portable"),
    )
    assert [path.name for path in (tmp_path / "scxml").iterdir()] == ["Blinking.scxml"]


def test_the_ir_goes_to_stdout_and_nothing_is_written(swarmc, good, tmp_path):
    ran = swarmc("build", good, "--dump-ir", "-o", tmp_path / "made")
    assert ran.code == 0
    assert ran.out.startswith("System lamps\n")
    assert "OutcomeTrigger state=Blink outcome=succeeded" in ran.out
    assert ran.err == "no errors in 1 file\n"
    assert not (tmp_path / "made").exists()


def test_diagnostics_do_not_mix_with_the_ir(swarmc, bad):
    ran = swarmc("build", bad, "--dump-ir")
    assert (ran.code, ran.out) == (1, "")
    assert "error[SW0202]" in ran.err


@pytest.mark.parametrize("obstacle", ["made", "made/scxml"])
def test_a_file_in_place_of_the_output_folder(swarmc, good, tmp_path, obstacle):
    (tmp_path / obstacle).parent.mkdir(exist_ok=True)
    (tmp_path / obstacle).write_text("mine")
    ran = swarmc("build", good, "-t", "scxml", "-o", tmp_path / "made")
    assert ran.code == 1
    assert "error[SW0909]" in ran.out
    assert (tmp_path / obstacle).read_text() == "mine"
