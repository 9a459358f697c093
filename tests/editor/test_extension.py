"""The extension is complete, and its package holds what it should and nothing else."""

from __future__ import annotations

import json
import os
import re
import shutil
import struct
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
EXTENSION = ROOT / "editors" / "vscode"
SHIPPED = {
    "package.json",
    "language-configuration.json",
    "syntaxes/swarm.tmLanguage.json",
    "snippets/swarm.json",
    "icons/extension.png",
    "icons/file.svg",
}


def read(path: str) -> Any:
    return json.loads((EXTENSION / path).read_text(encoding="utf-8"))


MANIFEST = read("package.json")
EDITING = read("language-configuration.json")


def strings(value: Any) -> list[str]:
    if isinstance(value, str):
        return [value]
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return [text for item in inner for text in strings(item)]


# ---- package.json


def test_manifest_names_all_files_of_the_extension() -> None:
    paths = {text.removeprefix("./") for text in strings(MANIFEST) if (EXTENSION / text).is_file()}
    assert paths | {"package.json"} == SHIPPED


def test_manifest_names_no_file_that_is_missing() -> None:
    for text in strings(MANIFEST["contributes"]):
        if text.startswith("./"):
            assert (EXTENSION / text).is_file(), text


def test_extension_icon_has_the_size_a_marketplace_wants() -> None:
    data = (EXTENSION / MANIFEST["icon"]).read_bytes()
    assert data.startswith(b"\x89PNG\r\n\x1a\n")
    assert struct.unpack(">II", data[16:24]) == (128, 128)


def test_lock_file_names_no_place_to_fetch_from() -> None:
    text = (EXTENSION / "package-lock.json").read_text(encoding="utf-8")
    assert '"resolved"' not in text
    assert "registry" not in text.lower()
    assert read("package-lock.json")["version"] == MANIFEST["version"]


def test_license_is_that_of_the_project() -> None:
    assert (EXTENSION / "LICENSE").read_bytes() == (ROOT / "LICENSE").read_bytes()


# ---- the problem matcher


def test_problem_matcher_reads_what_the_compiler_prints(tmp_path: Path) -> None:
    model = tmp_path / "a model.swarm"
    model.write_text("package a\n\nswarm event Found : Nothing\n", encoding="utf-8")
    command = [sys.executable, "-m", "swarmdsl", "check", "--format", "concise", str(model)]
    output = subprocess.run(command, capture_output=True, text=True).stdout
    (matcher,) = MANIFEST["contributes"]["problemMatchers"]
    pattern = matcher["pattern"]
    found = re.search(pattern["regexp"], output, re.MULTILINE)
    assert found, output
    assert found[pattern["file"]] == str(model)
    assert (found[pattern["line"]], found[pattern["column"]]) == ("3", "21")
    assert found[pattern["severity"]] == "error"
    assert found[pattern["code"]] == "SW0202"
    assert "Nothing" in found[pattern["message"]]


# ---- language-configuration.json


@pytest.mark.parametrize(
    ("line", "documentation"),
    [
        ("/// Search and rescue.", True),
        ("  ///", True),
        ("// a remark", False),
        ("//// a rule", False),
        ("state X { /// a remark", False),
    ],
)
def test_enter_continues_documentation(line: str, documentation: bool) -> None:
    rules = [rule for rule in EDITING["onEnterRules"] if re.search(rule["beforeText"], line)]
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
def test_block_indents_what_follows(line: str, deeper: bool) -> None:
    pattern = EDITING["indentationRules"]["increaseIndentPattern"]
    assert bool(re.search(pattern, line)) is deeper


@pytest.mark.parametrize(("line", "back"), [("}", True), ("  )", True), ("final X }", False)])
def test_closing_bracket_goes_back(line: str, back: bool) -> None:
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
    language.parse(f"{comments['lineComment']} one\n{start} two\n {end} package p")


# ---- the package


@pytest.mark.skipif(shutil.which("make") is None, reason="make is not installed")
@pytest.mark.usefixtures("npm")
def test_package_is_reproducible_and_holds_the_files_of_the_extension(tmp_path: Path) -> None:
    packages = []
    for zone in ("UTC", "Pacific/Auckland"):
        folder = tmp_path / zone
        subprocess.run(
            ["make", "vsix", f"VSIX_DIR={folder}"],
            cwd=ROOT,
            env={**os.environ, "TZ": zone, "SOURCE_DATE_EPOCH": "1700000000"},
            check=True,
            capture_output=True,
        )
        packages.append(folder / f"{MANIFEST['name']}-{MANIFEST['version']}.vsix")
    with zipfile.ZipFile(packages[0]) as package:
        names = set(package.namelist())
    generated = {"[Content_Types].xml", "extension.vsixmanifest"}
    texts = {"extension/readme.md", "extension/changelog.md", "extension/LICENSE.txt"}
    assert names == generated | texts | {f"extension/{path}" for path in SHIPPED}
    assert packages[0].read_bytes() == packages[1].read_bytes()
