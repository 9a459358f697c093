"""Simulations of small models, run by the command line."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run

PRELUDE = """
package test
action Go { goal { speed : float64 } result { id : string, count : int32 } }
message Report { id : string, level : int32 }
function go : abstraction { action "cmd/go" : Go }
function land : abstraction { service "cmd/land" : std_srvs/Empty }
event Start : std_msgs/Empty
event Stop : std_msgs/Empty
swarm event Found : Report
"""


@dataclass
class Ran:
    """Result of a run: exit code, output with the trace, and messages."""

    code: int
    out: str
    err: str

    @property
    def trace(self) -> list[dict[str, Any]]:
        return [json.loads(line) for line in self.out.splitlines()]

    def of(self, member: str | None) -> list[dict[str, Any]]:
        return [line for line in self.trace if line["member"] == member]

    def steps(self, member: str | None = None) -> list[tuple[int, str | None, list[str]]]:
        """Return the time, event and configuration of each step."""
        return [(line["t"], line["event"], line["configuration"]) for line in self.of(member)]


Simulate = Callable[..., Ran]


@pytest.fixture
def simulate(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> Simulate:
    """Simulate a model, or a document, with lines of events and a scenario."""
    monkeypatch.chdir(tmp_path)

    def simulate(
        text: str, *arguments: str, events: Any = None, scenario: str | None = None
    ) -> Ran:
        name = "model.scxml" if text.lstrip().startswith("<") else "model.swarm"
        Path(name).write_text(text if name == "model.scxml" else PRELUDE + text, encoding="utf-8")
        words = ["simulate", name, "--trace", "json", *arguments]
        if events is not None:
            lines = events if isinstance(events, str) else "\n".join(map(json.dumps, events))
            Path("events.jsonl").write_text(lines, encoding="utf-8")
            words += ["--events", "events.jsonl"]
        if scenario is not None:
            Path("scenario.toml").write_text(scenario, encoding="utf-8")
            words += ["--scenario", "scenario.toml"]
        code = run(words)
        captured = capsys.readouterr()
        return Ran(code, captured.out, captured.err)

    return simulate
