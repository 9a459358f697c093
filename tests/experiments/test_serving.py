"""Candidates of an optimizer of others, in messages as the tools of CPSwarm send them."""

from __future__ import annotations

import io
import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run as run_command
from swarmdsl.execution.experiments.serving.messages import read_message, status_text

from .conftest import MODEL, SCENARIO

# As Gson writes the classes of optimization-messages 2.0: without what is null, a seed as `long`.
CANDIDATE = (
    '{"SID":"3","simulationSeed":7,"parameters":[{"name":"patience","meta":"file:test_behavior",'
    '"value":%s},{"name":"robot","meta":"command_line","value":2.0}],"type":"RunSimulation",'
    '"OID":"test!0d7c"}'
)
# `candidate.json` of the orchestrator, with which it sends a simulation alone.
ALONE = (
    '{"SID":"1","simulationSeed":1234,"parameters":[{"name":"test","meta":"command_line",'
    '"value":2.0}],"type":"RunSimulation"}'
)
Serve = Callable[..., tuple[list[Any], str]]


@pytest.fixture
def serve(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Serve:
    """Serve a model; send lines, and return the answers and what is said."""
    monkeypatch.chdir(tmp_path)
    Path("model.swarm").write_text(MODEL, encoding="utf-8")
    Path("scenario.toml").write_text(SCENARIO, encoding="utf-8")

    def serve(*lines: str | bytes, words: tuple[str, ...] = ()) -> tuple[list[Any], str]:
        raw = b"".join(each.encode() if isinstance(each, str) else each for each in lines)
        monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(raw)))
        code = run_command(["serve", "model.swarm", "--scenario", "scenario.toml", *words])
        captured = capsys.readouterr()
        assert code == (1 if "error[SW0202]: no property" in captured.err else 0)
        answers = captured.out.splitlines()
        return [each if each == "error" else json.loads(each) for each in answers], captured.err

    return serve


def test_the_search_of_an_optimizer_finds_what_the_model_has(serve: Serve) -> None:
    """A stand-in for FREVO: it asks for one candidate after the other, and takes the best."""
    patiences = (2.0, 3.5, 5.0, 8.0)
    lines = [f"{CANDIDATE % each}\n" for each in patiences]
    answers, said = serve(*lines, words=("--seeds", "4"))

    assert said == ""
    assert [list(each) for each in answers] == [
        ["type", "OID", "success", "SID", "fitnessValue"],
    ] * 4
    assert {(each["type"], each["OID"], each["SID"]) for each in answers} == {
        ("SimulationResult", "test!0d7c", "3")
    }
    values = {
        patience: each["fitnessValue"] for patience, each in zip(patiences, answers, strict=True)
    }
    assert max(patiences, key=lambda each: values[each]) == 5.0
    # The fitness of the model: robots that are good, less the square of the distance from 5 s.
    assert values[5.0] - values[2.0] == pytest.approx(0.9)
    # One robot more or less shows that `robot` is the number of robots.
    fewer, _ = serve(f"{CANDIDATE % 5.0}\n".replace('"value":2.0', '"value":1.0'))
    assert fewer[0]["fitnessValue"] <= 1
    again, _ = serve(f"{CANDIDATE % 5.0}\n", words=("--seeds", "4", "--jobs", "1"))
    assert again == [answers[2]]


def test_what_is_wrong_is_told_and_answered(serve: Serve) -> None:
    answers, said = serve(
        f"{ALONE}\n",
        "\n",
        '[{"name":"test"}]\n',
        '{"type":"CancelOptimization","OID":"a"}\n',
        b"\xff\n",
        f"{CANDIDATE % 5.0}\n".replace('"value":2.0', '"value":2.5'),
        f"{CANDIDATE % 5.0}\n",
        words=("--subject-to", "Fine", "--seeds", "9"),
    )

    refused = {"type": "SimulationResult", "success": False, "SID": "1", "fitnessValue": 0.0}
    assert answers[0] == refused
    assert answers[1:4] == ["error"] * 3
    assert [each["success"] for each in answers[4:]] == [False, False]
    assert "error[SW0202]: no param or role of the swarm called `test`" in said
    assert "the names are `patience` and `robot`" in said
    assert "error[SW1831]: this is no message of an optimizer: " in said
    assert "its `type` is null, not RunSimulation" in said
    assert 'its `type` is "CancelOptimization"' in said
    assert "it is not JSON" in said
    assert "not `2.5` in 9 of 9 runs" in said
    assert "warning[SW1832]: the candidate is out: `Fine` is violated" in said
    answers, said = serve(words=("--subject-to", "Fin"))
    assert answers == []
    assert "error[SW0202]: no property of one run called `Fin`" in said
    assert "did you mean `Fine`?" in said


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"simulationSeed": 1.5}, "`simulationSeed` must be"),
        ({"SID": 3}, "must be strings"),
        ({"parameters": {}}, "must be a list"),
        ({"parameters": [{"value": 1}]}, "must have a `name`"),
        ({"parameters": [{"name": "a", "value": True}]}, "`value` of `a` must be a number"),
        ({"parameters": [{"name": "a", "value": 10**400}]}, "`value` of `a` must be a number"),
        ({"parameters": [{"name": "a", "meta": 1, "value": 1}]}, "`meta` of `a`"),
    ],
)
def test_fields_of_other_types_are_refused(change: dict[str, Any], reason: str) -> None:
    data = {"type": "RunSimulation", "parameters": [], **change}
    with pytest.raises(ValueError, match=reason):
        read_message(json.dumps(data))
    with pytest.raises(ValueError, match="not JSON"):
        read_message("[" * 100_000)


def test_the_presence_is_that_of_a_simulation_manager() -> None:
    status = json.loads(status_text())
    assert status == {
        "type": "SimulationManager",
        "capabilities": {"dimensions": 2, "maxAgents": 0},
    }


def test_accounts_are_checked_before_anything_is_done(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["serve", "--xmpp", "manager1@example.org:5222"]
    monkeypatch.delenv("SWARMDSL_XMPP_PASSWORD", raising=False)
    assert run_command(words) == 2
    assert "needs the password in SWARMDSL_XMPP_PASSWORD" in capsys.readouterr().err
    monkeypatch.setenv("SWARMDSL_XMPP_PASSWORD", "secret")
    assert run_command(["serve", "--xmpp", "manager1"]) == 2
    assert "no account like `manager1@example.org`" in capsys.readouterr().err
    monkeypatch.setattr("swarmdsl.cli.serve.find_spec", lambda name: None)
    assert run_command(words) == 1
    assert "error[SW1810]: `--xmpp` needs package `slixmpp`" in capsys.readouterr().err
