"""The end of the time and Ctrl-C, in any step of a verification: by questions to the budget."""

from __future__ import annotations

import json
import re
import signal
from collections.abc import Callable, Iterator
from itertools import count
from pathlib import Path
from xml.etree import ElementTree

import pytest

from swarmdsl import cli
from swarmdsl.base import interrupts
from swarmdsl.cli import run
from swarmdsl.execution.simulate.evaluation.properties import watchable
from swarmdsl.execution.verify.automata.limits import Budget, Limits
from swarmdsl.execution.verify.findings.findings import survey
from swarmdsl.execution.verify.proofs.prove import prove
from swarmdsl.execution.verify.swarm.model import Model

MODEL = """package test
event Go : std_msgs/Empty
swarm event Ask : std_msgs/Empty
swarm event Yes : std_msgs/Empty
function land : abstraction { service "land" : std_srvs/Empty }
endless statemachine Flying {
  initial Fly
  state Fly {
    on Go / send Ask -> Wait
  }
  state Wait {
    on Yes -> Land
    after 2 s -> Fly
  }
  state Land {
    do land
    on succeeded, aborted -> Fly
  }
}
endless statemachine Answering {
  initial Idle
  state Idle { on Ask -> Busy }
  state Busy { after 1 s / send Yes -> Idle }
}
member Drone { behavior Flying }
member Base { behavior Answering }
swarm Field { drone : Drone[2]; base : Base }
property One of Field : never count(drone in Land) > 1
property Mine of Field : each drone : never in Land
property Down of Field : each drone : in Wait leads to in Land
property Soon of Field : each drone : in Wait leads to in Land within 1 s
property Can of Field : each drone : always possible in Fly
property Busy of Field : each base : never in Busy and not in Busy
"""
_STOPS = 6
"""Number of questions at which a verification is stopped: to stop at each takes minutes."""


def made_by(budget: Budget, model: Model) -> dict[str, str]:
    """Return the verdicts, and in how many states there may be faults, within a budget."""
    found = {"": "incomplete" if survey(model, budget).missing else "complete"}
    for each in watchable(model.subject):
        found[each.name] = prove(each, model, budget).outcome
    return found


def fresh_budget(seconds: float | None) -> tuple[Budget, Iterator[int]]:
    """Return a budget whose clock moves on at each question, and these moves."""
    asked = count()
    return Budget(Limits(seconds=seconds), clock=lambda: float(next(asked))), asked


def names_of_tests() -> list[str]:
    """Return the names of the saved tests."""
    path = Path("it.swarmtest.toml")
    text = path.read_text(encoding="utf-8") if path.exists() else "]\n"
    assert text.endswith("]\n")
    return re.findall(r'^name = "(.*)"$', text, re.MULTILINE)


def test_at_any_end_of_the_time_nothing_wrong_is_told_and_little_is_done_after_it(
    modelled: Callable[..., Model],
) -> None:
    model = modelled(MODEL, capacity=1, exact=True)
    unlimited, asked = fresh_budget(float("inf"))
    full = made_by(unlimited, model)
    questions = next(asked)
    assert set(full.values()) >= {"complete", "holds", "fails"}
    assert questions > 50

    for end in range(1, questions, questions // _STOPS):
        budget, asked = fresh_budget(end)
        for name, outcome in made_by(budget, modelled(MODEL, capacity=1, exact=True)).items():
            assert outcome in (full[name], "incomplete", "unknown", "up to"), (end, name)
        assert next(asked) - end < 20, end


def test_at_any_ctrl_c_files_are_whole_and_each_property_has_a_verdict(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("model.swarm").write_text(MODEL, encoding="utf-8")
    is_over = Budget.is_over
    asked = 0
    end: int | None = None

    def ask(budget: Budget) -> bool:
        nonlocal asked
        asked += 1
        if asked == end:
            signal.raise_signal(signal.SIGINT)
        return is_over(budget)

    def verify() -> int:
        nonlocal asked
        asked = 0
        Path("it.swarmtest.toml").unlink(missing_ok=True)
        files = ["-o", "runs", "--results", "r.json", "--junit", "r.xml"]
        saved = ["--save-test", "it.swarmtest.toml"]
        return run(["verify", "model.swarm", "--channel", "1", *files, *saved])

    monkeypatch.setattr(Budget, "is_over", ask)
    assert verify() == 1
    questions = asked
    saved = names_of_tests()
    assert len(saved) > 2
    capsys.readouterr()

    before = signal.getsignal(signal.SIGINT)
    for end in range(1, questions, questions // _STOPS):
        assert verify() == 130, end
        printed = capsys.readouterr()
        assert "the search was interrupted" in printed.out
        assert not printed.err
        found = json.loads(Path("r.json").read_text(encoding="utf-8"))["properties"]
        assert [each["name"] for each in found] == ["One", "Mine", "Down", "Soon", "Can", "Busy"]
        assert len(list(ElementTree.parse("r.xml").iter("testcase"))) == len(found)
        assert set(names_of_tests()) <= set(saved)
        assert signal.getsignal(signal.SIGINT) is before
    assert not list(tmp_path.rglob(".swarmc*"))


def test_tests_for_which_there_was_no_time_are_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    text = MODEL + "".join(
        f"property P{n} of Field : each drone : never in Land\n" for n in range(7)
    )
    Path("model.swarm").write_text(text, encoding="utf-8")
    is_spared = iter([True] * 3)

    def spares_a_moment(budget: Budget) -> bool:
        if next(is_spared, False):
            return True
        budget.reached = "time"
        return False

    monkeypatch.setattr(Budget, "spares_a_moment", spares_a_moment)
    chosen = [word for n in range(7) for word in ("--property", f"P{n}")]
    run(["verify", "model.swarm", "--save-test", "it.swarmtest.toml", *chosen, "--property", "One"])

    assert len(names_of_tests()) == 3
    named = ", ".join(f"P{n} for drone[1]" for n in range(2, 7))
    line = f"not written as a test: {named}: the search came to its limit of time"
    assert line in capsys.readouterr().out


def test_only_the_first_signal_is_kept_from_its_handler() -> None:
    kept: list[int] = []

    with interrupts.first_one(signal.SIGINT, lambda: kept.append(1)):
        signal.raise_signal(signal.SIGINT)
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)

    assert kept == [1]
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)


def test_an_import_that_a_signal_lets_fail_is_no_internal_error(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fail(_arguments: object) -> int:
        try:
            signal.raise_signal(signal.SIGINT)
        except KeyboardInterrupt:
            raise SyntaxError("cannot load unicodedata") from None
        return 0

    monkeypatch.setattr(cli, "_run_plainly", fail)
    before = signal.getsignal(signal.SIGINT)
    interrupts.install(signal.SIGINT, KeyboardInterrupt())
    try:
        assert run(["check"]) == 130
        assert capsys.readouterr().err == "\n"
    finally:
        signal.signal(signal.SIGINT, before)
