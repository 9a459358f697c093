"""Tests of the extension: manifest, problem matchers, editing rules, package."""

from __future__ import annotations

import importlib.util
import json
import re
import struct
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.cli import run
from swarmdsl.tools.scaffold.plan import TARGETS

ROOT = Path(__file__).resolve().parents[2]
EXTENSION = ROOT / "editors" / "vscode"
pytestmark = pytest.mark.timeout(900)  # npm may have to install its tools first
NAMED = {
    "language-configuration.json",
    "syntaxes/swarm.tmLanguage.json",
    "syntaxes/markdown.tmLanguage.json",
    "icons/extension.png",
    "icons/file.svg",
    *(f"walkthrough/{path.name}" for path in (EXTENSION / "walkthrough").iterdir()),
}
BUILT = {"dist/extension.js", "dist/licences.txt", "dist/preview.js"}
SCHEMAS = {f"schemas/{each}.schema.json" for each in ("project", "scenario", "tests")}
SHIPPED = {"package.json", "templates/model.swarm", "swarmdsl.zip", *NAMED, *BUILT, *SCHEMAS}


def read(path: str) -> Any:
    return json.loads((EXTENSION / path).read_text(encoding="utf-8"))


MANIFEST = read("package.json")
EDITING = read("language-configuration.json")


def strings(value: Any) -> list[str]:
    if isinstance(value, str):
        return [value]
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return [text for item in inner for text in strings(item)]


def all_sources() -> str:
    files = (EXTENSION / "src").rglob("*.ts")
    return "".join(path.read_text(encoding="utf-8") for path in files)


# ---- package.json


def test_manifest_names_all_files_of_the_extension() -> None:
    named = {text for text in strings(MANIFEST["contributes"]) if text.startswith("./")}
    named |= {MANIFEST["icon"], MANIFEST["main"]}
    assert {text.removeprefix("./") for text in named} == NAMED | {"dist/extension.js"}
    assert [text for text in NAMED if not (EXTENSION / text).is_file()] == []


def test_commands_are_those_that_the_sources_register() -> None:
    sources = all_sources()
    registered = {f"swarmdsl.{name}" for name in re.findall(r'\bcommand\("(\w+)"', sources)}
    for_the_server = {"swarmdsl.references", "swarmdsl.rename"}
    offered = {each["command"] for each in MANIFEST["contributes"]["commands"]}
    assert offered | for_the_server == registered
    used = set(re.findall(r"executeCommand\(\s*\"(swarmdsl\.\w+)\"", sources))
    used |= set(re.findall(r"command:(swarmdsl\.\w+)", sources + json.dumps(MANIFEST)))
    assert used | set(re.findall(r"onCommand:(swarmdsl\.\w+)", json.dumps(MANIFEST))) <= registered


def test_settings_are_those_that_the_sources_read() -> None:
    sources = all_sources()
    settings = set(MANIFEST["contributes"]["configuration"]["properties"])
    assert settings == {"swarmdsl.trace.server", *re.findall(r"swarmdsl\.server\.\w+", sources)}
    trusted = set(MANIFEST["capabilities"]["untrustedWorkspaces"]["restrictedConfigurations"])
    assert trusted == settings - {"swarmdsl.trace.server"}


def test_first_steps_have_a_command_and_end_with_it() -> None:
    [walkthrough] = MANIFEST["contributes"]["walkthroughs"]
    sources = (EXTENSION / "src" / "extension.ts").read_text(encoding="utf-8")
    assert f'"{MANIFEST["publisher"]}.{MANIFEST["name"]}#{walkthrough["id"]}"' in sources
    for step in walkthrough["steps"]:
        offered = re.findall(r"\(command:([\w.]+)\)", step["description"])
        assert step["completionEvents"] == [f"onCommand:{each}" for each in offered] != []
    shown = (EXTENSION / "src" / "welcome.ts").read_text(encoding="utf-8")
    [view] = MANIFEST["contributes"]["views"]["explorer"]
    assert f'"{view["id"]}"' in shown
    assert f'"{view["when"]}"' in shown
    contents = {each["view"]: each["contents"] for each in MANIFEST["contributes"]["viewsWelcome"]}
    assert all("(command:swarmdsl.newProject)" in each for each in contents.values())
    assert contents.keys() == {view["id"], "workbench.explorer.emptyView"}


