"""The peers in benchmarks parse the same language and as many lines."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.syntax.parse import parse

ROOT = Path(__file__).resolve().parents[2]
BENCHMARKS = ROOT / "benchmarks"

# Comparisons that chain are syntax here, and a mistake in the grammars of the others.
_CHAINED = {"SW0101_chained_comparison.swarm"}
# Blanks inside a dotted name, and a function that is called with an argument `by`.
_NOT_FOR_LARK = {"everything.swarm", "behaviour.swarm"}
# A line with `after` that follows a line with `send`: Langium has no tokens for line ends.
_NOT_FOR_LANGIUM = ("/SW0521_role.swarm", "/SW0546_indented.swarm", "/crazyflies/behaviours.swarm")


@pytest.fixture(autouse=True)
def _beside_the_benchmarks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(BENCHMARKS))


def models() -> Iterator[tuple[Path, bool]]:
    """Models of the project, and whether they are free of syntax errors."""
    for folder in ("examples", "tests/golden", "tests/diagnostics", "tests/formatter", "editors"):
        for file in sorted((ROOT / folder).rglob("*.swarm")):
            if "node_modules" in file.parts or file.name in _CHAINED:
                continue
            try:
                text = file.read_text(encoding="utf-8")
            except UnicodeDecodeError:
                continue
            report = Diagnostics()
            parse(Source(file.name, text), report)
            yield file, not any(found.code.startswith("SW01") for found in report)


def test_lark_reads_the_same_models():
    from lark.exceptions import UnexpectedInput

    from parse_once import lark

    parser = lark()
    refused = set()
    for file, valid in models():
        try:
            parser.parse(file.read_text(encoding="utf-8"))
        except UnexpectedInput:
            if valid:
                refused.add(file.name)

    assert refused == _NOT_FOR_LARK


def test_langium_reads_the_same_models():
    import peers

    if peers.version("langium") is None:
        pytest.skip("no langium: `make bench`")
    files = [file.as_posix() for file, valid in models() if valid]
    valid = [file for file in files if not file.endswith(_NOT_FOR_LANGIUM)]
    script, grammar = peers.FOLDER / "langium.mjs", peers.FOLDER / "swarm.langium"
    ran = subprocess.run(
        ["node", str(script), str(grammar), valid[0], *valid], capture_output=True, text=True
    )
    assert ran.returncode == 0, ran.stderr


@pytest.mark.parametrize("lines", [100, 1_000])
@pytest.mark.parametrize("language", ["proto", "sql", "py", "tsp"])
def test_other_languages_have_as_many_lines(language, lines):
    import inputs

    assert inputs.WRITERS[language](lines).count("\n") == lines


def test_a_model_has_that_many_lines_and_no_mistakes(tmp_path):
    import workspace
    from swarmdsl.driver import pipeline

    file = tmp_path / "bench.swarm"
    lines = workspace.write_file(file, 1_000)

    assert 990 <= lines <= 1_000
    assert list(pipeline.check([file]).report) == []


def test_a_block_of_the_page_is_written_anew():
    from bench import replaced

    page = "before\n<!-- bench cold -->\nold\n<!-- end of cold -->\nbehind\n"

    assert replaced(page, "cold", "new\n") == (
        "before\n<!-- bench cold -->\n\nnew\n\n<!-- end of cold -->\nbehind\n"
    )


def test_a_goal_that_is_missed_is_said():
    from measure import Section

    section = Section("What it is.", ["a", "b"])
    section.goal("fast", 3.0, 2.0, "{:.1f}", least=True)
    section.goal("small", 3.0, 2.0, "{:.1f}")

    assert section.notes == [
        "fast: 3.0; goal at least 2.0, reached",
        "small: 3.0; goal at most 2.0, **missed**",
    ]
