"""Effects of `swarm.toml`, and diagnostics for errors in it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics import explain
from swarmdsl.driver import pipeline

from .conftest import ISLAND, MODEL

UNREACHABLE = "lamps.swarm:10:9: {}[SW0503] state `Island` is unreachable\n"
# `Start` comes from an operator.
UNSENT = """\
swarm event Start : std_msgs/Empty

statemachine Hop {
  initial Idle
  state Idle { on Start -> Done }
  final Done
}
"""
# Without the dialect that lacks delays, which would give a warning.
PORTABLE = "[targets.scxml]\nprofile = 'portable'\n"


@pytest.mark.parametrize(
    ("toml", "lines"),
    [
        (
            "x = " + "[" * 999,
            ["1:1: error[SW0011] `swarm.toml` is not valid TOML: TOML inline arrays"],
        ),
        (
            "[project\n",
            ["1:9: error[SW0011] `swarm.toml` is not valid TOML: expected ']' at the end"],
        ),
        (
            '[project]\nnam = "x"\n[lints]\n[build]\nout = 3\n',
            [
                "2:1: error[SW0012] `[project]` has no key `nam`",
                "3:2: error[SW0012] `swarm.toml` has no key `lints`",
                "5:7: error[SW0013] `out` takes a string, not a whole number",
            ],
        ),
        (
            "[project]\nname = 'a'\nname = 'b'\n",
            ["3:1: error[SW0011] `swarm.toml` is not valid TOML: `name` overwrites what is given"],
        ),
        (
            "[project]\nsources = [ ]",
            ["2:11: error[SW0013] `sources` takes files and folders, not nothing"],
        ),
        ("project = 3", ["1:11: error[SW0013] `project` takes a table: `[project]`, not a whole"]),
        (
            '[project]\nname = "no name"\nsources = "m"\nlibraries = ["gone", "swarm.toml", 1]',
            [
                "2:8: error[SW0013] `name` takes a name like `sar` or `rescue.sea`, not `no name`",
                "3:11: error[SW0013] `sources` takes a list of strings, not a string",
                "4:14: error[SW0001] no such file: `gone`",
                "4:22: error[SW0013] `libraries` takes folders, not the file `swarm.toml`",
                "4:36: error[SW0013] `libraries` takes a string, not a whole number",
            ],
        ),
        (
            """[targets]
adf = true
[targets.scmxl]
[targets.scxml]
profil = 'both'
[targets.smach]
package = 1.5
""",
            [
                "2:7: error[SW0013] `adf` takes a table of options, not a boolean",
                "3:10: error[SW0901] no target called `scmxl`",
                "5:1: error[SW0904] target `scxml`: there is no option `profil`",
                "7:11: error[SW0013] `package` takes a string, not a number",
            ],
        ),
        (
            """[targets.smach]
license = 3
version = '1.x'
email = "nope"
package = 'Bad Name'
[targets.scxml]
profile = true
""",
            [
                "2:11: error[SW0013] `license` takes a string, not a whole number",
                "3:1: error[SW0904] target `smach`: `1.x` is not a version: expected t",
                "4:1: error[SW0904] target `smach`: `nope` is not an e-mail address",
                "5:1: error[SW0904] target `smach`: `Bad Name` cannot be the name of the package",
                "7:11: error[SW0013] `profile` takes `both`, `portable` or `cpswarm`, not a boole",
            ],
        ),
        (
            """[lint]
