"""The handbook as a site, and the pages that are written from the command line's own help."""

from __future__ import annotations

import importlib.util
import re
import shutil
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest
import yaml

from swarmdsl.cli import COMMANDS, run

from .pages import ROOT


def _load(name: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(f"docs_{name}", ROOT / "docs" / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


MANUAL, STAGE = _load("manual"), _load("stage")
CONFIGURATION = yaml.safe_load((ROOT / "mkdocs.yml").read_text(encoding="utf-8"))


def _paths(nav: list[dict[str, object]]) -> list[str]:
    found: list[str] = []
    for entry in nav:
        for below in entry.values():
            found += _paths(below) if isinstance(below, list) else [str(below)]
    return found


def test_the_navigation_has_every_page_once() -> None:
    there = {path.relative_to(ROOT).as_posix() for path in STAGE.shown() if path.suffix == ".md"}

    paths = _paths(CONFIGURATION["nav"])

    assert sorted(paths) == sorted(there)


def test_the_site_builds_without_a_broken_link(tmp_path: Path) -> None:
    zensical = Path(sys.executable).with_name("zensical")
    if not zensical.exists():
        pytest.skip("no zensical: `make docs`")
    STAGE.stage(tmp_path / "build" / "handbook")
    shutil.copy(ROOT / "mkdocs.yml", tmp_path)

    built = subprocess.run(
        [zensical, "build", "--strict"], cwd=tmp_path, capture_output=True, text=True, check=False
    )

    assert built.returncode == 0, built.stdout + built.stderr
    site = tmp_path / "build" / "site"
    language = (site / "docs" / "language.html").read_text(encoding="utf-8")
    assert re.search(r'<div class="language-swarm highlight">.*?<span class="kd?">', language, re.S)
    loaded = r'<(?:script|img|iframe|link rel="(?:stylesheet|icon|preconnect))[^>]*"(?:https?:)?//'
    for page in site.rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        assert not re.findall(loaded, text), page
        assert not re.findall("^```|<p>```", text, re.MULTILINE), page


def test_pictures_are_those_of_the_example(
    tmp_path: Path, bless: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    assert run(["diagram", "examples/search_and_rescue", "-o", str(tmp_path)]) == 0
    shown = list((ROOT / "docs" / "pictures").glob("*.svg"))

    assert len(shown) == 3
    for picture in shown:
        if bless:
            picture.write_bytes((tmp_path / picture.name).read_bytes())
        assert picture.read_bytes() == (tmp_path / picture.name).read_bytes(), picture.name


@pytest.mark.parametrize(("name", "write"), [("swarmc.1", "man_page"), ("commands.md", "markdown")])
def test_the_manual_is_what_the_commands_say(name: str, write: str, bless: bool) -> None:
    path = ROOT / "docs" / name
    if bless:
        path.write_text(getattr(MANUAL, write)(), encoding="utf-8")

    assert path.read_text(encoding="utf-8") == getattr(MANUAL, write)(), "python docs/manual.py"


def test_the_man_page_is_read_without_a_warning() -> None:
    groff = shutil.which("groff")
    if groff is None:
        pytest.skip("no groff: apt-get install groff-base")

    read = subprocess.run(
        [groff, "-man", "-ww", "-Tutf8", "-P-c", ROOT / "docs" / "swarmc.1"],
        capture_output=True,
        text=True,
        check=True,
    )

    assert read.stderr == ""
    headings = {" ".join(line.split()) for line in re.sub(".\b", "", read.stdout).splitlines()}
    assert {f"swarmc {command}" for command in COMMANDS} <= headings
    assert {"NAME", "SYNOPSIS", "OPTIONS", "EXIT STATUS", "ENVIRONMENT", "FILES"} <= headings
