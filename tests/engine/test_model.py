"""State machines of models, run: what the language says of them happens."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from swarmdsl.execution.engine import Event, Instance
from swarmdsl.execution.simulate.machines.machine_data import first_data
from swarmdsl.execution.simulate.machines.table import table
from swarmdsl.ir import System

from .world import StillWorld, Trace

PRELUDE = """
package test
action Go { goal { speed : float64 } result { reached : bool, count : int32 } }
message Report { id : string, level : int32 }
function go : abstraction { action "cmd/go" : Go }
function land : abstraction { service "cmd/land" : std_srvs/Empty }
service std_srvs/Empty { }
event Start : std_msgs/Empty
event Stop : std_msgs/Empty
swarm event Found : Report
"""
SECOND = 1_000_000_000


class Run:
    """The machine `M` of a model that runs."""

    def __init__(self, system: System, **params: Any) -> None:
        machine = next(each for each in system.machines if each.name == "M")
        self.world = StillWorld()
        self.trace = Trace()
        self.instance = Instance(
            table(machine, system),
            self.world,
            data=first_data(machine, system, params),
            observer=self.trace,
        )
        self.instance.start()

    def __getitem__(self, variable: str) -> Any:
        return self.instance.data[variable]

    @property
    def states(self) -> list[str]:
        return self.instance.configuration.innermost

    def hear(self, name: str, **message: Any) -> list[str]:
        self.instance.receive(Event(name, message))
        return self.states

    def wait(self, seconds: float) -> list[str]:
        self.world.clock.advance(round(seconds * SECOND))
        return self.states

    def end(self, function: str, outcome: str, **result: Any) -> list[str]:
        self.world.runs[function].end(outcome, result)
        return self.states


Start = Callable[..., Run]


@pytest.fixture
def run(compiled: Callable[[str], System]) -> Start:
    return lambda text, **params: Run(compiled(PRELUDE + text), **params)


def test_guards_and_effects(run: Start) -> None:
    m = run("""
      statemachine M {
        var n : int32 = 0
        initial Wait
        state Wait {
          on Start [n < 2] / n = n + 1 -> Wait
          on Start -> End
        }
        final End
      }
    """)

    assert m.hear("Start") == m.hear("Start") == ["Wait"]
    m.hear("Start")
    assert (m["n"], m.instance.final) == (2, "End")


def test_outcomes_go_their_ways(run: Start) -> None:
    text = """
      statemachine M {
        initial Busy
        state Busy { do land; on succeeded -> Good; on aborted -> Bad; %s }
        state Good { on Stop -> End }
        state Bad { on Stop -> End }
        final End
      }
    """

    assert run(text % "").end("land", "succeeded") == ["Good"]
    assert run(text % "").end("land", "aborted") == ["Bad"]
    assert run(text % "").end("land", "preempted") == ["Bad"]
    assert run(text % "on preempted -> Good").end("land", "preempted") == ["Good"]


def test_goals_and_results(run: Start) -> None:
    m = run("""
      statemachine M {
        param speed : float64 = 1.5
        var fast : float64
        var last : Report
        initial Wait
        state Wait { on Start / fast = 2 * speed -> Busy }
        state Busy {
          do go(speed = fast) gives (count => last.level)
          on succeeded [last.level > 3] -> End
          on succeeded, aborted -> Wait
        }
        final End
      }
    """)
    m.hear("Start")
    assert m.world.runs["go"].goal == {"speed": 3.0}
    assert m.end("go", "succeeded", count=3, reached=True) == ["Wait"]
    m.hear("Start")
    m.end("go", "succeeded", count=4, reached=True)
    assert m.instance.final == "End"
    assert m["last"] == {"id": "", "level": 4}


def test_results_are_stored_though_no_transition_is_taken(run: Start) -> None:
    m = run("""
      endless statemachine M {
        var n : int32
        initial Outer
        state Outer {
          initial Busy
          state Busy {
            do go(speed = 1.0) gives (count => n)
            on succeeded [n > 100] -> Other
            on succeeded / n = n + 1
            on aborted -> Other
          }
          state Other { on Start [n > 0] -> Busy }
        }
      }
    """)
    m.end("go", "succeeded", count=7)

    assert m["n"] == 8


def test_a_result_without_its_field_is_told(run: Start) -> None:
    m = run(
        """
      endless statemachine M {
        var n : int32
        initial Busy
        state Busy {
          do go(speed = 1.0) gives (count => n)
          on succeeded, aborted -> Busy
          on Start [n > 0] -> Busy
        }
      }
    """
    )
    m.end("go", "succeeded")

    assert m.world.errors == ["there is no field `count` in {}"]


def test_parameters_of_the_instance(run: Start) -> None:
    text = """
      endless statemachine M {
        param limit : int32
        param more : int32 = 5
        var n : int32 = 0
        initial Wait
        state Wait { on Start / n = limit + more -> Wait }
      }
    """
    m = run(text, limit=3)
    m.hear("Start")
    assert m["n"] == 8
    with pytest.raises(ValueError, match="param `limit` of `M` has no value"):
        run(text)


def test_events_with_messages(run: Start) -> None:
    m = run("""
      endless statemachine M {
        var last : Report
        initial Wait
        state Wait { on Found [event.level > 3] / last = event, last.id = "x" -> Tell }
        state Tell { entry / send Found(level = last.level + 1); on Found -> Wait }
      }
    """)
    message = {"id": "a", "level": 4}

    assert m.hear("Found", id="a", level=3) == ["Wait"]
    m.instance.receive(Event("Found", message))
    assert m.states == ["Tell"]
    # What is stored is a copy, and fields that are not sent keep their defaults.
    assert (m["last"], message["id"]) == ({"id": "x", "level": 4}, "a")
    assert m.world.asked == ["send Found {'id': '', 'level': 5}"]


def test_monitors(run: Start) -> None:
    m = run("""
      endless statemachine M {
        var low : int32
        initial Wait
        state Wait { monitor "battery" : Report [event.level < 3] / low = event.level -> Low }
        state Low { on Start [low > 0] -> Wait }
      }
    """)
    (name,) = {
        event for edge in m.instance.machine.edges for each in edge for event in each.events
    } - {"Start"}
    m.hear(name, level=3)
    assert m.states == ["Wait"]
    m.hear(name, level=2)
    assert (m.states, m["low"]) == (["Low"], 2)


def test_delays(run: Start) -> None:
    m = run("""
      endless statemachine M {
        var patience : duration = 2 s
        initial A
        state A { after 2 * patience + 500 ms -> B; on Start / patience = patience / 3 -> A }
        state B { after patience -> A }
      }
    """)
    assert m.wait(4.4) == ["A"]
    assert m.wait(0.1) == ["B"]
    assert m.wait(2) == ["A"]
    m.hear("Start")
    assert m["patience"] == 666_666_667


def test_two_delays_of_a_state_and_one_that_two_share(run: Start) -> None:
    m = run("""
      endless statemachine M {
        var n : int32 = 0
        initial A
        state A {
          after 1 s [n > 5] -> B
          after 1 s / n = n + 1
          after 3 s [n > 0] -> B
        }
        state B { on Start -> A }
      }
    """)
    assert (m.wait(1), m["n"]) == (["A"], 1)
    assert m.wait(1.9) == ["A"]
    assert m.wait(0.1) == ["B"]


def test_done_tells_final_states_apart(run: Start) -> None:
    text = """
      statemachine M {
        initial Work
        state Work {
          initial A
          state A { on Start -> Found; on Stop -> Lost }
          final Found
          final Lost
          on done.Found -> Good
          on done -> Bad
        }
        final Good
        final Bad
      }
    """
    for event, final in (("Start", "Good"), ("Stop", "Bad")):
        m = run(text)
        m.hear(event)
        assert m.instance.final == final


def test_a_state_is_not_done_because_one_inside_is(run: Start) -> None:
    """Names of events are compared as a whole: `done.state.A.B` is not `done.state.A`."""
    m = run("""
      statemachine M {
        initial A
        state A {
          initial B
          state B {
            initial C
            state C { on Start -> D }
            final D
            on Stop -> E
          }
          final E
          on done -> F
        }
        final F
      }
    """)

    assert m.hear("Start") == ["A.B.D"]
    m.hear("Stop")
    assert m.instance.final == "F"


def test_regions(run: Start) -> None:
    m = run("""
      statemachine M {
        initial Both
        parallel state Both {
          region L { initial A; state A { on Start -> E } final E }
          region R { initial A; state A { on Stop -> E; on Found -> F } final E; final F }
          on L.done / send Found
          on R.done.F -> Out
          on done -> Good
        }
        final Good
        final Out
      }
    """)
    assert m.hear("Start") == ["Both.L.E", "Both.R.A"]
    assert len(m.world.asked) == 1
    m.hear("Stop")
    assert m.instance.final == "Good"


def test_an_internal_transition_of_a_parallel_state_leaves_the_other_regions_alone(
    run: Start,
) -> None:
    m = run("""
      endless statemachine M {
        var n : int32 = 0
        initial Both
        parallel state Both {
          region L { initial A; state A { on Start -> B } state B { on Found / n = n + 1 } }
          region R { initial C; state C { on Start -> D } state D { on Start -> C } }
          internal on Stop / n = n + 10 -> Both.A
          internal on Found [n > 0] -> Both.A
          on Found -> Both
        }
      }
    """)
    m.hear("Start")
    assert m.hear("Stop") == ["Both.L.A", "Both.R.D"]
    assert m["n"] == 10
    m.hear("Start")
    # The region decides first; what is left in the parallel state keeps the next one from it.
    assert m.hear("Found") == ["Both.L.B", "Both.R.C"]
    assert m["n"] == 11


def test_submachines_have_variables_and_parameters_of_their_own(run: Start) -> None:
    m = run("""
      statemachine Try {
        param most : int32
        var tries : int32 = 0
        initial Once
        state Once {
          do land
          on succeeded -> Ok
          on aborted [tries < most] / tries = tries + 1 -> Once
          on aborted -> Lost
        }
        final Ok
        final Lost
      }
      statemachine M {
        var most : int32 = 0
        initial First
        state First = Try(most = most) { on done.Ok -> Good; on done / most = most + 1 -> First }
        final Good
      }
    """)
    assert m.end("land", "aborted") == ["First.Once"]
    assert (m["most"], m["first_tries"]) == (1, 0)
    m.end("land", "aborted")
    assert m["first_tries"] == 1
    m.end("land", "succeeded")
    assert m.instance.final == "Good"


def test_choices_take_the_first_branch_that_holds(run: Start) -> None:
    text = """
      statemachine M {
        var n : int32 = 0
        initial Wait
        state Wait { on Found / n = event.level -> Fork }
        choice Fork { [n < 1] -> A; [n < 2] / n = 7 -> B; else -> C }
        final A
        final B
        final C
      }
    """
    for level, final in ((0, "A"), (1, "B"), (2, "C")):
        m = run(text)
        m.hear("Found", level=level)
        assert m.instance.final == final


def test_histories(run: Start) -> None:
    m = run("""
      endless statemachine M {
        initial Work
        state Work {
          initial A
          state A { on Start -> B }
          state B { initial C; state C { on Start -> D } state D { on Start -> C } }
          history Near -> A
          deep history Far -> A
          on Stop -> Out
        }
        state Out { on Start -> Work.Far; on Stop -> Work.Near }
      }
    """)
    m.hear("Start")
    assert m.hear("Start") == ["Work.B.D"]
    m.hear("Stop")
    assert m.hear("Start") == ["Work.B.D"]
    m.hear("Stop")
    assert m.hear("Stop") == ["Work.B.C"]


def test_a_guard_without_a_value_does_not_hold(run: Start) -> None:
    m = run("""
      endless statemachine M {
        var n : int32 = 0
        initial A
        state A { on Start [1 / n > 2] -> B; on Start / n = 0 -> C }
        state B { on Start -> A }
        state C { on Start -> A }
      }
    """)

    assert m.hear("Start") == ["C"]
    assert m.world.errors == ["division by zero"]


def test_a_whole_number_stays_in_its_type(run: Start) -> None:
    """A value out of range is not stored, and later effects are skipped."""
    m = run("""
      endless statemachine M {
        var n    : int32 = 50000
        var tiny : uint8 = 255
        var told : Report
        var all  : int64 = 0
        initial A
        state A {
          on Start / all = n * n, n = n * n, all = 7 -> B
          on Found / told.level = event.level, tiny = tiny + 1 -> B
        }
        state B {
          on Stop / send Found(id = "a", level = n * n) -> A
        }
      }
    """)

    assert m.hear("Start") == ["B"]
    assert (m["n"], m["all"]) == (50_000, 2_500_000_000)
    assert m.hear("Stop") == ["A"]
    assert m.hear("Found", id="a", level=3) == ["B"]
    assert (m["told"]["level"], m["tiny"]) == (3, 255)
    assert m.world.errors == [
        "2500000000 is out of range of int32",
        "2500000000 is out of range of int32",
        "256 is out of range of uint8",
    ]


def test_a_text_that_grows_in_a_circle_ends_somewhere(run: Start) -> None:
    m = run("""
      endless statemachine M {
        var text : string = "0123456789"
        initial A
        state A { on Start / text = text + text }
      }
    """)

    for _ in range(20):
        m.hear("Start")
    assert len(m["text"]) == 655_360
    assert set(m.world.errors) == {"a string of 1310720 characters is too long"}


def test_a_result_that_is_too_large_is_not_stored(run: Start) -> None:
    m = run("""
      statemachine M {
        var n : int32 = 1
        initial A
        state A { do go(speed = 1.0) gives (count => n); on succeeded, aborted -> B }
        final B
      }
    """)

    m.end("go", "succeeded", reached=True, count=2**31)
    assert m["n"] == 1
    assert m.world.errors == ["2147483648 is out of range of int32"]


def test_a_trace_leads_back_to_the_model(run: Start) -> None:
    m = run("statemachine M { initial A; state A { on Start -> B } final B }")
    state = m.instance.machine.states[1]

    assert state.origin.name == "A"  # type: ignore[attr-defined]
    assert state.transitions[0].origin.origin.text == "on Start -> B"  # type: ignore[attr-defined]
