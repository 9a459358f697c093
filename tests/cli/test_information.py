"""`swarmc targets`, `explain`, `--help` and `--version`."""

import json
from importlib.metadata import version

import pytest

from swarmdsl.base.diagnostics import explain
from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.cli import COMMANDS
from swarmdsl.codegen import registry

PAGES = sorted(explain.page_path("SW0000").parent.glob("*.md"))


def test_the_list_of_targets(swarmc):
    ran = swarmc("targets")
    assert ran.code == 0
    named = [line.split()[0] for line in ran.out.splitlines()]
    assert named[: len(registry.BUILT_IN)] == list(registry.BUILT_IN)


def test_one_target(swarmc):
    ran = swarmc("targets", "scxml")
    assert (ran.code, ran.err) == (0, "")
    assert ran.out.startswith("scxml: ")
    assert "--option scxml.NAME=VALUE" in ran.out


@pytest.mark.parametrize("target", ["scxml", "ros2", "smach", "skeleton"])
def test_what_a_table_rejects_is_not_said_to_be_expressed(swarmc, target):
    page = swarmc("targets", target).out
    assert ("cannot express\n" in page) != ("can express every construct" in page)
    exceptions = "can express every construct" in page and "rejected  " in page
    assert ("except what is rejected below\n" in page) == exceptions


def test_a_target_that_has_to_be_asked_for_says_so(swarmc):
    assert "built on request only: `--target amf`" in swarmc("targets", "amf").out
    assert "asked for" not in swarmc("targets", "adf").out


def test_what_depends_on_an_option(swarmc):
    page = swarmc("targets", "smach").out
    assert "takes `true` or `false`; default: false; counts only with `ros=2`" in page
    _, for_ros_1, for_ros_2 = page.split("translation of the constructs of a model")
    assert for_ros_2.startswith(" with `smach.ros=2`\n")
    assert "`On(events.`" in for_ros_1
    (found,) = json.loads(swarmc("targets", "smach", "--format", "json").out)
    options = {each["name"]: each.get("counts_only_with") for each in found["options"]}
    assert (options["package"], options["lifecycle"]) == (None, "ros=2")
    assert found["mapping_with"]["ros=2"][0]["construct"] == "state with an action"


def test_targets_as_json(swarmc):
    found = json.loads(swarmc("targets", "--format", "json").out)
    assert [one["name"] for one in found][: len(registry.BUILT_IN)] == list(registry.BUILT_IN)


def test_an_unknown_target(swarmc):
    ran = swarmc("targets", "smahc")
    assert (ran.code, ran.out) == (2, "")
    assert "did you mean `smach`?" in ran.err


@pytest.mark.parametrize("command", [["targets"], ["build", "--target"], ["new", "x", "-t"]])
def test_ros_1_is_no_misspelt_ros_2(swarmc, command, good, monkeypatch):
    monkeypatch.chdir(good.parent)
    ran = swarmc(*command, "ros1")
    assert ran.code == 2
    assert "ROS 1 is target `smach`" in ran.out + ran.err


def test_an_unknown_command(swarmc):
    ran = swarmc("biuld")
    assert (ran.code, ran.out) == (2, "")
    assert "there is no command `biuld`: did you mean `build`?" in ran.err
    assert "`swarmc --help` lists all" in swarmc("fly").err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("build --tagret ros2", "there is no option `--tagret`: did you mean `--target`?"),
        ("check --target ros2", "no option `--target` here: `swarmc build` has `--target`"),
        ("add --kindd x sensor y", "option `--kindd` here: `swarmc add component` has `--kind`"),
        ("check --qqq", "there is no option `--qqq`\n"),
        ("build --format jsn", "'sarif': did you mean `json`?"),
        ("build --format poetry", "'sarif'."),
        ("new x -t rso2", "did you mean `ros2`?"),
        ("add functoin count", "there is no command `functoin`: did you mean `function`?"),
        ("import fly", "`swarmc import --help` lists all"),
        ("build -t ros2 --option distro=x", "TARGET.NAME=VALUE: write `ros2.distro=x`"),
        ("build -t ros2 --option smach.x=1", "`smach` is not built: add `--target smach`"),
        ("build -t ros2 --option rso2.x=1", "`rso2` is not built: did you mean `ros2`?"),
    ],
)
def test_a_word_of_the_command_line_that_means_nothing(swarmc, words, said):
    ran = swarmc(*words.split())
    assert (ran.code, ran.out) == (2, "")
    assert said in ran.err


def test_a_model_whose_ending_is_misspelt(swarmc, tmp_path):
    (tmp_path / "patrol.swarm").touch()
    ran = swarmc("check", str(tmp_path / "patrol.swarn"))
    assert ran.code == 1
    assert "did you mean `patrol.swarm`?" in ran.out


@pytest.mark.parametrize(
    "word", ["SW0908", "sw0908", "908", "0908", "would-overwrite", "Would-Overwrite"]
)
def test_a_page_is_found_by_code_and_by_name(swarmc, word):
    ran = swarmc("explain", word)
    assert (ran.code, ran.err) == (0, "")
    assert ran.out.startswith("# SW0908 would-overwrite\n")


def test_a_word_that_is_no_diagnostic(swarmc):
    ran = swarmc("explain", "unresolvd-name")
    assert (ran.code, ran.out) == (2, "")
    assert "did you mean `unresolved-name`?" in ran.err


def test_the_list_of_diagnostics(swarmc):
    lines = swarmc("explain").out.splitlines()
    assert [line.split()[:2] for line in lines] == [
        [entry.code, name] for name, entry in CODES.items()
    ]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_pages_have_one_form(page):
    names = {entry.code: name for name, entry in CODES.items()}
    headings = [line for line in page.read_text(encoding="utf-8").splitlines() if line[:1] == "#"]
    assert headings == [
        f"# {page.stem} {names[page.stem]}",
        "## What it means",
        "## Example",
        "## Way out",
    ]


def test_version(swarmc):
    assert swarmc("--version").out == f"swarmc, version {version('swarmdsl')}\n"


@pytest.mark.parametrize("command", [None, *COMMANDS])
def test_help_has_an_example(swarmc, command):
    ran = swarmc(*([command] if command else []), "--help")
    assert ran.code == 0
    assert "Example: swarmc " in ran.out
