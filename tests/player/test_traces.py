"""Traces of robots, as `swarmc play` reads and tells them."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.cli import run

MODEL = """package lab
statemachine Blink {
  initial state Off { on Go -> On }
  state On { on Go -> Off }
}
event Go {}
"""
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
