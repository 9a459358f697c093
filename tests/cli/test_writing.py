"""`--check`, `--dry-run`, `--diff`, `--force`, `--clean` and `--rename`, as they are typed."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

MODEL = """package lab
function {name} : abstraction {{
  action "cmd/{topic}" : takeoff_msgs/TakeOff
  param height : float64 = {height}
}}
"""
IMPLEMENTATION = "{0}/src/{0}/implementation.py"


@pytest.fixture
def model(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """Write a model with one function into the current folder."""
    monkeypatch.chdir(tmp_path)

    def write(name: str = "takeoff", height: float = 1.0) -> None:
        text = MODEL.format(name=name, topic="takeoff", height=height)
        (tmp_path / "lab.swarm").write_text(text, encoding="utf-8")

    write()
    return write


@pytest.fixture
def build(swarmc: Callable[..., Any], model: object) -> Callable[..., Any]:
    return lambda *words: swarmc("build", "lab.swarm", "-t", "skeleton", *words)


def implementation(name: str = "takeoff") -> Path:
    return Path("out/skeleton") / IMPLEMENTATION.format(name)


def tree() -> dict[Path, int]:
    return {path: path.stat().st_mtime_ns for path in Path("out").rglob("*")}


def fill_in() -> None:
    text = implementation().read_text(encoding="utf-8")
    text = text.replace("# Process it here", "self.takeoff()  # Process it here")
    implementation().write_text(text, encoding="utf-8")


def test_a_check_fails_until_the_output_is_built(build, model):
    ran = build("--check")
    assert ran.code == 1
    assert "`out/skeleton/takeoff/package.xml` is missing: build again" in ran.out
    assert not Path("out").exists()
    assert build().code == 0
    ran = build("--check")
    assert (ran.code, ran.out) == (0, "")
    assert ran.err == "no errors in 1 file\nout is up to date\n"
    model(height=2.0)
    before = tree()
    ran = build("--check", "--format", "concise")
    assert ran.code == 1
    lines = ran.out.splitlines()
    assert len(lines) > 1
    assert all(line.startswith("error[SW0920] `out/") for line in lines)
    assert all(line.endswith("` is out of date: build again") for line in lines)
    assert tree() == before
    build()
    Path("out/.swarmdsl.json").unlink()
    assert "`out/.swarmdsl.json` is out of date: build again" in build("--check").out


def test_a_check_finds_an_edit(build):
    build()
    base = Path("out/skeleton/takeoff/src/takeoff/base.py")
    base.write_text(base.read_text() + "# mine\n", encoding="utf-8")
    ran = build("--check", "--format", "json")
    (found,) = map(json.loads, ran.out.splitlines())
    assert ran.code == 1
    assert (found["code"], found["name"]) == ("SW0920", "stale-output")
    assert f"`{base}` has been edited" in found["message"]


def test_a_check_of_a_wrong_model_says_what_is_wrong_with_it(build):
    text = Path("lab.swarm").read_text(encoding="utf-8").replace("float64", "flot64")
    Path("lab.swarm").write_text(text, encoding="utf-8")
    ran = build("--check")
    assert ran.code == 1
    assert "did you mean `float64`?" in ran.out
    assert "up to date" not in ran.err


def test_a_dry_run_lists_what_would_happen(build, model):
    build()
    fill_in()
    before = tree()
    model("rise")
    ran = build("--dry-run")
    assert ran.code == 0
    lines = ran.out.splitlines()
    assert "create    out/skeleton/rise/package.xml" in lines
    assert "remove    out/skeleton/takeoff/package.xml" in lines
    old = implementation()
    assert f"park      out/.parked/skeleton/{IMPLEMENTATION.format('takeoff')} from {old}" in lines
    assert "--rename takeoff=rise" in ran.err
    ran = build("--dry-run", "--format", "json")
    steps = [json.loads(line) for line in ran.out.splitlines()]
    assert [" ".join(step) for step in steps] == ["action file from"] * len(lines)
    assert {"action": "remove", "file": "out/skeleton/takeoff/package.xml", "from": None} in steps
    assert tree() == before
    assert build("--dry-run", "--force").code == 0
    assert tree() == before


def test_a_diff_is_one_that_patch_reads(build, model, tmp_path):
    build()
    before = tree()
    model(height=2.0)
    ran = build("--diff")
    assert ran.code == 1
    assert tree() == before
    assert "\x1b" not in ran.out
    done = subprocess.run(
        ["git", "apply", "-p0", "--unsafe-paths", "-"],
        input=ran.out,
        text=True,
        cwd=tmp_path,
        capture_output=True,
    )
    assert done.returncode == 0, done.stderr
    assert build("--diff").out == ""
    build()
    assert build("--diff").code == 0
    assert build("--diff", "--check").code == 0


def test_a_diff_on_a_terminal_is_in_colour(build, model, monkeypatch):
    build()
    model(height=2.0)
    monkeypatch.setenv("FORCE_COLOR", "1")
    assert "\x1b[32m+" in build("--diff").out


def test_clean_removes_what_was_generated(build, swarmc):
    build()
    fill_in()
    ran = build("--clean", "--dry-run")
    assert ran.code == 0
    assert "remove    out/skeleton/takeoff/package.xml" in ran.out.splitlines()
    assert str(implementation()) not in ran.out
    assert Path("out/skeleton/takeoff/package.xml").exists()
    ran = swarmc("build", "--clean")
    assert ran.code == 0
    files = {path for path in Path("out").rglob("*") if path.is_file()}
    assert {path for path in files if not path.name.startswith(".swarmdsl")} == {implementation()}
    assert "removed" in ran.err


def test_a_new_name_takes_the_code_along(build, model):
    build()
    fill_in()
    model("rise")
    ran = build()
    (line,) = (line for line in ran.out.splitlines() if "--rename" in line)
    command = line.split("`")[1]
    assert command == "swarmc build lab.swarm --target skeleton --rename takeoff=rise"
    ran = build("--rename", "takeoff=rise")
    assert ran.code == 0
    text = implementation("rise").read_text(encoding="utf-8")
    assert "class Rise(RiseBase):" in text
    assert "from rise.base import RiseBase" in text
    assert "self.takeoff()  # Process it here" in text
    assert "warning[SW0924]" in ran.out
    ran = build()
    assert (ran.code, ran.out) == (0, "")


@pytest.mark.parametrize(
    "words",
    [
        ("--check", "--force"),
        ("--check", "--dry-run"),
        ("--check", "--clean"),
        ("--check", "--watch"),
        ("--check", "--rename", "a=b"),
        ("--clean", "--force"),
        ("--clean", "--diff"),
        ("--clean", "--watch"),
        ("--clean", "--rename", "a=b"),
        ("--watch", "--force"),
        ("--watch", "--rename", "a=b"),
        ("--dump-ir", "--watch"),
        ("--dump-ir", "--check"),
        ("--dump-ir", "--dry-run"),
        ("--dump-ir", "--diff"),
        ("--dump-ir", "--clean"),
        ("--dump-ir", "--force"),
        ("--dump-ir", "--rename", "a=b"),
    ],
)
def test_options_that_do_not_go_together_are_wrong_usage(build, words):
    ran = build(*words)
    assert (ran.code, ran.out) == (2, "")
    assert " conflict: " in ran.err
    for flag in (word for word in words if word.startswith("--")):
        assert f"`{flag}`" in ran.err
    assert not Path("out").exists()


@pytest.mark.parametrize(
    "rename", ["a", "a=", "=a", "a=b=c", "a=a", "a b=c", "../a=b", "__=a", "a=1"]
)
def test_renames_that_cannot_be_understood_are_wrong_usage(build, rename):
    ran = build("--rename", rename)
    assert (ran.code, ran.out) == (2, "")
    assert f"`--rename {rename}`" in ran.err


@pytest.mark.parametrize("words", [("lab.swarm", "-o", ""), ("lab.swarm", "--out="), ("",)])
def test_an_empty_path_is_not_the_current_folder(swarmc, model, words):
    before = set(Path().rglob("*"))
    ran = swarmc("build", *words)
    assert ran.code == 2
    assert "the path is empty" in ran.err
    assert set(Path().rglob("*")) == before


@pytest.mark.parametrize("renames", [("a=b", "a=c"), ("a=c", "b=c")])
def test_renames_that_contradict_each_other_are_wrong_usage(build, renames):
    ran = build(*(word for rename in renames for word in ("--rename", rename)))
    assert (ran.code, ran.out) == (2, "")
