"""Deferred events, and events that are sent later."""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.cli import run

from .conftest import Simulate


def test_a_deferred_event_waits_for_a_state_that_does_not_defer_it(simulate: Simulate) -> None:
    text = """
    statemachine M {
      var n : int32 = 0
      initial A
      state A { defer Found; on Start -> B }
      state B { on Found / n = n + event.level -> C }
      state C { defer Stop; on Found [event.level == n + 1] -> End }
      final End
    }
    """
    found = [{"event": "Found", "data": {"level": n}} for n in (1, 2)]
    events = [*found, {"event": "Start"}]

    ran = simulate(text, events=events)
    told = simulate(text, "--trace", "text", events=events)

    assert ran.steps() == [
        (0, None, ["A"]),
        (0, "Found", ["A"]),
        (0, "Found", ["A"]),
        (0, "Start", ["B"]),
        (0, "Found", ["C"]),
        (0, "Found", ["End"]),
    ]
    assert [line["data"]["level"] for line in ran.trace if "data" in line] == [1, 2, 1, 2]
    assert told.out.splitlines()[1:] == [
        "     0.000  Found (deferred)",
        "     0.000  Found (deferred)",
        "     0.000  Start -> B",
        "     0.000  Found (recalled) -> C",
        "     0.000  Found (recalled) -> End",
    ]
    assert "ignored event" not in ran.err


def test_a_recalled_event_that_no_state_handles_is_ignored(simulate: Simulate) -> None:
    text = """
    statemachine M {
      initial A
      state A { defer Stop; on Start -> B }
      state B { on Found -> A; on Start -> C }
      state C { on Stop -> End }
      final End
    }
    """
    ran = simulate(text, "--trace", "text", events=[{"event": "Stop"}, {"event": "Start"}])

    assert ran.out.splitlines()[-1] == "     0.000  Stop (recalled, ignored)"


@pytest.mark.parametrize(
    ("inner", "outer", "ends"),
    [
        ("on Stop -> B", "defer Stop; on Found -> End", "W.B"),
        ("defer Stop", "on Stop -> End", "W.A"),
        ("on Found -> B", "defer Stop; on Start -> End", "W.A"),
        ("on Found -> B", "defer Stop; on Stop [n > 0] -> End", "W.A"),
        ("on Found -> B", "defer Stop; on Stop [n == 0] -> End", "End"),
    ],
)
def test_the_innermost_of_deferral_and_transition_decides(
    simulate: Simulate, inner: str, outer: str, ends: str
) -> None:
    text = f"""
    statemachine M {{
      var n : int32 = 0
      initial W
      state W {{
        {outer}
        initial A
        state A {{ {inner} }}
        state B {{ on Found -> A }}
      }}
      final End
    }}
    """
    ran = simulate(text, events=[{"event": "Stop"}])

    assert ran.trace[-1]["configuration"] == [ends]
    assert ran.trace[-1].get("deferred", False) == (ends == "W.A")


def test_a_region_that_handles_an_event_consumes_it(simulate: Simulate) -> None:
    text = """
    statemachine M {
      initial P
      parallel state P {
        region Keep { initial A; state A { defer Stop; on Start -> B }; state B { on Stop -> A } }
        region Take { initial C; state C { on Stop -> D }; state D { on Found -> C } }
        on Stop -> End
      }
      final End
    }
    """
    events = [{"event": "Stop"}, {"event": "Stop"}, {"event": "Start"}]
    ran = simulate(text, events=events)

    # The second one is deferred, although the state around both regions would handle it.
    assert ran.steps()[1:] == [
        (0, "Stop", ["P.Keep.A", "P.Take.D"]),
        (0, "Stop", ["P.Keep.A", "P.Take.D"]),
        (0, "Start", ["P.Keep.B", "P.Take.D"]),
        (0, "Stop", ["P.Keep.A", "P.Take.D"]),
    ]
    assert [line.get("deferred", False) for line in ran.trace[1:]] == [False, True, False, False]


