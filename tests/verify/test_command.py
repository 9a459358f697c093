"""Arguments of `swarmc verify`, limits, formats and exit codes."""

from __future__ import annotations

import json
import re
import signal
from pathlib import Path

import pytest

from swarmdsl.cli import run
from swarmdsl.execution.verify.automata import limits

from .conftest import MODELS

WAITS = str(MODELS / "waits.swarm")
ABSENT = str(MODELS / "absent.swarm")


def test_the_exit_code_tells_violations(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["verify", WAITS]) == 1
    assert run(["verify", ABSENT]) == 0
    assert run(["verify", WAITS, "--property", "OneWaits"]) == 1
    assert "SW1702" not in capsys.readouterr().out.rpartition("Pair: ")[2]


@pytest.mark.parametrize(
    ("arguments", "code", "told"),
    [
        (["--limit", "0"], 2, "`0` leaves nothing to look at"),
        (["--limit", "0s"], 2, "`0s` leaves nothing to look at"),
        (["--limit", "soon"], 2, "`soon` is no number of states like `5M`"),
        (["--size", "worker"], 2, "`worker` is not a size like `robot=8`"),
        (["--size", "worker=3..2"], 2, "`worker=3..2` is not a size"),
        (["--size", "worker=3"], 1, "SW1709"),
        (["--size", "worker=2", "--size", "worker=2"], 2, "size of `worker` is given twice"),
        (["--size", "wroker=2"], 1, "did you mean `worker`?"),
        (["--property", "OneWait"], 1, "did you mean `OneWaits`?"),
        (["--channel", "0"], 2, "--channel': `0` is not an integer from 1 to 100"),
        (["--faults", "two"], 2, "--faults': `two` is not an integer from 0 to 1000"),
        (["--swarm", "Pairs"], 1, "did you mean `Pair`?"),
        (["--swarm", "Pair", "--machine", "Work"], 2, "conflict"),
    ],
)
def test_wrong_arguments_are_told(
    arguments: list[str], code: int, told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["verify", WAITS, *arguments]) == code
    printed = capsys.readouterr()
    assert told in printed.out + printed.err


def test_a_range_of_sizes_is_looked_at(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["verify", ABSENT, "--size", "seeker=2..3"]) == 0
    assert capsys.readouterr().out.startswith("Seekers: 2 to 3 seeker\n  2 seeker: 8 states, ")


def test_sizes_beyond_the_limit_are_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["verify", ABSENT, "--size", "seeker=2..4", "--limit", "1ms"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("Seekers: 2 seeker\n")
    assert "\n  2 larger sizes not looked at: the search came to its limit\n" in out


def test_a_swarm_of_nobody_is_told(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    model = tmp_path / "nobody.swarm"
    text = Path(ABSENT).read_text(encoding="utf-8").replace("Seeker[2..4]", "Seeker[*]")
    model.write_text(text, encoding="utf-8")

    assert run(["verify", str(model), "--size", "seeker=0"]) == 1
    assert "choose a member: `--size seeker=1`" in capsys.readouterr().out
    assert run(["verify", str(model), "--size", "seeker=0..1"]) == 0
    assert capsys.readouterr().out.startswith("Seekers: 1 seeker\n")
    # Where nobody is not allowed, one may not be enough.
    assert run(["verify", ABSENT, "--size", "seeker=0"]) == 1
    assert re.findall(r"error\[(\w+)\]", capsys.readouterr().out) == ["SW1709"]


def test_a_machine_alone_hears_what_other_robots_send(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert run(["verify", WAITS, "--machine", "Work"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("Work: one machine\n  3 states, 2 steps: all there are\n")
    assert "from outside, at any time: `Done`" in out
    assert "SW17" not in out


def test_formats_for_programs_have_the_diagnostics_only(
    capsys: pytest.CaptureFixture[str],
) -> None:
    run(["verify", WAITS, "--format", "json"])
    printed = capsys.readouterr()
    codes = [json.loads(line)["code"] for line in printed.out.splitlines()]

    assert codes == ["SW1702", "SW1701", "SW1701"]
    assert "BothEnd" in printed.err


def test_a_limit_of_states_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    run(["verify", WAITS, "--limit", "2"])
    out = capsys.readouterr().out

    assert "there are more" in out
    assert "holds up to" in out


def test_ctrl_c_tells_what_was_found(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, examples: Path
) -> None:
    allows = limits.Budget.allows

    def interrupt(budget: limits.Budget, states: int) -> bool:
        if states and not budget.interrupted:
            signal.raise_signal(signal.SIGINT)
        return allows(budget, states)

    monkeypatch.setattr(limits.Budget, "allows", interrupt)

    assert run(["verify", str(examples / "emergency_exit")]) == 130
    out = capsys.readouterr().out
    assert "there are more, as the search was interrupted" in out
    assert "unknown  the search was interrupted" in out
    assert "limit" not in out


def test_a_limit_of_time_ends_the_search_for_the_states_of_a_robot(
    capsys: pytest.CaptureFixture[str],
) -> None:
    run(["verify", str(MODELS / "explodes.swarm"), "--limit", "1ms"])

    out = capsys.readouterr().out
    why = "there are more, as the search came to its limit"
    assert re.search(rf"^  0 states, .*: {why}", out, re.MULTILINE)


def test_limits_of_time_and_memory_end_a_search(
    capsys: pytest.CaptureFixture[str], examples: Path
) -> None:
    for limit in ("1ms", "1MB"):
        run(["verify", str(examples / "emergency_exit"), "--limit", limit])
        assert "there are more" in capsys.readouterr().out


def test_a_folder_that_cannot_be_written_is_told(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    (tmp_path / "file").write_text("")

    assert run(["verify", WAITS, "-o", str(tmp_path / "file")]) == 1
    assert "cannot write" in capsys.readouterr().out
