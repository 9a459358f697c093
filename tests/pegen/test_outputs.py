"""Everything that `make parser` makes from the grammar is fresh and complete."""

from __future__ import annotations

from pathlib import Path
from typing import Any, ClassVar

import pytest

from swarmdsl.syntax.parser.keywords import FIRST, MODIFIERS, STATEMENTS, TOP_LEVEL
from swarmdsl.syntax.pegen import __main__ as command
from swarmdsl.syntax.pegen import editors, metamodel
from swarmdsl.syntax.pegen import outputs as module_of_outputs
from swarmdsl.syntax.pegen.outputs import outputs

ROOT = Path(__file__).resolve().parents[2]
GRAMMAR = ROOT / "grammar"


def test_all_files_are_fresh(bless: bool) -> None:
    files, missing = outputs()
    for path, text in files.items():
        if bless:
            path.write_text(text, encoding="utf-8")
        elif path.read_text(encoding="utf-8") != text:
            pytest.fail(f"{path.relative_to(ROOT)} is stale: run `make parser`", pytrace=False)
    assert missing == []


def test_roles_of_keywords() -> None:
    assert {"swarm", "package", "optimize", "endless"} <= TOP_LEVEL
    assert "state" in STATEMENTS
    assert not STATEMENTS & {"in", "out", "inout", "action", "else"}
    assert MODIFIERS["internal"] == {"on", "after", "monitor"}
    assert FIRST["Trigger"] == {"succeeded", "aborted", "preempted", "done"}


@pytest.fixture
def changed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    """Make parsers from a copy of the grammar with a change in it."""

    def change(file: str, old: str, new: str) -> None:
        for path in GRAMMAR.iterdir():
            text = path.read_text(encoding="utf-8")
            if path.name == file:
                assert old in text
                text = text.replace(old, new)
            (tmp_path / path.name).write_text(text, encoding="utf-8")
        for module in (metamodel, module_of_outputs):
            monkeypatch.setattr(module, "grammar", lambda: tmp_path)

    return change


@pytest.mark.parametrize(
    ("file", "old", "new", "message"),
    [
        (
            "behaviour.tx", "Activity | Defer", "Battery | Activity | Defer",
            ": rule Battery is used, but not defined",
        ),
        (
            "behaviour.tx", "\nEntry:", "\nBattery: 'battery' level=Expression;\nEntry:",
            "rule Battery: class Battery is missing in src/swarmdsl/syntax/ast (fields: level)",
        ),
        (
            "behaviour.tx", "'initial' target=", "'initial' into=",
            "class Initial in src/swarmdsl/syntax/ast/behaviour.py has no field `into`",
        ),
    ],
)  # fmt: skip
def test_missing_parts_are_named(
    changed: Any, capsys: Any, file: str, old: str, new: str, message: str
) -> None:
    changed(file, old, new)
    assert command.main() == 1
    printed = capsys.readouterr().err
    assert message in printed
    assert "Nothing was written." in printed


def test_a_contextual_keyword_without_a_colour_is_named(changed: Any) -> None:
    changed("architecture.tx", "'behavior' machine", "('behavior' | 'behaves') machine")
    _, missing = outputs()
    file = "editors/vscode/syntaxes/swarm.tmLanguage.json"
    assert missing == [f"{file}: no rule for the contextual keyword `behaves`"]


def test_a_statement_without_a_snippet_is_named(changed: Any) -> None:
    changed("lexical.tx", "aborted|", "aborted|behaves|")
    path = Path(module_of_outputs.grammar()) / "architecture.tx"
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace("'behavior' machine", "('behavior' | 'behaves') machine"))
    files, missing = outputs()
    assert missing == ["src/swarmdsl/ide/server/snippets.json: no snippet for `behaves`"]
    units = ROOT / editors.SCANNER
    assert all("behaves" in text for path, text in files.items() if path != units)


def test_a_keyword_before_a_string_is_coloured_and_written_once() -> None:
    """A word that can also be a name, with only a string after it: `note "text"`."""

    class Changed:
        reserved = frozenset({"after", "on", "state"})
        first: ClassVar = {
            f"{block}Item": frozenset({"after", "note", "on", "state"})
            for block in ("Machine", "State", "Parallel", "Region")
        } | {"ComponentItem": frozenset({"behavior", "in", "out"})}
        modifiers: ClassVar[dict[str, set[str]]] = {}

        def context(self, word: str, dialect: object) -> str:
            return '["]'

    text = (ROOT / editors.TEXTMATE).read_text(encoding="utf-8")
    once = editors._textmate(text, Changed())  # type: ignore[arg-type]
    assert r"\\bnote(?=[ \\t]*[\"])" in once
    assert editors._textmate(once, Changed()) == once  # type: ignore[arg-type]
