"""Rendering of diagnostics, for people and for programs."""

import io
import json

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.diagnostics.render import FORMATS, render, summary
from swarmdsl.base.source import Source, Span


def span(text: str, piece: str, name: str = "sar.swarm") -> Span:
    source = Source(name, text)
    start = text.index(piece)
    return Span(source, start, start + len(piece))


def report_of(at: Span | None, **details) -> Diagnostics:
    report = Diagnostics()
    report.report("unresolved-name", at, kind="state", name="Coverag", **details)
    return report


def rendered(report: Diagnostics, format_: str = "text") -> str:
    stream = io.StringIO()
    render(report, format_, stream)
    return stream.getvalue()


MODEL = "package x\n\n\n  state Coverage\n  on go -> Coverag\n"


def test_text_shows_the_place_what_explains_it_and_the_way_out():
    at = span(MODEL, "Coverag\n")
    at = at._replace(end=at.end - 1)
    declared = Span(at.source, MODEL.index("Coverage"), MODEL.index("Coverage") + 8)
    report = report_of(
        at,
        label="no such state in `Search`",
        related=(Label(declared, "a state with a similar name"),),
        notes=("states are found by name",),
        help="did you mean `Coverage`?",
    )
    assert rendered(report) == (
        "error[SW0202]: no state called `Coverag`\n"
        " --> sar.swarm:5:12\n"
        "  |\n"
        "5 |   on go -> Coverag\n"
        "  |            ^^^^^^^ no such state in `Search`\n"
        "note: a state with a similar name\n"
        " --> sar.swarm:4:9\n"
        "  |\n"
        "4 |   state Coverage\n"
        "  |         --------\n"
        "  = note: states are found by name\n"
        "  = help: did you mean `Coverage`?\n"
        "\n"
    )


def test_text_without_a_place():
    assert rendered(report_of(None, help="look again")) == (
        "error[SW0202]: no state called `Coverag`\n  = help: look again\n\n"
    )


@pytest.mark.parametrize(
    ("line", "indent"),
    [("\tHERE", 4), ("日本 HERE", 5), ("a\tb HERE", 7), ("e\N{COMBINING ACUTE ACCENT} HERE", 2)],
)
def test_marks_stand_under_the_place_whatever_comes_before(line, indent):
    shown = rendered(report_of(span(line, "HERE"))).splitlines()
    assert shown[4] == "  | " + " " * indent + "^^^^"


def test_a_wide_place_is_marked_in_full():
    assert rendered(report_of(span("x 日本 y", "日本"))).splitlines()[4] == "  |   ^^^^"


def test_a_place_over_lines_is_marked_to_the_end_of_its_first():
    shown = rendered(report_of(span("state A {  \n  do x\n}", "A {  \n  do x\n}"))).splitlines()
    assert shown[3:5] == ["1 | state A {", "  |       ^^^"]


def test_the_end_of_a_file_can_be_marked():
    source = Source("x.swarm", "ab\n")
    assert rendered(report_of(Span(source, 3, 3))).splitlines()[1:5] == [
        " --> x.swarm:2:1",
        "  |",
        "2 | ",
        "  | ^",
    ]


def test_a_very_long_line_is_cut_around_the_place():
    line = "abc, " * 2000 + "HERE" + " def" * 2000
    shown = rendered(report_of(span(line, "HERE"))).splitlines()
    assert all(len(part) <= 125 for part in shown)
    column = shown[4].index("^")
    assert shown[3][column : column + 4] == "HERE"
    assert shown[4].count("^") == 4
    assert shown[3].startswith("1 | …")
    assert shown[3].endswith("…")


def test_a_very_long_place_is_cut_too():
    shown = rendered(report_of(span("x = " + "y" * 5000, "y" * 5000))).splitlines()
    assert len(shown[3]) <= 125
    assert len(shown[4]) == len(shown[3])


def test_long_messages_are_not_wrapped():
    report = report_of(span("HERE", "HERE"), label="word " * 100 + "end")
    assert rendered(report).splitlines()[4].endswith("end")


def test_text_of_the_model_cannot_steer_the_terminal():
    line = "[bold]x[/bold] :smile: \x1b[31m\N{RIGHT-TO-LEFT OVERRIDE} HERE"
    report = Diagnostics()
    report.report("unresolved-name", span(line, "HERE"), kind="[red]\x1b]0;t\x07", name="a\nb")
    text = rendered(report)
    assert "[bold]x[/bold] :smile: " in text
    assert "[red]" in text
    assert text.replace("\n", "").isprintable()
    assert len(text.splitlines()) == 6
    assert len(rendered(report, "concise").splitlines()) == 1
    assert rendered(report, "concise").strip().isprintable()
    assert len(rendered(report, "json").splitlines()) == 1


def test_colour_is_for_terminals_only(monkeypatch):
    class Terminal(io.StringIO):
        def isatty(self):
            return True

    report = report_of(span("HERE", "HERE"))
    for variable in ("NO_COLOR", "FORCE_COLOR"):
        monkeypatch.delenv(variable, raising=False)
    monkeypatch.setenv("TERM", "xterm-256color")
    stream = Terminal()
    render(report, "text", stream)
    assert "\x1b[" in stream.getvalue()
    assert "\x1b" not in rendered(report)
    monkeypatch.setenv("NO_COLOR", "1")
    stream = Terminal()
    render(report, "text", stream)
    assert "\x1b[31" not in stream.getvalue()
    assert "\x1b[1;31" not in stream.getvalue()


def test_concise():
    report = report_of(span(MODEL, "on go"))
    report.report("file-not-found", path="y.swarm")
    assert rendered(report, "concise") == (
        "error[SW0001] no such file: `y.swarm`\n"
        "sar.swarm:5:3: error[SW0202] no state called `Coverag`\n"
    )


def test_json():
    related = (Label(span(MODEL, "Coverage"), "here"),)
    report = report_of(
        span(MODEL, "state Coverage\n  on"), label="l", related=related, notes=("n",), help="h"
    )
    assert json.loads(rendered(report, "json")) == {
        "file": "sar.swarm",
        "line": 4,
        "column": 3,
        "end_line": 5,
        "end_column": 5,
        "severity": "error",
        "code": "SW0202",
        "name": "unresolved-name",
        "message": "no state called `Coverag`",
        "label": "l",
        "help": "h",
        "related": [
            {
                "file": "sar.swarm",
                "line": 4,
                "column": 9,
                "end_line": 4,
                "end_column": 17,
                "message": "here",
            }
        ],
        "notes": ["n"],
        "fixes": [],
    }


def test_json_without_a_place():
    found = json.loads(rendered(report_of(None), "json"))
    assert (found["file"], found["line"], found["end_column"]) == (None, None, None)


@pytest.mark.parametrize("format_", sorted({*FORMATS} - {"sarif"}))  # which is a document
def test_nothing_found_is_nothing_printed(format_):
    assert rendered(Diagnostics(), format_) == ""


def test_summary():
    report = Diagnostics()
    assert summary(report, 1) == "no errors in 1 file"
    report.report("nothing-to-generate", target="a")
    assert summary(report, 2) == "1 warning in 2 files"
    report.report("file-not-found", path="a")
    report.report("file-not-found", path="b")
    assert summary(report, 3) == "2 errors, 1 warning in 3 files"
