"""Traces of robots, as `swarmc play` reads and tells them."""

from __future__ import annotations

import json
import zlib
from base64 import b64decode
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run

MODEL = """package lab
event Go : std_msgs/Empty
endless statemachine Blink {
  var count : int32 = 0
  initial Off
  state Off { on Go [count < 9] / count = count + 1 -> On }
  state On { on Go -> Off }
}
"""
MODEL_OF_A_SWARM = "member Lamp { behavior Blink }\nswarm Lamps { lamp : Lamp[1..4] }\n"
Played = Callable[..., tuple[int, str, Path]]


def line(t: int, member: str | None, event: str | None, state: str, **more: object) -> str:
    lists = {"entered": [state], "exited": [], "started": [], "cancelled": [], "sent": []}
    values = {"t": t, "member": member, "event": event, "configuration": [state], **lists, **more}
    return json.dumps(values)


@pytest.fixture
def played(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Played:
    """Play traces given as text; return the exit code, what was said and the page."""
    monkeypatch.chdir(tmp_path)

    def play(*traces: str, model: str = "") -> tuple[int, str, Path]:
        arguments = ["play", "-o", "run.html"]
        if model:
            Path("model.swarm").write_text(model, encoding="utf-8")
            arguments.append("model.swarm")
        for number, text in enumerate(traces):
            Path(f"{number}.jsonl").write_text(text, encoding="utf-8", newline="\n")
            arguments += ["--trace", f"{number}.jsonl"]
        code = run(arguments)
        return code, capsys.readouterr().err, tmp_path / "run.html"

    return play


def test_clocks_that_differ_are_told(played: Played) -> None:
    envelope = {"sender": "b[0]", "sent": 4_000_000_000}
    one = [line(0, "a[0]", None, "Off"), line(1000, "a[0]", "Go", "On", envelope=envelope)]
    other = [line(0, "b[0]", None, "Off"), line(2000, "b[0]", "Go", "On")]
    other.append(line(500, "b[0]", "Go", "Off"))
    code, err, page = played("\n".join(one), "\n".join(other))
    assert code == 0
    assert page.exists()
    assert err.count("SW1023") == 2
    assert "`Go` of `b[0]` arrives 3 s before it was sent" in err
    assert "its time goes back by 1.5 s" in err


def recording_of(page: Path) -> dict[str, Any]:
    """Return the recording in a page, as its script reads it."""
    text = page.read_text(encoding="utf-8")
    packed = text.partition('id="recording">')[2].partition("</script>")[0]
    recording: dict[str, Any] = json.loads(zlib.decompress(b64decode(packed)))
    return recording


GOOD = [line(0, None, None, "Off"), line(1000, None, "Go", "On", exited=["Off"])]


def test_a_trace_of_the_model_has_its_variables_and_places(played: Played) -> None:
    code, err, page = played("\n".join(GOOD), model=MODEL)
    assert (code, err) == (0, "run.html\n")
    recording = recording_of(page)
    assert recording["notes"] == []
    assert [each["name"] for each in recording["members"]] == ["Blink"]
    assert recording["count"] == 2
    assert recording["lines"]["values"] == [{"count": 0}, {"count": 1}]
    (source,) = recording["sources"]
    assert recording["machines"]["Blink"]["places"]["On"] == [source, 7]


@pytest.mark.parametrize(
    ("lines", "said", "shown"),
    [
        ([*GOOD, line(2000, None, "Go", "Broken", exited=["On"])], "SW1011", 3),
        ([*GOOD, '{"t": 2000, "member": nul'], "SW1010", 2),
        ([*GOOD, line(3000, None, "Go", "Off", at=["x", 1], moved=3, lost=[1])], "SW1011", 3),
    ],
    ids=["another version", "cut", "odd values"],
)
def test_what_is_wrong_is_told_in_the_page_and_the_rest_is_shown(
    played: Played, lines: list[str], said: str, shown: int
) -> None:
    code, err, page = played("\n".join(lines), model=MODEL)
    assert code == 1
    assert f"error[{said}]" in err
    assert "0.jsonl:3:1" in err
    recording = recording_of(page)
    assert [each["code"] for each in recording["notes"]] == [said]
    assert recording["notes"][0]["place"] == "0.jsonl:3:1"
    assert recording["count"] == shown


def test_a_trace_of_other_robots_is_told_and_shown(played: Played) -> None:
    lines = [line(0, "uav[0]", None, "Up"), line(0, "lamp[3]", None, "Off")]
    code, err, page = played("\n".join(lines), model=MODEL + MODEL_OF_A_SWARM)
    assert code == 1
    assert "error[SW0202]: no member called `uav[0]`" in err
    recording = recording_of(page)
    assert [each["name"] for each in recording["members"]] == ["uav[0]", "lamp[3]"]
    assert recording["machines"]["uav"]["states"] == ["Up"]


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "SW1019"),
        (b"\x00\xff\x7fELF" * 50, "SW0004"),
        (b"\xff\xfe{\x00", "SW0004"),
        (None, "SW0001"),
    ],
    ids=["empty", "binary", "UTF-16", "missing"],
)
def test_a_file_without_lines_gives_no_page(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    content: bytes | None,
    said: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    trace, page = tmp_path / "run.jsonl", tmp_path / "run.html"
    if content is not None:
        trace.write_bytes(content)
    assert run(["play", "--trace", str(trace), "-o", str(page)]) == 1
    err = capsys.readouterr().err
    assert f"[{said}]" in err
    assert "Traceback" not in err
    assert not page.exists()


def test_many_invalid_lines_are_counted(played: Played) -> None:
    code, err, page = played("\n".join([*GOOD, *["?"] * 500]), model=MODEL)
    assert code == 1
    assert err.count("SW1010") == 21
    assert "480 more lines are no lines of a trace" in err
    assert recording_of(page)["count"] == 2


def test_an_output_in_the_place_of_an_input_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    trace = tmp_path / "run.jsonl"
    trace.write_text("\n".join(GOOD), encoding="utf-8")
    assert run(["play", "--trace", str(trace), "-o", str(trace)]) == 2
    assert "is an input of this command" in capsys.readouterr().err
    assert trace.read_text(encoding="utf-8") == "\n".join(GOOD)


def test_bytes_that_are_no_text_and_deep_values_are_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    deep = line(2000, None, "Go", "Off", data="DEEP").replace('"DEEP"', "[" * 900 + "]" * 900)
    text = "\n".join([*GOOD, deep, line(3000, None, "Go", "Müde")])
    Path("run.jsonl").write_bytes(text.encode().replace(b"\\u00fc", b"\xc3"))
    assert run(["play", "--trace", "run.jsonl"]) == 1
    err = capsys.readouterr().err
    assert "error[SW0004]" in err
    assert "nested more than 100 levels deep" in err
    recording = recording_of(Path("run.html"))
    assert [each["code"] for each in recording["notes"]] == ["SW1010", "SW0004"]
    assert recording["machines"]["machine"]["states"] == [
        "Off",
        "On",
        "M\N{REPLACEMENT CHARACTER}de",
    ]


def test_numbers_and_names_beyond_all_measure_leave_the_rest(played: Played) -> None:
    """The page has JSON that each browser reads; clocks that cannot be are told."""
    odd = [
        line(10, "a[0]", "Go", "On", data={"x": "LARGE"}, at=[1, 2]).replace('"LARGE"', "1e999"),
        line(20, "a[0]", "Go", "Off", data={"x": "NONE"}, at=[1, 2, 3]).replace('"NONE"', "NaN"),
        line(30, f"a[{'9' * 5000}]", None, "Off"),
        line(40, "a[0]", "Go", "On", envelope={"sender": "b[0]", "sent": 10**400}),
        line(50, "a[0]", "Go", "On", envelope={"sender": "b[0]", "sent": 10**15}),
        '{"t": 60, "property": "P", "member": {}, "envelope": 5, "configuration": 5}',
    ]
    code, err, page = played("\n".join([line(0, "a[0]", None, "Off"), *odd]))
    assert code == 0
    assert err.count("SW1023") == 1
    assert "`Go` of `b[0]` arrives" in err

    def refuse(constant: str) -> None:
        raise AssertionError(constant)

    packed = page.read_text(encoding="utf-8").partition('id="recording">')[2].partition("<")[0]
    recording = json.loads(zlib.decompress(b64decode(packed)), parse_constant=refuse)
    assert recording["count"] == 7
    assert recording["lines"]["values"] == [{"x": "Infinity"}, {"x": "NaN"}]
    assert recording["lines"]["columns"]["at"] == [[1000, 2000], [1000, 2000, 3000]]
    assert len(recording["lines"]["columns"]["envelope"]) == 1


def test_a_trace_of_params_without_a_value_says_that_it_is_not_compared(played: Played) -> None:
    model = MODEL.replace("  var count", "  param most : int32\n  var count")
    code, err, page = played("\n".join([*GOOD, line(2000, None, "Go", "Broken")]), model=model)
    assert code == 0
    said = "param `most` of `Blink` has no value: traces are not compared with the model"
    assert f"warning[SW1005]: {said}" in err
    (note,) = recording_of(page)["notes"]
    assert (note["severity"], note["message"]) == ("warning", said)


def test_a_page_tells_how_many_diagnostics_it_leaves_out(played: Played) -> None:
    lines = [line(0, f"other{number}", None, "Off") for number in range(60)]
    code, _, page = played("\n".join([*GOOD, *lines]), model=MODEL + MODEL_OF_A_SWARM)
    assert code == 1
    notes = recording_of(page)["notes"]
    assert len(notes) == 51
    assert notes[-1]["message"] == "11 more diagnostics are in the output of the command"
