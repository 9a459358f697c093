"""No verdict is stronger than a run of the simulator that contradicts it."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run
from swarmdsl.execution.verify.swarm.model import Model

from .conftest import verdicts_of

_PRELUDE = """package test
message Word { word : uint8 }
message Text { text : string }
message Signed { header : swarmros/EventHeader }
message Length { metres : float64 }
event Measure : Length
event Go : std_msgs/Empty
event Tick : std_msgs/Empty
event Say : Text
swarm event Ask : Word
swarm event Tell : Word
swarm event Sign : Signed
"""
_SENDS = (
    "endless statemachine M {\n initial S0\n state S0 { on Go -> S0 }\n}\n"
    "endless statemachine N {\n initial S0\n state S0 { on Go / send Ask(word = 7) -> S0 }\n}\n"
)
_ONE = "member A { behavior M }\nswarm S { a : A[%s] }\n"
_TWO = "member A { behavior M }\nmember B { behavior N }\nswarm S {\n a : A\n b : B\n}\n"

# Models with a property `P` that a run with these events violates, and the verdict.
REFUTED: dict[str, tuple[str, Sequence[dict[str, Any]], str]] = {
    # The line after the event changes no fact, but ends that it was heard.
    "a_moment_ends_with_the_next_line": (
        "endless statemachine M {\n initial S0\n state S0 { on Go -> S1 }\n"
        " state S1 {\n on Tick -> S1\n on Say -> S2\n}\n state S2 { on Tick -> S2 }\n}\n"
        + _ONE % 1
        + "property P of S : each a : after hears Go, (hears Go or in S2) at all times",
        [{"event": "Go"}, {"event": "Tick"}],
        "fails",
    ),
    "a_moment_of_some_robot_ends_with_the_next_line": (
        "endless statemachine M {\n initial S0\n state S0 { on Go -> S1 }\n"
        " state S1 {\n on Tick -> S1\n on Say -> S2\n}\n state S2 { on Tick -> S2 }\n}\n"
        + _ONE % 2
        + "property P of S : after some a hears Go, (some a hears Go or some a in S2) at all times",
        [{"event": "Go"}, {"event": "Tick"}],
        "fails",
    ),
    "a_moment_ends_with_the_next_line_of_another_robot": (
        "endless statemachine M {\n initial S0\n state S0 { on Go -> S1 }\n"
        " state S1 { on Go -> S1 }\n}\n"
        + _ONE % 2
        + "property P of S : each a : after hears Go, hears Go at all times",
        [{"event": "Go"}],
        "fails",
    ),
    "a_moment_of_all_starts_ends_with_the_next_line": (
        "endless statemachine M {\n initial S0\n state S0 {\n entry / send Ask\n on Go -> S1\n}\n"
        " state S1 { on Ask -> S1 }\n}\n"
        + _ONE % 2
        + "property P of S : each a : (sends Ask or in S1) at all times",
        [],
        "fails",
    ),
    "a_model_compares_with_any_text": (
        "endless statemachine M {\n initial S0\n state S0 {\n"
        ' on Say [event.text == "another"] -> S0\n on Say [event.text == ""] -> S0\n'
        " on Say -> Bad\n}\n"
        " state Bad { on Tick -> S0 }\n}\n" + _ONE % 1 + "property P of S : each a : never in Bad",
        [{"event": "Say", "data": {"text": "x"}}],
        "fails",
    ),
    # Adding one to so large a number does not change it.
    "a_model_compares_with_a_large_number": (
        "endless statemachine M {\n initial S0\n"
        " state S0 { on Measure [event.metres > 20000000000000000000.0] -> Bad }\n"
        " state Bad { on Tick -> S0 }\n}\n" + _ONE % 1 + "property P of S : each a : never in Bad",
        [{"event": "Measure", "data": {"metres": 1e20}}],
        "fails",
    ),
    "a_message_from_outside_is_compared_in_a_property": (
        "endless statemachine M {\n initial S0\n state S0 { on Measure -> S0 }\n}\n"
        + _ONE % 1
        + "property P of S : each a : never hears Measure [event.metres > 5]",
        [{"event": "Measure", "data": {"metres": 6.0}}],
        "fails",
    ),
    "a_message_has_what_a_variable_has": (
        "endless statemachine M {\n var n : uint8 = 0\n initial S0\n state S0 {\n"
        " on Go [n < 9] / n = n + 1, send Ask(word = n) -> S0\n}\n}\n"
        + _ONE % 1
        + "property P of S : never some a sends Ask [event.word > 4 and n < 8]",
        [{"event": "Go"}] * 5,
        "fails",
    ),
    "a_message_that_is_heard_is_compared_with_a_variable": (
        "endless statemachine M {\n var n : uint8 = 0\n initial S0\n state S0 {\n"
        " on Go [n < 3] / n = n + 1, send Ask(word = n) -> S0\n on Ask -> S0\n}\n}\n"
        + _ONE % 2
        + "property P of S : each a : hears Ask [event.word <= n] at most 0 times",
        [{"event": "Go"}],
        "fails",
    ),
    # `a` does not hear it: whatever arrives at `b`, both facts can be true at that moment.
    "two_facts_about_an_event_of_another_robot": (
        "endless statemachine M {\n initial S0\n state S0 { on Tick -> S0 }\n}\n"
        "endless statemachine N {\n initial S0\n state S0 { on Measure -> S0 }\n}\n"
        + _TWO
        + "property P of S : each a : never (Measure [event.metres > 5] and Measure)",
        [{"event": "Measure", "member": "b[0]", "data": {"metres": 6.0}}],
        "fails",
    ),
    "a_part_sends_such_a_message": (
        _SENDS
        + "sensor Part { behavior N }\nmember A { behavior M; part : Part }\nswarm S { a : A[1] }\n"
        "property P of S : each a : never sends Ask [event.word > 5]",
        [{"event": "Go"}],
        "fails",
    ),
    # What `a` sends after its 20th state is not known; `b` hears it.
    "a_robot_with_too_many_states_may_send_anything": (
        "endless statemachine M {\n var n : uint16 = 0\n initial S0\n state S0 {\n"
        " on Go [n == 30] / send Ask(word = 1) -> S0\n on Go / n = n + 1 -> S0\n}\n}\n"
        "endless statemachine N {\n initial S0\n state S0 { on Ask -> Bad }\n"
        " state Bad { on Tick -> S0 }\n}\n" + _TWO + "property P of S : each b : never in Bad",
        [{"event": "Go"}] * 31,
        "up to",
    ),
    # `a` sends `Go` to itself only; `b` gets it from its own nodes.
    "an_event_of_one_robot_comes_to_another_from_outside": (
        "endless statemachine M {\n initial S0\n state S0 {\n on Tick / send Go -> S0\n"
        " on Go -> S0\n}\n}\nendless statemachine N {\n initial S0\n state S0 { on Go -> Bad }\n"
        " state Bad { on Tick -> S0 }\n}\n" + _TWO + "property P of S : each b : never in Bad",
        [{"event": "Go", "member": "b[0]"}],
        "fails",
    ),
    "an_event_from_outside_comes_in_the_name_of_a_robot": (
        "endless statemachine M {\n initial S0\n state S0 {\n"
        ' on Tell [event.sender == "a[1]"] -> Bad\n on Tell -> S0\n}\n'
        " state Bad { on Tick -> S0 }\n}\n" + _ONE % 2 + "property P of S : each a : never in Bad",
        [{"event": "Tell", "sender": "a[1]", "data": {"word": 1}}],
        "unknown",
    ),
    # A full array has no room for another word: the effects after it are skipped.
    "an_effect_without_a_value_ends_its_block": (
        "endless statemachine M {\n var words : uint8[<=2]\n initial S0\n state S0 {\n"
        " on Tick / append 1 to words -> S0\n on Go / append 1 to words, send Ask -> S1\n}\n"
        " state S1 { on Ask -> S1 }\n}\n"
        + _ONE % 2
        + "property P of S : each a : in S1 only after sends Ask",
        [{"event": "Tick"}, {"event": "Tick"}, {"event": "Go"}],
        "fails",
    ),
    "a_sending_without_a_value_does_not_happen": (
        "endless statemachine M {\n var n : uint8 = 0\n initial S0\n state S0 {\n"
        " on Tick / n = n + 125 -> S0\n on Go / send Ask(word = n + 10) -> S1\n}\n"
        " state S1 { on Ask -> S1 }\n}\n"
        + _ONE % 2
        + "property P of S : each a : in S1 only after sends Ask",
        [{"event": "Tick"}, {"event": "Tick"}, {"event": "Go"}],
        "fails",
    ),
    # The last of three is lost, not the one whose kind was found last.
    "what_is_sent_first_arrives": (
        "endless statemachine M {\n initial S0\n state S0 {\n"
        " on Measure / send Tell(word = 0) -> S1\n"
        " on Go / send Tell(word = 1), send Tell(word = 0), send Tell(word = 0) -> S1\n}\n"
        " state S1 { on Go -> S1 }\n}\n"
        "endless statemachine N {\n initial S0\n state S0 {\n on Tell [event.word == 1] -> Bad\n"
        " on Tell -> S0\n}\n state Bad { on Tick -> S0 }\n}\n"
        + _TWO
        + "property P of S : each b : never in Bad",
        [{"event": "Go"}],
        "fails",
    ),
    # Messages that differ in nothing but their senders are compared as a whole.
    "a_message_that_is_kept_has_its_sender_in_it": (
        "statemachine M {\n var kept : Signed[<=2]\n initial S0\n state S0 {\n"
        " on Go / send Sign -> S0\n"
        ' on Sign [any(k in kept where k.header.node == "a[1]")] -> Bad\n'
        " on Sign [len(kept) < 2] / append event to kept -> S0\n}\n final Bad\n}\n"
        + _ONE % 3
        + "property P of S : each a : never in Bad",
        [{"event": "Go", "member": "a[1]"}] * 2,
        "fails",
    ),
}


@pytest.mark.parametrize("name", REFUTED)
def test_what_a_run_refutes_does_not_hold(
    name: str,
    modelled: Callable[..., Model],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    text, events, outcome = REFUTED[name]
    monkeypatch.setattr("swarmdsl.execution.verify.swarm.model.MOST_STATES", 20)
    model = modelled(_PRELUDE + text)
    path = tmp_path / "events.jsonl"
    path.write_text("".join(f"{json.dumps({'after': 10, **each})}\n" for each in events))

    run(["simulate", str(tmp_path / "model.swarm"), "--events", str(path), "--until", "10s"])
    assert "property `P` is violated" in capsys.readouterr().err
    assert verdicts_of(model)["P"].outcome == outcome


_COUNTS = "on Go [n < 2] / n = n + 1, send Ask(word = n) -> S0"
_MEASURES = "on Measure / send Ask(word = round(event.metres * 2)) -> S0"


@pytest.mark.parametrize(
    ("transition", "condition", "outcome", "reason"),
    [
        (_COUNTS, "event.word > 2", "holds", ""),
        (_COUNTS, "event.word > 0 and n == 0", "fails", ""),
        (_COUNTS, 'event.sender == "a[0]" and event.word == 1', "fails", ""),
        (_COUNTS, "event.sent > 3 s", "unknown", "the model reads the time"),
        (_MEASURES, "event.word > 4", "unknown", "only some values of `Measure.metres`"),
    ],
)
def test_conditions_on_messages_are_proved(
    transition: str, condition: str, outcome: str, reason: str, modelled: Callable[..., Model]
) -> None:
    model = modelled(
        _PRELUDE + "endless statemachine M {\n var n : uint8 = 0\n initial S0\n state S0 {\n"
        f" {transition}\n on Ask -> S0\n}}\n}}\n"
        + _ONE % 2
        + f"property P of S : never some a hears Ask [{condition}]"
    )
    verdict = verdicts_of(model)["P"]
    assert verdict.outcome == outcome
    assert verdict.reason.startswith(reason)


def test_what_is_possible_only_by_overtaking_is_unknown(modelled: Callable[..., Model]) -> None:
    model = modelled(
        _PRELUDE + "endless statemachine M {\n initial S0\n"
        " state S0 { on Go / send Ask(word = 0), send Ask(word = 1) -> S1 }\n"
        " state S1 { on Tell -> S0 }\n}\n"
        "endless statemachine N {\n initial S0\n"
        " state S0 {\n on Ask [event.word == 1] -> Goal\n on Ask -> Mid\n}\n"
        " state Mid {\n on Ask [event.word == 1] / send Tell -> S0\n on Ask -> Mid\n}\n"
        " state Goal { on Ask / send Tell -> S0 }\n}\n"
        + _TWO
        + "property P of S : each b : always possible in Goal"
    )
    verdict = verdicts_of(model)["P"]

    assert (verdict.outcome, "order of events on `ask`" in verdict.reason) == ("unknown", True)


def test_a_chain_of_too_many_claims_is_unknown(modelled: Callable[..., Model]) -> None:
    chain = " then ".join(f"some a in S{number % 2}" for number in range(10))
    model = modelled(
        _PRELUDE + "endless statemachine M {\n initial S0\n state S0 { on Go -> S1 }\n"
        " state S1 { on Go -> S0 }\n}\n"
        + _ONE % 1
        + f"property P of S : before some a hears Tick, {chain}"
    )
    verdict = verdicts_of(model)["P"]

    assert (verdict.outcome, verdict.reason) == (
        "unknown",
        "it has more than 10 claims: split it into several properties",
    )


_TWICE = (
    "package test\nevent Go : std_msgs/Empty\nswarm event Said : std_msgs/Empty { %s }\n"
    "statemachine M {\n initial S0\n state S0 { on Go / send Said -> S1 }\n"
    " state S1 { on Go / send Said -> End }\n final End\n}\n"
    "statemachine N {\n initial S0\n state S0 { on Said -> S1 }\n state S1 { on Said -> End }\n"
    " final End\n}\n" + _TWO + "property P of S : each b : always possible in End"
)


def test_reliable_events_of_which_the_oldest_are_dropped_may_be_lost(
    modelled: Callable[..., Model], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    outcomes = []
    for delivery in ("reliable", "reliable, keep 1"):
        model = modelled(_TWICE % delivery, lossy=True)
        outcomes.append(verdicts_of(model)["P"].outcome)
    (tmp_path / "apart.toml").write_text(
        '[[faults]]\nat = "0s"\nlasts = "10s"\napart = [["a"], ["b"]]\n'
    )
    go = json.dumps({"event": "Go", "member": "a[0]", "after": 10})
    (tmp_path / "go.jsonl").write_text(f"{go}\n{go}\n")
    files = ["--scenario", str(tmp_path / "apart.toml"), "--events", str(tmp_path / "go.jsonl")]

    run(["simulate", str(tmp_path / "model.swarm"), *files, "--trace", "text"])
    trace = capsys.readouterr().out

    assert "b[0]  Said -> S1" in trace
    assert "b[0]  Said -> End" not in trace
    assert outcomes == ["holds", "fails"]


_MANY = (
    _PRELUDE + "statemachine M {\n initial S0\n state S0 { on Go / send Ask(word = 1), "
    "send Ask(word = 2), send Ask(word = 3) -> S1 }\n"
    " state S1 { on Go / send Ask(word = 4) -> End }\n final End\n}\n"
    "endless statemachine N {\n initial S0\n state S0 { on Ask [event.word == 1] -> S1 }\n"
    " state S1 { on Ask [event.word == 2] -> S2 }\n"
    " state S2 {\n on Ask [event.word == 3] -> Good\n on Ask [event.word == 4] -> Bad\n}\n"
    " state Good\n state Bad\n}\n" + _TWO
)


@pytest.mark.parametrize("claim", ["never in Bad", "always possible (in Good or in Bad)"])
def test_no_run_loses_what_is_beyond_the_capacity(
    claim: str, modelled: Callable[..., Model]
) -> None:
    text = f"{_MANY}property P of S : each b : {claim}"
    verdict = verdicts_of(modelled(text))["P"]

    assert verdict.outcome == "unknown"
    assert "of more than 2 `Ask` on the way to a robot, one is lost in it" in verdict.reason


def test_a_run_of_a_lossy_network_names_what_is_beyond_the_capacity(
    modelled: Callable[..., Model],
) -> None:
    model = modelled(f"{_MANY}property P of S : each b : never in Bad", lossy=True)
    verdict = verdicts_of(model)["P"]

    assert verdict.outcome == "fails"
    assert verdict.run is not None
    assert [(event, robot) for _, event, robot in verdict.run.lost] == [("Ask", "b[0]")]
