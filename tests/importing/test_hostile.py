"""Files that were made to do harm: a clear error, soon, and nothing outside of them is read."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.cli import run
from swarmdsl.importing import command, import_adf, import_scxml
from swarmdsl.importing.json_file import MAX_DEPTH

# Each takes some seconds at most.
pytestmark = pytest.mark.timeout(60)

HEAD = '<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0">'
STATE = "<state id='A'/>"
BILLION = "".join(f'<!ENTITY x{n} "{f"&x{n - 1};" * 10 if n else "ha"}">' for n in range(10))


def said(text: str) -> list[tuple[str, str]]:
    """Return the diagnostics of a document: name and message."""
    report = Diagnostics()
    import_scxml([Source("a.xml", text)], [], "a", report)
    return [(found.name, found.message) for found in report]


def said_of_json(text: str) -> list[tuple[str, str, str]]:
    report = Diagnostics()
    import_adf([Source("a.json", text)], "a", report)
    return [(f.name, f.message, f.primary.span.text if f.primary else "") for f in report]


@pytest.mark.parametrize(
    "doctype",
    [
        f"<!DOCTYPE scxml [{BILLION}]>",
        '<!DOCTYPE scxml SYSTEM "http://localhost:1/x.dtd">',
        '<!DOCTYPE scxml [<!ENTITY % p SYSTEM "file:///etc/passwd"> %p;]>',
        '<!DOCTYPE scxml [<!ENTITY x SYSTEM "file:///etc/passwd">]>',
    ],
    ids=["expansion", "external-dtd", "parameter-entity", "external-entity"],
)
def test_document_types_are_refused(doctype: str) -> None:
    found = said(f"{doctype}{HEAD}<state id='A'><onentry>&x9;&x;</onentry></state></scxml>")

    assert [name for name, _ in found] == ["xml-document-type"]


def test_other_files_are_not_read(tmp_path: Path) -> None:
    secret = tmp_path / "secret"
    secret.write_text("41", encoding="utf-8")
    include = f"<xi:include xmlns:xi='http://www.w3.org/2001/XInclude' href='{secret}'/>"
    data = f"<datamodel><data id='x' src='{secret.as_uri()}'/></datamodel>"
    invoke = f"<state id='A'><invoke src='{secret.as_uri()}'/></state>"
    found = said(f"{HEAD}{include}{data}{invoke}</scxml>")

    assert {name for name, _ in found} == {"left-out"}
    assert "41" not in repr(found)
    whats = " ".join(message for _, message in found)
    assert all(word in whats for word in ("`<include>`", "data `x`", "`invoke`")), whats


def test_length_of_attributes_and_texts() -> None:
    long = "x " * 500_001
    in_attribute = f"<state id='A'><transition event='{long}' target='A'/></state>"
    assert said(f"{HEAD}{in_attribute}</scxml>") == [
        ("not-xml", "invalid XML: attribute `event` has more than 1,000,000 characters")
    ]
    in_parts = "<!-- -->".join(["x" * 100_000] * 11)
    assert said(
        f"{HEAD}<state id='A'><onentry><script>{in_parts}</script></onentry></state></scxml>"
    ) == [("not-xml", "invalid XML: an element has more than 1,000,000 characters of text")]


def test_depth_of_elements_and_expressions() -> None:
    deep = "".join(f"<state id='s{n}'>" for n in range(10_000)) + "</state>" * 10_000
    assert said(f"{HEAD}{deep}</scxml>") == [
        ("not-xml", "invalid XML: elements are nested more than 250 levels deep")
    ]
    for condition in ("(" * 10_000 + "x", "!" * 10_000 + "x", "x + " * 10_000 + "x"):
        way = f"<state id='A'><transition event='e' cond='{condition}' target='A'/></state>"
        assert "left-out" in [name for name, _ in said(f"{HEAD}{way}</scxml>")]


def test_deep_states_have_no_text() -> None:
    # The language has a bound of its own.
    deep = "".join(f"<state id='s{n}'>" for n in range(200)) + "</state>" * 200
    path = Path("deep.xml")
    report = Diagnostics()
    system = import_scxml([Source(path.name, f"{HEAD}{deep}</scxml>")], [], "deep", report)
    assert system.machines
    assert not report.has_errors


def test_number_of_states() -> None:
    ((name, message),) = said(f"{HEAD}{'<state/>' * 10_001}</scxml>")

    assert name == "no-model"
    assert message.endswith("it has more than 10000 states")


@pytest.mark.parametrize(
    "body",
    [
        "<state id='A'/>" * 3000
        + "<state id='B'><transition event='e' target='A'/></state>" * 2000,
        "<state><transition event='*' target='Q'/></state>" * 2000 + "<state id='Q'/>",
        "<state id='A'><transition cond='" + "In(" * 100_000 + "' target='A'/></state>",
        "<state id='A'><transition cond='" + "&quot;" * 100_001 + "' target='A'/></state>",
        "<state id='ä'><transition event='" + "ä " * 2000 + "' target='ä'/></state>",
    ],
    ids=["ids", "wildcards", "conditions", "quotes", "not-ascii"],
)
def test_what_takes_long_elsewhere(body: str) -> None:
    assert said(f"{HEAD}{body}</scxml>")


@pytest.mark.parametrize(
    ("text", "reason", "word"),
    [
        ("[" * 100_000, f"it is nested deeper than {MAX_DEPTH} levels", "["),
        ('{"functions": ' + "[" * 200 + "]" * 200 + "}", f"nested deeper than {MAX_DEPTH}", "{"),
        ('{"functions": NaN}', "`NaN` is not a JSON number", "NaN"),
        ('{"functions": ' + "1" * 5000 + "}", "too many digits", "{"),
        ('{"functions": [', "expecting value", ""),
    ],
    ids=["deep", "deep-lists", "constants", "digits", "unfinished"],
)
def test_json_that_is_none(text: str, reason: str, word: str) -> None:
    ((name, message, place),) = said_of_json(text)

    assert name == "not-json"
    assert reason in message
    assert place == word


def test_keys_that_an_object_has_twice() -> None:
    found = said_of_json('{"functions": [1], "functions": [{"name": "a", "name": "b"}]}')

    assert [(name, place) for name, _, place in found if name == "left-out"] == [
        ("left-out", '"functions":'),
        ("left-out", '"name":'),
    ]


def test_descriptions_of_the_wrong_kind() -> None:
    # Whatever stands in the place of a text or object: no traceback.
    for wrong in (None, 1, [], {}, "x", [[]], {"fields": 1}):
        api = {"comm_model": wrong, "inputs": wrong, "outputs": [wrong, {"topic": wrong}]}
        for described in (
            {"name": wrong, "api": wrong, "param_list": wrong},
            {"name": "f", "api": api, "param_list": [wrong, {"name": wrong, "value": wrong}]},
            {"name": "f", "api": {"comm_model": {"paradigm": wrong, "definition": wrong}}},
            {"name": "f", "api": {"comm_model": {"definition": {"class": wrong, "goal": wrong}}}},
        ):
            content = {"functions": [described], "sensors/actuators": [described, wrong]}
            names = {name for name, _, _ in said_of_json(json.dumps(content))}
            assert names, content


def test_size(tmp_path: Path) -> None:
    path = tmp_path / "large.xml"
    path.write_text(f"{HEAD}{STATE}</scxml>{' ' * 2**21}", encoding="utf-8")

    done = command.run("scxml", [path], [], None, force=False)
    assert [(f.name, f.message) for f in done.report] == [
        ("too-large", f"`{path}` is larger than 2 MB")
    ]


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="there is no file without an end")
def test_a_file_without_an_end(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["import", "adf", os.devnull.replace("null", "zero")]) == 1
    assert "`/dev/zero` is a device, not a file" in capsys.readouterr().err


def test_an_address_with_a_number_of_any_length() -> None:
    number = "9" * 5_000
    send = (
        f"<send event='Go' type='urn:swarmdsl:swarm' targetexpr=\"'uav[{number}]'\" "
        "xmlns:sw='urn:swarmdsl'/>"
    )
    text = (
        f"{HEAD}<state id='A'><transition event='Go' target='A'>{send}</transition></state></scxml>"
    )
    # The document is read: what it lacks is said of the model, and nothing of the number.
    assert not any(number in message for _, message in said(text))
