"""For how long states are active."""

from __future__ import annotations

from pathlib import Path

from swarmdsl.cli import run

from .conftest import Simulate

MODEL = """
statemachine M {
  var told : duration[<=4]
  initial Out
  state Out { after 1 s -> Work }
  state Work {
    entry / append elapsed() to told
    initial Early
    state Early {
      after 2 s -> Late
      exit / append elapsed() to told
    }
    state Late {
      on Start [elapsed() >= 3 s] / append elapsed(Work) to told -> Early
      internal on Stop [elapsed() < 1 s] / told[0] = elapsed()
    }
    on Stop [elapsed() > 7 s and told[1] == 2 s and told[2] == 5 s] -> End
  }
  final End
}
"""
EVENTS = [
    {"event": "Start", "after": 5000},
    {"event": "Start", "after": 1000},
    {"event": "Stop", "after": 1000},
    {"event": "Stop", "after": 1500},
]


def test_it_counts_from_the_entry_of_each_state(simulate: Simulate) -> None:
    ran = simulate(MODEL, events=EVENTS)

    assert ran.steps() == [
        (0, None, ["Out"]),
        (1000, "after.Out.1", ["Work.Early"]),
        (3000, "after.Work.Early.1", ["Work.Late"]),
        (5000, "Start", ["Work.Late"]),
        (6000, "Start", ["Work.Early"]),
        (7000, "Stop", ["Work.Early"]),
        (8000, "after.Work.Early.1", ["Work.Late"]),
        (8500, "Stop", ["Work.Late"]),
    ]


def test_a_trace_is_replayed_with_its_times(simulate: Simulate) -> None:
    trace = Path("trace.jsonl")
    trace.write_text(simulate(MODEL, events=EVENTS[:2]).out)
    replay = ["simulate", "model.swarm", "--machine", "M", "--replay", str(trace)]

    assert run(replay) == 0
    # Half a second earlier the guard would not have held.
    trace.write_text(trace.read_text().replace('"t": 6000', '"t": 5500'))
    assert run(replay) == 1
