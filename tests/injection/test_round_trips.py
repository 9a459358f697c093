"""Output of `fmt` and `import` is accepted again, with the same strings."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from xml.sax.saxutils import escape

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.cli import run
from swarmdsl.codegen.swarm_printer.system import print_system
from swarmdsl.driver import pipeline
from swarmdsl.importing import import_scxml
from swarmdsl.ir import System
from swarmdsl.ir.dump import dump
from swarmdsl.project.read_source import without_control_characters
from swarmdsl.syntax.formatter import format_source
from swarmdsl.syntax.parser.literals import forbidden_character, quoted, unquoted

from .conftest import Make
from .model import DOCS, HOSTILE, model


@given(st.text(st.characters(codec="utf-8") | st.sampled_from('"\\nrtuU0\n\r\t\u2028')))
def test_a_string_is_read_as_it_is_written(text: str) -> None:
    if forbidden_character(text) is not None:
        with pytest.raises(ValueError, match="cannot contain"):
            quoted(text)
        return
    written = quoted(text)
    assert written.isprintable()
    assert unquoted(written) == text


def test_fmt_keeps_strings_and_documentation(checked: Callable[..., System]) -> None:
    text = model(HOSTILE, "\n".join(DOCS), worlds=True)
    report = Diagnostics()
    formatted = format_source(Source("model.swarm", text), report)
    assert formatted is not None
    assert formatted != text
    assert dump(checked(formatted)) == dump(checked(text))


def test_what_is_printed_is_the_model(checked: Callable[..., System]) -> None:
    system = checked(model(HOSTILE, "\n".join(DOCS), worlds=True))
    assert dump(checked(print_system(system))) == dump(system)


@pytest.mark.parametrize("files", [["Inner.scxml", "Look.scxml", "Work.scxml"]])
def test_import_of_what_is_exported(make: Make, files: list[str], tmp_path: Path) -> None:
    made = make(model(HOSTILE, "\n".join(DOCS)), "scxml", {"profile": "portable"})
    for name in files:
        (tmp_path / name).write_text(made.files[name], encoding="utf-8", newline="")
    out = tmp_path / "imported.swarm"
    assert run(["import", "scxml", *(str(tmp_path / name) for name in files), "-o", str(out)]) == 0
    system = pipeline.check([out]).system
    assert system is not None
    work = next(each for each in system.machines if each.name == "Work")
    for prefix, declared in (("p", work.params), ("v", work.variables)):
        values = {each.name: each.default if prefix == "p" else each.initial for each in declared}
        found = [values[f"{prefix}{number}"] for number in range(len(HOSTILE))]
        assert [each.value for each in found] == list(HOSTILE)
    assert work.doc == "\n".join(each.rstrip() for each in DOCS)


# A carriage return in XML is that of a reference; in a file it would end the line.
INJECTED = "first\rstatemachine Injected { initial A; state A { } }\n\x85\u2028 last \x7f\x9b"


@settings(max_examples=30)
@given(text=st.text(st.characters(codec="utf-8"), max_size=30))
@example(text=INJECTED)
def test_documentation_of_an_import_stays_documentation(described: str, text: str) -> None:
    doc = "".join(each for each in text if forbidden_character(each) is None)
    escaped = escape(doc, {"\r": "&#13;", "\n": "&#10;"})
    report = Diagnostics()
    source = Source("m.scxml", described.replace("DOCUMENTATION", escaped))
    written = print_system(import_scxml([source], [], "m", report))
    found = Diagnostics()
    model = without_control_characters(Source("m.swarm", written), found)
    assert format_source(model, found) is not None
    assert not list(found)
    assert [line for line in written.split("\n") if "Injected" in line and "///" not in line] == []
    assert all(word in written for word in re.split(r"[\s\x7f-\x9f]+", doc))


@pytest.fixture
def described(make: Make) -> str:
    """A state machine in SCXML, documented as `DOCUMENTATION`."""
    text = make(model([], "x"), "scxml", {"profile": "portable"}).files["Look.scxml"]
    assert text.count("<sw:doc>x</sw:doc>") > 2
    return text.replace("<sw:doc>x</sw:doc>", "<sw:doc>DOCUMENTATION</sw:doc>")


SCXML = """<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0">
<datamodel><data id='x' expr="'\\u0007'"/></datamodel>
<state id='A'><transition event='e' cond="x == '\\u0000'" target='A'/></state></scxml>"""
ADF = """{"functions": [{"name": "f",
"api": {"comm_model": {"paradigm": "rosservice", "definition": {"class": "std_srvs/Empty"}}},
"param_list": [{"name": "p", "class": "string", "value": "a\\u0007"}]}]}"""


@pytest.mark.parametrize(("format_", "text", "count"), [("scxml", SCXML, 2), ("adf", ADF, 1)])
def test_a_string_that_no_model_contains_is_left_out_at_its_place(
    format_: str, text: str, count: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "given.txt"
    path.write_text(text, encoding="utf-8")
    out = tmp_path / "made.swarm"
    assert run(["import", format_, str(path), "-o", str(out), "--format", "concise"]) == 0
    said = [line for line in capsys.readouterr().err.splitlines() if "cannot contain" in line]
    assert len(said) == count
    assert all(re.match(rf"{re.escape(str(path))}:[23]:", line) for line in said)
    assert pipeline.check([out]).system is not None
