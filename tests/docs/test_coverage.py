"""Nothing is left out of the documentation, and nothing in it is made up."""

from __future__ import annotations

import re

import pytest

from swarmdsl.analysis.types import BUILT_INS
from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.cli import COMMANDS
from swarmdsl.codegen import registry
from swarmdsl.ir.function_models import MODELS
from swarmdsl.ir.operations import OPERATIONS
from swarmdsl.ir.space_settings import SPACE_SETTINGS
from swarmdsl.syntax.ast import NEIGHBORS
from swarmdsl.syntax.parser.keywords import RESERVED

from .pages import LANGUAGE, PAGES, ROOT, Page

CONTRIBUTING = Page(ROOT / "CONTRIBUTING.md")
README = Page(ROOT / "README.md")
ALL_CODES = {entry.code for entry in CODES.values()}
SOURCES = ROOT / "src" / "swarmdsl"


def words(texts: list[str]) -> set[str]:
    return {word for text in texts for word in re.findall(r"[A-Za-z_]\w*", text)}


def grammar_words() -> set[str]:
    """The words that stand for themselves in the grammar."""
    found = set()
    for file in sorted((ROOT / "grammar").glob("*.tx")):
        rules = re.sub(r"//[^\n]*", "", file.read_text(encoding="utf-8"))
        found |= set(re.findall(r"'([a-z]+)'", rules))
    return found


def test_the_reference_has_every_word_of_the_language() -> None:
    in_grammar = grammar_words()

    assert {"statemachine", "gives", "world"} <= in_grammar
    assert in_grammar - words(LANGUAGE.code) == set()


def test_the_reference_has_every_built_in_function() -> None:
    # What robots are there, and for how long a state is active, depend on the moment.
    assert BUILT_INS.keys() - {"present", "elapsed", NEIGHBORS} <= OPERATIONS.keys()
    written = "".join(line for line in LANGUAGE.text.splitlines() if line.startswith("| `"))
    assert [
        name
        for name in BUILT_INS
        if not written.count(f"`{name}{' ' if name == NEIGHBORS else '('}")
    ] == []


def test_the_reference_has_every_model_of_functions_with_its_arguments() -> None:
    for model in MODELS.values():
        (row,) = re.findall(rf"^\| `{model.name}` \|.*$", LANGUAGE.text, re.MULTILINE)
        arguments = [f"`{each.name}` ({each.kind})" for each in model.arguments]
        assert row == f"| `{model.name}` | {model.doc} | {', '.join(arguments)} |"


def test_the_reference_has_every_setting_of_robots_and_sensors() -> None:
    rows = re.findall(r"^\| `(\w+)` \| `(\w+)` \|", LANGUAGE.text, re.MULTILINE)
    settings = {(kind, name) for kind, known in SPACE_SETTINGS.items() for name in known}
    assert settings - set(rows) == set()


def test_the_reference_lists_the_reserved_words() -> None:
    lists = [set(block.text.split()) for block in LANGUAGE.blocks if block.language == "text"]

    assert RESERVED in lists


def test_the_reference_has_every_check_of_models() -> None:
    of_models = {code for code in ALL_CODES if code < "SW08"}

    assert of_models - set(re.findall(r"SW\d{4}", LANGUAGE.text)) == set()


def test_the_page_on_scxml_has_every_check_of_documents() -> None:
    of_documents = {code for code in ALL_CODES if "SW08" < code < "SW09"}
    page = Page(ROOT / "docs" / "scxml.md")

    assert of_documents - set(re.findall(r"SW\d{4}", page.text)) == set()


@pytest.mark.parametrize("page", PAGES, ids=str)
def test_codes_exist(page: Page) -> None:
    assert set(re.findall(r"SW\d{4}", page.text)) - ALL_CODES == set()


@pytest.mark.parametrize("page", PAGES, ids=str)
def test_make_targets_exist(page: Page) -> None:
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    targets = set(re.findall(r"^([a-z0-9-]+):", makefile, re.MULTILINE))
    named = {word for code in page.code for word in re.findall(r"\bmake ([a-z0-9-]+)", code)}

    assert named - targets == set()


def test_contributing_has_every_make_target() -> None:
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    targets = set(re.findall(r"^([a-z0-9-]+):.*##", makefile, re.MULTILINE))

    assert targets
    assert targets - {code.removeprefix("make ") for code in CONTRIBUTING.code} == set()


def test_the_map_has_every_package_and_only_those() -> None:
    chapter = CONTRIBUTING.text.partition("## Map of the code")[2].partition("Outside `src/`")[0]
    named = re.findall(r"^\| `(\w+)/` \|", chapter, re.MULTILINE)

    assert sorted(named) == sorted(path.parent.name for path in SOURCES.glob("*/__init__.py"))


def test_paths_in_contributing_exist() -> None:
    roots = "docs|editors|examples|generators|grammar|src|tests"
    paths = {code for code in CONTRIBUTING.code if re.fullmatch(rf"(?:{roots})/[\w./-]*", code)}
    paths.discard("src/swarmdsl/base/diagnostics/explain/SWxxxx.md")  # stands for any page

    assert paths
    assert {path for path in paths if not (ROOT / path).exists()} == set()


def test_the_readme_has_every_command_and_target() -> None:
    assert set(COMMANDS) - words(README.code) == set()
    assert set(registry.BUILT_IN) - words(README.code) == set()


def test_every_example_has_a_page_and_is_listed() -> None:
    listed = set(Page(ROOT / "examples" / "README.md").links)
    folders = [folder for folder in (ROOT / "examples").iterdir() if folder.is_dir()]

    assert folders
    assert {f"{folder.name}/README.md" for folder in folders} <= listed