allow = ['unreachable-sate', 'SW0503', 'SW0202']
deny = ['unreachable-state']
warn = ['unresolved-name', 1979-05-27]
""",
            [
                "2:10: error[SW0014] there is no diagnostic `unreachable-sate`",
                "2:40: error[SW0015] `unresolved-name` is an error and cannot be downgraded",
                "3:9: error[SW0404] the level of `unreachable-state` is given twice",
                "4:9: error[SW0015] `unresolved-name` is an error and cannot be downgraded",
                "4:28: error[SW0013] `warn` takes a string, not a time",
            ],
        ),
    ],
)
def test_mistakes_are_reported_at_their_lines(swarmc, project, toml, lines) -> None:
    project({"swarm.toml": toml, "broken.swarm": "nonsense"})
    ran = swarmc("check", "--format", "concise")

    assert ran.code == 1
    found = ran.out.splitlines()
    assert [line[: len(start) + 11] for line, start in zip(found, lines, strict=True)] == [
        f"swarm.toml:{start}" for start in lines
    ]
    assert ran.err.endswith("in 1 file\n")


def test_mistakes_have_hints(swarmc, project) -> None:
    project({"swarm.toml": "[project]\nlibary = 1\n[lint]\ndeny = ['unreachable-sate']\n"})
    ran = swarmc("check")

    assert "did you mean `libraries`?" not in ran.err
    assert "did you mean `libraries`?" in ran.out
    assert "did you mean `unreachable-state`?" in ran.out
    assert " --> swarm.toml:2:1\n" in ran.out


@pytest.mark.parametrize("data", [b"\xff\xfe", b"\x00", b"a = '\xe4'"])
def test_a_project_file_that_is_no_text(swarmc, project, data) -> None:
    (project({"lamps.swarm": MODEL}) / "swarm.toml").write_bytes(data)
    ran = swarmc("check", "--format", "concise")

    assert ran.code == 1
    assert "error[SW0004] `swarm.toml` is not UTF-8 text" in ran.out


@pytest.mark.parametrize("toml", ["", "[project]\n[targets]\n[lint]\n[build]\n"])
def test_an_empty_project_file(swarmc, project, toml) -> None:
    project({"swarm.toml": toml, "models/lamps.swarm": MODEL})

    assert swarmc("check").err == "no errors in 1 file\n"


def test_nothing_to_compile_is_no_system() -> None:
    result = pipeline.check([])

    assert [found.name for found in result.report] == ["nothing-to-compile"]
    assert result.system is None


def test_sources_are_those_of_the_project_wherever_one_is(swarmc, project, monkeypatch) -> None:
    root = project(
        {
            "swarm.toml": "[project]\nsources = ['models']\n",
            "models/lamps.swarm": ISLAND,
            "old/lamps.swarm": "nonsense",
        }
    )
    expected = UNREACHABLE.format("warning")
    assert swarmc("check", "--format", "concise").out == f"models/{expected}"

    monkeypatch.chdir(root / "old")
    assert swarmc("check", "--format", "concise").out == f"../models/{expected}"
    # A named file is checked alone.
    assert "SW0101" in swarmc("check", "lamps.swarm", "--format", "concise").out


def test_the_project_is_that_of_the_first_file(swarmc, project, monkeypatch, tmp_path) -> None:
    root = project({"swarm.toml": "[lint]\ndeny = ['warnings']\n", "a/b/lamps.swarm": ISLAND})
    monkeypatch.chdir(tmp_path)
    path = root / "a" / "b" / "lamps.swarm"

    assert swarmc("check", path).code == 1
    assert swarmc("check", path.parent).code == 1
    assert swarmc("check", path.relative_to(tmp_path)).code == 1


@pytest.mark.parametrize(
    ("toml", "arguments", "severity"),
    [
        ("", [], "warning"),
        ("allow = ['unreachable-state']", [], None),
        ("allow = ['SW0503']", [], None),
        ("allow = ['warnings']", [], None),
        ("deny = ['unreachable-state']", [], "error"),
        ("deny = ['warnings']", [], "error"),
        ("deny = ['warnings']\nwarn = ['unreachable-state']", [], "warning"),
        ("deny = ['unresolved-name']", [], "warning"),
        ("deny = ['unreachable-state']", ["--warn", "SW0503"], "warning"),
        ("deny = ['warnings']", ["--warn", "unreachable-state"], "warning"),
        ("allow = ['warnings']", ["--warn", "warnings"], "warning"),
        ("deny = ['unhandled-outcome', 'shared-callback']", [], "warning"),
        ("", ["--allow", "unreachable-state"], None),
        ("", ["--deny", "unreachable-state"], "error"),
        ("", ["--deny", "warnings"], "error"),
        ("", ["--deny", "warnings", "--allow", "sw0503"], None),
        ("deny = ['warnings']", ["--allow", "unreachable-state"], None),
        ("deny = ['unreachable-state']", ["--allow", "SW0503"], None),
        ("allow = ['unreachable-state']", ["--deny", "warnings"], None),
    ],
)
@pytest.mark.parametrize("command", ["check", "build"])
def test_levels(swarmc, project, command, toml, arguments, severity) -> None:
    root = project({"swarm.toml": f"[lint]\n{toml}\n{PORTABLE}", "lamps.swarm": ISLAND})
    ran = swarmc(command, *arguments, "--format", "concise")

    assert ran.out == (UNREACHABLE.format(severity) if severity else "")
    assert ran.code == (1 if severity == "error" else 0)
    assert (root / "out").exists() == (command == "build" and ran.code == 0)


@pytest.mark.parametrize(
    ("toml", "arguments", "severity"),
    [
        ("", [], None),
        ("warn = ['warnings']", [], None),
        ("deny = ['warnings']", [], None),
        ("warn = ['unsent-event']", [], "warning"),
        ("warn = ['unsent-event']\ndeny = ['warnings']", [], "warning"),
        ("warn = ['unsent-event']\nallow = ['warnings']", [], "warning"),
        ("deny = ['SW0523']", [], "error"),
        ("deny = ['unsent-event']", ["--allow", "unsent-event"], None),
        ("", ["--warn", "unsent-event"], "warning"),
        ("", ["--deny", "unsent-event"], "error"),
        ("", ["--deny", "warnings", "--warn", "unsent-event"], "warning"),
    ],
)
def test_silent_warnings_are_asked_for_by_name(swarmc, project, toml, arguments, severity) -> None:
    project({"swarm.toml": f"[lint]\n{toml}\n", "hop.swarm": UNSENT})
    ran = swarmc("check", *arguments, "--format", "concise")

    found = f"hop.swarm:5:19: {severity}[SW0523] event `Start` is never sent\n"
    assert ran.out == (found if severity else "")
    assert ran.code == (1 if severity == "error" else 0)


def test_a_denied_warning_of_a_generator_stops_the_build(swarmc, project) -> None:
    root = project({"swarm.toml": "", "lamps.swarm": "package p\nevent E : std_msgs/Empty\n"})
    ran = swarmc("build", "-t", "adf", "--deny", "nothing-to-generate", "--format", "concise")

    assert (ran.code, ran.out) == (1, "error[SW0910] target `adf` found nothing to generate\n")
    assert not (root / "out").exists()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--allow", "unreachable-sate"], "did you mean `unreachable-state`?"),
        (["--deny", "SW9999"], "there is no diagnostic `SW9999`"),
        (["--allow", "unresolved-name"], "errors cannot be allowed"),
        (["--warn", "unresolved-name"], "errors cannot be allowed"),
        (["--allow", "SW0503", "--deny", "unreachable-state"], "`--allow` names `unreachable-st"),
        (["--warn", "warnings", "--deny", "warnings"], "`--warn` names `warnings` too"),
    ],
)
def test_wrong_levels_on_the_command_line_are_wrong_usage(
    swarmc, project, arguments, words
) -> None:
    project({"lamps.swarm": MODEL})
    ran = swarmc("check", *arguments)

    assert (ran.code, ran.out) == (2, "")
    assert words in ran.err


def made(root: Path) -> set[str]:
    return {path.name for path in root.iterdir() if path.is_dir()} if root.exists() else set()


def test_targets_options_and_output_of_the_project(swarmc, project, monkeypatch) -> None:
    root = project(
        {
            "swarm.toml": "[targets.scxml]\nprofile = 'portable'\n[targets.adf]\n"
            "[build]\nout = 'made/here'\n",
            "lamps.swarm": MODEL,
            "below/x.txt": "",
        }
    )
    monkeypatch.chdir(root / "below")
    assert swarmc("build").code == 0
    assert made(root / "made" / "here") == {"scxml", "adf"}
    portable = {path.name for path in (root / "made/here/scxml").iterdir()}

    # The command line wins over the project file.
    assert swarmc("build", "-t", "scxml", "-o", "own").code == 0
    assert made(root / "below" / "own") == {"scxml"}
    assert {path.name for path in (root / "below/own/scxml").iterdir()} == portable
    assert swarmc("build", "--option", "scxml.profile=both", "-o", "all").code == 0
    assert made(root / "below" / "all") == {"scxml", "adf"}
    assert {path.name for path in (root / "below/all/scxml").iterdir()} > portable


def test_a_target_of_the_project_is_not_left_out(swarmc, project) -> None:
    model = MODEL.replace(
        "on succeeded, aborted -> Off", "on succeeded, aborted -> Off\n    after 1 s -> Off"
    )
    project(
        {"swarm.toml": "[targets.scxml]\nprofile = 'cpswarm'\n[targets.adf]\n", "m.swarm": model}
    )
    ran = swarmc("build", "--format", "concise")

    assert ran.code == 1
    assert "error[SW0903]" in ran.out


def test_options_of_targets_that_are_not_built_are_wrong_usage(swarmc, project) -> None:
    project({"swarm.toml": "[targets.adf]\n", "lamps.swarm": MODEL})
    ran = swarmc("build", "--option", "scxml.profile=both")

    assert ran.code == 2
    assert "target `scxml` is not built" in ran.err


def test_the_project_names_the_system(swarmc, project) -> None:
    project({"swarm.toml": "[project]\nname = 'beacons.sea'\n", "lamps.swarm": MODEL})

    assert swarmc("build", "--dump-ir").out.startswith("System beacons.sea\n")


def test_the_documented_project_file_is_right(swarmc, project) -> None:
    page = (Path(__file__).parents[2] / "docs" / "project.md").read_text(encoding="utf-8")
    documented = page.partition("```toml\n")[2].partition("```")[0]
    files = {"swarm.toml": documented, "models/lamps.swarm": ISLAND, "lib/readme.txt": ""}
    root = project(files)
    ran = swarmc("build")

    assert (ran.code, ran.out) == (0, "")
    assert made(root / "generated") == {"scxml", "adf"}


@pytest.mark.parametrize("code", ["SW0011", "SW0012", "SW0013", "SW0014", "SW0015"])
def test_examples_of_the_pages_are_wrong_in_this_way(swarmc, project, code) -> None:
    blocks = explain.page(code).split("```toml\n")[1:]
    wrong, *right = (block.partition("```")[0] for block in blocks)
    root = project({"swarm.toml": wrong, "models/m.swarm": MODEL, "../models/x.txt": ""})
    printed = swarmc("check", "--format", "concise").out.splitlines()
    assert [re.findall(r"\[(SW\d+)\]", line) for line in printed] == [[code]]

    for text in right:
        (root / "swarm.toml").write_text(text, encoding="utf-8")
        assert swarmc("check").code == 0