def test_first_steps_show_valid_models(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    blocks = {
        path.stem: re.findall(r"^```(\w+)\n(.*?)^```", path.read_text("utf-8"), re.M | re.S)
        for path in (EXTENSION / "walkthrough").iterdir()
    }
    [(_, model)] = blocks["write"]
    [(_, prop), (_, test)] = blocks["verify"]
    [(_, project)] = blocks["build"]
    (tmp_path / "swarm.toml").write_text(project)
    models = tmp_path / "models"
    models.mkdir()
    (models / "patrol.swarm").write_text(model + prop)
    (models / "patrol.swarmtest.toml").write_text(test)
    monkeypatch.chdir(tmp_path)
    assert run(["check", "--deny", "warnings"]) == 0
    assert run(["test"]) == 0
    assert run(["verify", "--property", "Told"]) == 0


def test_first_steps_show_the_run_of_a_new_project(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page = (EXTENSION / "walkthrough" / "simulate.md").read_text(encoding="utf-8")
    [shown] = re.findall(r"^```text\n(.*?)^```", page, re.M | re.S)
    assert run(["new", "rescue", "--folder", str(tmp_path / "rescue")]) == 0
    scenario = tmp_path / "rescue" / "scenarios" / "mission.toml"
    capsys.readouterr()
    assert run(["simulate", str(tmp_path / "rescue"), "--scenario", str(scenario)]) == 0
    told = capsys.readouterr().out.splitlines()
    assert shown.splitlines() == [line for line in told if line in shown.splitlines()] != []


def test_new_projects_are_for_each_target() -> None:
    sources = (EXTENSION / "src" / "projects.ts").read_text(encoding="utf-8")
    assert tuple(re.findall(r'target: "(\w+)"', sources)) == TARGETS


def test_sources_name_modules_and_files_that_exist() -> None:
    preview = (EXTENSION / "src" / "preview.ts").read_text(encoding="utf-8")
    [page] = re.findall(r'const page = \["server", (.*?)\];', preview)
    assert ROOT.joinpath("src", *json.loads(f"[{page}]"), "index.html").is_file()
    build = (EXTENSION / "build.mjs").read_text(encoding="utf-8")
    [script] = re.findall(r'"(\S+/preview\.js)"\]', build)
    assert (EXTENSION / script).is_file()
    probe = (EXTENSION / "src" / "probe.ts").read_text(encoding="utf-8")
    current, *_older = re.findall(r"import (swarmdsl[\w.]+)", probe)
    assert importlib.util.find_spec(current)


def test_icon_has_the_size_of_the_marketplace() -> None:
    data = (EXTENSION / MANIFEST["icon"]).read_bytes()
    assert data.startswith(b"\x89PNG\r\n\x1a\n")
    assert struct.unpack(">II", data[16:24]) == (128, 128)


def test_lock_file_names_no_registry() -> None:
    text = (EXTENSION / "package-lock.json").read_text(encoding="utf-8")
    assert '"resolved"' not in text
    assert "registry" not in text.lower()
    assert read("package-lock.json")["version"] == MANIFEST["version"]


def test_license_is_that_of_the_project() -> None:
    assert (EXTENSION / "LICENSE").read_bytes() == (ROOT / "LICENSE").read_bytes()


# ---- the sources


def test_types_check(npm: Any) -> None:
    result = npm("run", "--silent", "check")
    assert result.returncode == 0, result.stdout


def test_units(npm: Any) -> None:
    result = npm("run", "--silent", "unit")
    assert result.returncode == 0, result.stdout
    assert re.search(r"^# pass [1-9]", result.stdout, re.MULTILINE), result.stdout


def test_template_of_a_new_model_is_valid(tmp_path: Path) -> None:
    model = EXTENSION / "templates" / "model.swarm"
    for command in (["check", "--deny", "warnings"], ["fmt", "--check"]):
        line = [sys.executable, "-m", "swarmdsl", *command, str(model)]
        result = subprocess.run(line, capture_output=True, text=True)
        assert result.returncode == 0, result.stdout


# ---- the problem matchers


def test_problem_matcher_reads_diagnostics(tmp_path: Path) -> None:
    model = tmp_path / "a model.swarm"
    model.write_text("package a\n\nswarm event Found : Nothing\n", encoding="utf-8")
    command = [sys.executable, "-m", "swarmdsl", "check", "--format", "concise", str(model)]
    output = subprocess.run(command, capture_output=True, text=True).stdout
    pattern, of_build = MANIFEST["contributes"]["problemPatterns"]
    for matcher in MANIFEST["contributes"]["problemMatchers"]:
        assert matcher["pattern"] == f"${matcher['name'].removesuffix('-watch')}"
        # The server shows the others in open files, under the owner of this name.
        is_shown = matcher["owner"] == "swarmdsl"
        assert matcher["applyTo"] == ("closedDocuments" if is_shown else "allDocuments")
        assert matcher["pattern"] == ("$swarmc" if is_shown else "$swarmc-build")
    for code in (each.code for each in CODES.values()):
        line = f"a.swarm:1:2: warning[{code}] it is so"
        matching = [each for each in (pattern, of_build) if re.search(each["regexp"], line)]
        assert matching == [of_build if code.startswith("SW09") else pattern]
    found = re.search(pattern["regexp"], output, re.MULTILINE)
    assert found, output
    assert found[pattern["file"]] == str(model)
    assert (found[pattern["line"]], found[pattern["column"]]) == ("3", "21")
    assert found[pattern["severity"]] == "error"
    assert found[pattern["code"]] == "SW0202"
    assert "Nothing" in found[pattern["message"]]


def test_background_matcher_detects_rebuilds(tmp_path: Path) -> None:
    model = tmp_path / "model.swarm"
    model.write_text("package a\n", encoding="utf-8")
    command = [sys.executable, "-m", "swarmdsl", "check", "--watch", "--format", "concise", "."]
    watch = MANIFEST["contributes"]["problemMatchers"][1]
    begin, end = (watch["background"][f"{each}Pattern"] for each in ("begins", "ends"))
    seen = []
    with subprocess.Popen(
        command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    ) as process:
        assert process.stdout
        while seen.count("end") < 2:
            line = process.stdout.readline()
            assert line, "it ended"
            seen += [
                name for name, each in (("begin", begin), ("end", end)) if re.match(each, line)
            ]
            if seen == ["end"]:
                model.write_text("package b\n", encoding="utf-8")
        process.kill()
    assert seen == ["end", "begin", "end"]


# ---- language-configuration.json


@pytest.mark.parametrize(
    ("line", "documentation"),
    [
        ("/// Search| and rescue.", True),
        ("  ///| Search.", True),
        ("/// Search and rescue.|", False),  # nearly all documentation is one line
        ("// a| remark", False),
        ("//// a| rule", False),
        ("state X { /// a| remark", False),
    ],
)
def test_enter_divides_documentation(line: str, documentation: bool) -> None:
    before, after = line.split("|")
    rules = [
        rule
        for rule in EDITING["onEnterRules"]
        if re.search(rule["beforeText"], before) and re.search(rule.get("afterText", ""), after)
    ]
    assert [rule["action"]["appendText"] for rule in rules] == ["/// "] * documentation


@pytest.mark.parametrize(
    ("line", "deeper"),
    [
        ("state Idle {", True),
        ("parallel state Both { // two at a time", True),
        ('function f : swarm { action "a{b" : c/D', False),
        ('connect "x" {', True),
        ("do coverage(", True),
        ("goal { altitude : float64 }", False),
        ("// state Idle {", False),
        ("on E / x = a / b -> {", True),
        ("on E [x > 1] / y = 2 -> S", False),
        ("/* state { */", False),
    ],
)
def test_block_indents_the_next_line(line: str, deeper: bool) -> None:
    pattern = EDITING["indentationRules"]["increaseIndentPattern"]
    assert bool(re.search(pattern, line)) is deeper


@pytest.mark.parametrize(("line", "back"), [("}", True), ("  )", True), ("final X }", False)])
def test_closing_bracket_outdents(line: str, back: bool) -> None:
    pattern = EDITING["indentationRules"]["decreaseIndentPattern"]
    assert bool(re.search(pattern, line)) is back


def test_words_are_names_and_numbers() -> None:
    text = "after 1.5e3 s [battery_2 > 20] -> mavros_msgs/State"
    assert re.findall(EDITING["wordPattern"], text) == [
        "after", "1.5e3", "s", "battery_2", "20", "mavros_msgs", "State",
    ]  # fmt: skip


def test_comments_are_those_of_the_language(language: Any) -> None:
    comments = EDITING["comments"]
    start, end = comments["blockComment"]
    parsed = language.parse(f"{comments['lineComment']} one\n{start} two\n {end} package p")
    assert {str(each) for each in parsed} >= {"package", "p"}


# ---- the package


def test_package_is_reproducible_and_holds_the_files_of_the_extension(
    packages: tuple[Path, Path],
) -> None:
    with zipfile.ZipFile(packages[0]) as package:
        names = set(package.namelist())
    generated = {"[Content_Types].xml", "extension.vsixmanifest"}
    texts = {"extension/readme.md", "extension/changelog.md", "extension/LICENSE.txt"}
    server = {name for name in names if name.startswith("extension/server/")}
    assert names - server == generated | texts | {f"extension/{path}" for path in SHIPPED}
    sources = (ROOT / "src", ROOT / "src/swarmdsl"), (ROOT, ROOT / "grammar")
    assert {name for name in server if "/swarmdsl/" in name} == {
        f"extension/server/{'' if base.name == 'src' else 'swarmdsl/'}{path.relative_to(base)}"
        for base, folder in sources
        for path in folder.rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    assert "extension/server/__main__.py" in server
    assert not [name for name in server if name.endswith((".so", ".pyd", ".pyc"))]
    assert packages[0].read_bytes() == packages[1].read_bytes()
