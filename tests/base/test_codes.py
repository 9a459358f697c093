"""Every diagnostic code has a page, a test and a use.

In a page, the first `swarm` block of a section is a whole file, and blocks marked `file=NAME` are
next to it. A block marked `target=NAME` is a valid model that is built for that target.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.base.diagnostics.collector import Level
from swarmdsl.base.diagnostics.explain import page_path
from swarmdsl.codegen.emit import Request
from swarmdsl.driver import pipeline
from swarmdsl.driver.config.settings import Settings

from ..docs.pages import Block, Page

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ROOT / "src" / "swarmdsl"
NAMES = {entry.code: name for name, entry in CODES.items()}
PAGES = {code: Page(page_path(code)) for code in NAMES}
# No text of a model is behind these: the file system is, the command line, the project file,
# an installed library or a generator.
NO_MODEL = {
    *("unreadable-file", "not-text", "nothing-to-compile", "control-character"),
    *("unknown-target", "broken-generator", "bad-option", "outside-output", "would-overwrite"),
    *("cannot-write", "target-left-out", "generator-failed", "outdated-code"),
    *("edited-output", "merge-conflict", "stale-output", "parked-code", "renamed-element"),
    *("bad-rename", "old-name", "unreadable-list", "interrupted-build"),
    *("damaged-region", "other-model"),
    *("broken-library", "bad-toml", "unknown-key", "wrong-value", "unknown-diagnostic"),
    *("not-a-warning", "outside-project", "outside-workspace", "no-source-map"),
    "too-many-files",
    *("violated-property", "violated-in-runs", "refuted-chance", "failed-runs", "lost-worker"),
    "no-histogram",
}
# Of SCXML documents, not of models; `tests/scxml` has them and their pages.
OF_DOCUMENTS = {name for name, entry in CODES.items() if "SW08" < entry.code < "SW09"}
# Of what runs or is verified; `tests/simulate`, `tests/verify` and `tests/experiments` have them.
OF_RUNS = {
    name
    for name, entry in CODES.items()
    if "SW10" < entry.code < "SW16" or "SW17" < entry.code < "SW19"
}
NO_MODEL |= OF_DOCUMENTS | OF_RUNS
# Found before there is a model, and not by its text.
UNTEXTUAL = {
    *OF_DOCUMENTS,
    *("unreadable-file", "nothing-to-compile", "broken-library"),
    *("bad-toml", "unknown-key", "wrong-value", "unknown-diagnostic", "not-a-warning"),
    *("outside-project", "outside-workspace", "too-many-files", "violated-property"),
    *("violated-in-runs", "refuted-chance", "failed-runs", "lost-worker", "no-histogram"),
}


def section(page: Page, heading: str) -> list[Block]:
    """The `swarm` blocks below a heading."""
    level = [token for token in page.tokens if token.type in ("inline", "fence") and token.map]
    starts = [token.map[0] for token in level if token.content == heading and token.map]
    assert len(starts) == 1, heading
    lines = page.text.splitlines()
    end = next(
        (i for i in range(starts[0] + 1, len(lines)) if lines[i].startswith("## ")), len(lines)
    )
    return [b for b in page.blocks if b.language == "swarm" and starts[0] < b.line <= end]


def check(blocks: list[Block], folder: Path, asked: str) -> list[str]:
    """The codes reported about the blocks of a section."""
    for block in blocks:
        path = folder / block.attributes.get("file", "model.swarm")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(block.text, encoding="utf-8")
    first = blocks[0].attributes
    model = folder / "model.swarm"
    if "target" not in first:
        # A silent warning is asked for on its own page.
        settings = Settings(levels={asked: Level.WARN})
        return [found.code for found in pipeline.check([model], settings).report]
    name, _, value = first.get("option", "").partition("=")
    options = {name: value} if name else {}
    assert not len(pipeline.check([model]).report)
    built = pipeline.build([model], [Request(first["target"], options)], folder / "out")
    return [found.code for found in built.report]


@pytest.mark.parametrize("code", sorted(set(NAMES) - {CODES[name].code for name in NO_MODEL}))
def test_examples_are_wrong_in_this_way_alone(code: str, tmp_path: Path) -> None:
    assert check(section(PAGES[code], "Example"), tmp_path, NAMES[code]) == [code]


@pytest.mark.parametrize("code", sorted(code for code in NAMES if section(PAGES[code], "Way out")))
def test_ways_out_are_right(code: str, tmp_path: Path) -> None:
    assert check(section(PAGES[code], "Way out"), tmp_path, NAMES[code]) == []


def test_mistakes_in_a_model_have_a_way_out_in_a_model() -> None:
    without = {NAMES[code] for code in NAMES if not section(PAGES[code], "Way out")}

    assert {name for name in without if CODES[name].code < "SW09"} == {
        name for name in NO_MODEL if CODES[name].code < "SW09"
    }


@pytest.mark.parametrize("name", sorted(NO_MODEL))
def test_pages_without_a_model_have_prose(name: str) -> None:
    assert section(PAGES[CODES[name].code], "Example") == []


def test_there_is_no_page_without_a_code() -> None:
    pages = page_path("SW0000").parent.glob("*.md")

    assert sorted(path.stem for path in pages) == sorted(NAMES)


def test_every_code_has_a_golden_case_or_another_test() -> None:
    golden = {path.name[:6] for path in (ROOT / "tests" / "diagnostics").glob("SW????_*.txt")}
    tests = set((ROOT / "tests").rglob("test_*.py")) - {Path(__file__)}
    words = {word for test in tests for word in re.findall(r"\w+(?:-\w+)*", read(test))}

    without = []
    for name, entry in CODES.items():
        code = entry.code
        if (code < "SW09" or code > "SW16") and name not in UNTEXTUAL | OF_RUNS:
            found = code in golden
        else:
            found = bool(words & {name, code})
        if not found:
            without.append(code)
    assert without == []


def test_every_code_is_used_and_no_other_is() -> None:
    modules = {*SOURCES.rglob("*.py"), *(ROOT / "generators").rglob("*.py")}
    text = "\n".join(
        read(path) for path in sorted(modules - {SOURCES / "base" / "diagnostics" / "catalog.py"})
    )
    used = {name for name in CODES if f'"{name}"' in text}

    assert used == set(CODES)
    assert set(re.findall(r'\breport\(\s*"([^"]+)"', text)) - set(CODES) == set()


def test_numbers_are_unique_and_of_their_group() -> None:
    text = read(SOURCES / "base" / "diagnostics" / "catalog.py")
    titles = dict(re.findall(r"(\d\d)xx  (\w.*?)(?:  |\n)", text))
    by_group = re.split(r"# ---- (.+)\n", text)
    found: list[str] = []
    for title, entries in zip(by_group[1::2], by_group[2::2], strict=True):
        numbers = re.findall(r'"(SW\d\d)(\d\d)"', entries)
        assert {titles[group.removeprefix("SW")] for group, _ in numbers} == {title}
        found += [group + number for group, number in numbers]

    assert found == sorted(set(found))
    assert found == [entry.code for entry in CODES.values()]


def read(path: Path) -> str:
    return path.read_text(encoding="utf-8")