def test_the_oldest_of_too_many_deferred_events_is_dropped(simulate: Simulate) -> None:
    text = """
    statemachine M {
      initial A
      state A { defer Found; on Start -> B }
      state B { on Found / send Stop; on Stop -> End }
      final End
    }
    """
    events = [{"event": "Found", "data": {"level": n}} for n in range(102)]
    ran = simulate(text, events=[*events, {"event": "Start"}])

    assert [line["dropped"] for line in ran.trace if "dropped" in line] == [["Found"], ["Found"]]
    recalled = [line["data"]["level"] for line in ran.trace if line.get("recalled")]
    assert recalled == list(range(2, 102))
    assert "M: (more than 100 deferred)" in ran.err


SENDERS = """
statemachine Calls {
  var n : int32 = 1
  initial A
  state A {
    on Start / send Found(level = n) after 2 s, n = 5, send Found(level = n) after 500 ms * n
    on Stop  / cancel Found -> B
    after 1 s -> B
  }
  state B { on Stop / cancel Found; after 3 s -> End }
  final End
}
endless statemachine Hears {
  var seen : int32 = 0
  initial W
  state W { on Found / seen = event.level }
}
member Caller { behavior Calls }
member Hearer { behavior Hears }
swarm S { caller : Caller[1]; hearer : Hearer[1] }
"""


def test_a_delayed_event_is_sent_with_the_values_of_before(simulate: Simulate) -> None:
    ran = simulate(SENDERS, events=[{"event": "Start", "member": "caller[0]"}])
    told = simulate(SENDERS, "--trace", "text", events=[{"event": "Start", "member": "caller[0]"}])

    heard = [(each["t"], each["data"]["level"]) for each in ran.of("hearer[0]")[1:]]
    assert heard == [(2000, 1), (2500, 5)]
    sent = [each["envelope"]["sent"] for each in ran.of("hearer[0]")[1:]]
    assert sent == [2_000_000_000, 2_500_000_000]
    assert [each["event"] for each in ran.of("caller[0]")] == [
        *(None, "Start", "after.A.1", "send.Found", "send.Found", "after.B.1"),
    ]
    lines = told.out.splitlines()
    assert "caller[0]  Start; send Found after 2 s, Found after 2.5 s" in lines[2]
    assert any("caller[0]  send.Found; send Found" in line for line in lines)


def test_cancelled_events_are_not_sent(simulate: Simulate) -> None:
    events = [
        {"event": "Start", "member": "caller[0]"},
        {"event": "Stop", "member": "caller[0]", "after": 2200},
    ]
    ran = simulate(SENDERS, events=events)

    assert [each["data"]["level"] for each in ran.of("hearer[0]")[1:]] == [1]
    assert [each["withdrawn"] for each in ran.trace if "withdrawn" in each] == [["Found"]]


def test_delayed_events_end_with_the_machine(simulate: Simulate) -> None:
    text = SENDERS.replace("after 3 s -> End", "after 500 ms -> End")
    ran = simulate(text, events=[{"event": "Start", "member": "caller[0]"}])

    assert ran.of("hearer[0]")[1:] == []


def test_a_delay_without_time_sends_after_the_event(simulate: Simulate) -> None:
    text = """
    statemachine M {
      var d : duration = 0 s
      initial A
      state A { on Start / send Stop after d - 1 s, send Found -> B }
      state B { on Stop -> End }
      final End
    }
    """
    ran = simulate(text, events=[{"event": "Start"}])

    assert [(each["event"], each["sent"]) for each in ran.trace[1:]] == [
        ("Start", ["Found"]),
        ("send.Stop", ["Stop"]),
        ("Stop", []),
    ]


def test_a_trace_with_both_conforms_to_the_model(simulate: Simulate) -> None:
    text = SENDERS.replace("state W {", "state W { defer Stop;")
    events = [
        {"event": "Stop", "member": "hearer[0]"},
        {"event": "Start", "member": "caller[0]"},
        {"event": "Stop", "member": "caller[0]", "after": 2200},
    ]
    simulate(text, "--trace-file", "trace.jsonl", events=events)

    assert "scheduled" in Path("trace.jsonl").read_text(encoding="utf-8")
    assert run(["simulate", "model.swarm", "--replay", "trace.jsonl"]) == 0
