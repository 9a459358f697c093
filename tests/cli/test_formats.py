"""The formats that other tools read: workflow commands of GitHub, and SARIF."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import tarfile
from io import StringIO
from pathlib import Path
from urllib.parse import unquote, urlsplit

import jsonschema
import pytest

from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.diagnostics.render import render
from swarmdsl.base.source import Source, Span

DIAGNOSTICS = Path(__file__).resolve().parents[1] / "diagnostics"
# The official schema, in the package of a tool that checks documents with it.
SCHEMA_PACKAGE = "@microsoft/jest-sarif@1.0.0-beta.0"
SCHEMA_FILE = "package/lib/schemas/sarif-2.1.0-rtm.5.json"


def rendered(report: Diagnostics, format_: str) -> str:
    stream = StringIO()
    render(report, format_, stream)
    return stream.getvalue()


def made_up(name: str = "a.swarm", text: str = "one\ntwo \U0001f916 three\nfour\n") -> Diagnostics:
    """Two diagnostics: one with everything there can be, and one without a place."""
    source = Source(name, text)
    report = Diagnostics()
    start = text.index("three")
    report.report(
        "duplicate-name",
        Span(source, start, start + 5),
        kind="event",
        name="100%\r\n::error::x",
        label="here: again, once more",
        related=(Label(Span(source, 0, 3), "first"), Label(Span(source, 0, len(text) - 1))),
        notes=("a note",),
        help="rename it",
    )
    report.report("target-left-out", target="smach")
    return report


# ---- GitHub

# https://github.com/actions/toolkit: `::command name=value,name=value::message`, in which %, CR
# and LF are escaped everywhere, `:` and `,` in values of properties too.
COMMAND = re.compile(
    r"::(error|warning) ((?:\w+=(?:[^%:,\r\n]|%25|%0D|%0A|%3A|%2C)*,?)+)"
    r"::((?:[^%\r\n]|%25|%0D|%0A)*)"
)


def unescaped(text: str) -> str:
    for code, character in (("%0D", "\r"), ("%0A", "\n"), ("%3A", ":"), ("%2C", ",")):
        text = text.replace(code, character)
    return text.replace("%25", "%")


def commands(printed: str) -> list[tuple[str, dict[str, str], str]]:
    found = []
    for line in printed.splitlines():
        match = COMMAND.fullmatch(line)
        assert match is not None, line
        properties = dict(pair.split("=", 1) for pair in match[2].split(","))
        read = {name: unescaped(value) for name, value in properties.items()}
        found.append((match[1], read, unescaped(match[3])))
    return found


def test_github_commands() -> None:
    without, error = commands(rendered(made_up("odd, 50%:name.swarm"), "github"))

    assert without == ("warning", {"title": "SW0911 target-left-out"}, without[2])
    assert error == (
        "error",
        {
            "file": "odd, 50%:name.swarm",
            "line": "2",
            "col": "7",
            "endLine": "2",
            "endColumn": "12",
            "title": "SW0201 duplicate-name",
        },
        # Nothing in a name can begin a command of its own.
        "\n".join(
            (
                "event `100%\ufffd\ufffd::error::x` is declared twice: here: again, once more",
                "note: a note",
                "help: rename it",
            )
        ),
    )


def test_github_has_no_end_column_in_another_line() -> None:
    source = Source("a.swarm", "one\ntwo\n")
    report = Diagnostics()
    report.report("unclosed-bracket", Span(source, 1, 6), bracket="{")
    ((_, properties, _),) = commands(rendered(report, "github"))

    assert (properties["line"], properties["endLine"]) == ("1", "2")
    assert "endColumn" not in properties


def test_paths_start_from_the_current_folder(swarmc, bad, tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    for path in (bad, bad.name, f"./{bad.name}"):
        printed = swarmc("check", path, "--format", "github").out
        assert {found[1]["file"] for found in commands(printed)} == {bad.name}

    monkeypatch.chdir(DIAGNOSTICS)
    (first, *_) = commands(swarmc("check", bad, "--format", "github").out)
    assert first[1]["file"] == bad.as_posix()


# ---- SARIF


@pytest.fixture(scope="session")
def schema(tmp_path_factory: pytest.TempPathFactory) -> dict[str, object]:
    """The schema of SARIF 2.1.0, from the registry of npm."""
    npm = shutil.which("npm")
    if npm is None:
        pytest.skip("no npm, which fetches the schema of SARIF: apt-get install npm")
    folder = tmp_path_factory.mktemp("sarif")
    command = [npm, "pack", "--silent", SCHEMA_PACKAGE]
    packed = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if packed.returncode != 0:
        pytest.skip(f"npm cannot fetch the schema of SARIF: {packed.stderr.strip()[-200:]}")
    with tarfile.open(next(folder.glob("*.tgz"))) as archive:
        file = archive.extractfile(SCHEMA_FILE)
        assert file is not None
        found = json.load(file)
        assert isinstance(found, dict)
        return found


def sarif_of_all_cases(swarmc, monkeypatch) -> list[dict]:
    monkeypatch.chdir(DIAGNOSTICS)
    cases = sorted(path.name for path in DIAGNOSTICS.glob("SW*") if path.suffix != ".txt")
    documents = [json.loads(swarmc("check", case, "--format", "sarif").out) for case in cases]
    documents.append(json.loads(rendered(made_up("../a b%/\u65e5:.swarm"), "sarif")))
    documents.append(json.loads(rendered(Diagnostics(), "sarif")))
    return documents


def test_sarif_follows_its_schema(swarmc, monkeypatch, schema) -> None:
    validator = jsonschema.validators.validator_for(schema)(
        schema, format_checker=jsonschema.FormatChecker()
    )
    wrong = json.loads(rendered(made_up(), "sarif"))
    wrong["runs"][0]["results"][0]["level"] = "fatal"
    assert not validator.is_valid(wrong)

    documents = sarif_of_all_cases(swarmc, monkeypatch)
    assert len(documents) > 50
    for document in documents:
        validator.validate(document)


def test_sarif_says_what_the_schema_cannot_check(swarmc, monkeypatch) -> None:
    for document in sarif_of_all_cases(swarmc, monkeypatch):
        (run,) = document["runs"]
        rules = run["tool"]["driver"]["rules"]
        assert run["columnKind"] == "unicodeCodePoints"
        assert len({rule["id"] for rule in rules}) == len(rules)
        for rule in rules:
            assert rule["help"]["text"].startswith(f"# {rule['id']} {rule['name']}\n")
            assert rule["defaultConfiguration"]["level"] == CODES[rule["name"]].severity
            assert rule["fullDescription"]["text"]
        for result in run["results"]:
            assert rules[result["ruleIndex"]]["id"] == result["ruleId"]
            for place in result.get("locations", []) + result.get("relatedLocations", []):
                uri = place["physicalLocation"]["artifactLocation"]["uri"]
                assert re.fullmatch(r"[\w.~%/+-]+", uri, re.ASCII)
                assert urlsplit(uri).scheme == ""
                region = place["physicalLocation"]["region"]
                start = (region["startLine"], region["startColumn"])
                assert (1, 1) <= start <= (region["endLine"], region["endColumn"])


def test_sarif_of_a_diagnostic() -> None:
    (run,) = json.loads(rendered(made_up("a b%.swarm"), "sarif"))["runs"]
    without, result = run["results"]

    assert (without["level"], without.get("locations")) == ("warning", None)
    assert (result["ruleId"], result["level"]) == ("SW0201", "error")
    assert result["message"]["text"].endswith("is declared twice\nnote: a note\nhelp: rename it")
    (place,) = result["locations"]
    assert place["message"]["text"] == "here: again, once more"
    physical = place["physicalLocation"]
    assert unquote(physical["artifactLocation"]["uri"]) == "a b%.swarm"
    # The robot before it is one code point.
    region = {"startLine": 2, "startColumn": 7, "endLine": 2, "endColumn": 12}
    assert physical["region"] == region
    first, second = result["relatedLocations"]
    assert (first["id"], first["message"]["text"]) == (0, "first")
    assert second["physicalLocation"]["region"]["endLine"] == 3
    assert "message" not in second


def test_sarif_of_a_denied_warning(swarmc, tmp_path) -> None:
    path = tmp_path / "m.swarm"
    path.write_text("event E : std_msgs/Empty\n/// nothing follows\n", encoding="utf-8")
    (run,) = json.loads(swarmc("check", path, "--deny", "warnings", "--format", "sarif").out)[
        "runs"
    ]

    assert [result["level"] for result in run["results"]] == ["error"]
    assert run["tool"]["driver"]["rules"][0]["defaultConfiguration"] == {"level": "warning"}


def test_sarif_of_a_silent_warning(swarmc, tmp_path) -> None:
    path = tmp_path / "m.swarm"
    path.write_text(
        "swarm event E : std_msgs/Empty\n"
        "statemachine M { initial A\nstate A { on E -> Z }\nfinal Z\n}\n",
        encoding="utf-8",
    )
    ran = swarmc("check", path, "--warn", "unsent-event", "--format", "sarif")
    (run,) = json.loads(ran.out)["runs"]

    assert [result["level"] for result in run["results"]] == ["warning"]
    assert run["tool"]["driver"]["rules"][0]["defaultConfiguration"] == {
        "level": "warning",
        "enabled": False,
    }


@pytest.mark.skipif(os.name == "nt", reason="such a name cannot be given to a file there")
def test_a_path_that_is_no_text_is_a_uri(swarmc, tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / os.fsdecode(b"\xff.swarm")
    path.write_text("nonsense", encoding="utf-8")
    (run,) = json.loads(swarmc("check", path.name, "--format", "sarif").out)["runs"]
    places = [result["locations"][0]["physicalLocation"] for result in run["results"]]

    assert {place["artifactLocation"]["uri"] for place in places} == {"%FF.swarm"}


def test_one_document_is_printed_for_a_good_model(swarmc, good) -> None:
    ran = swarmc("check", good, "--format", "sarif")
    (run,) = json.loads(ran.out)["runs"]

    assert (ran.code, run["results"], run["tool"]["driver"]["rules"]) == (0, [], [])
