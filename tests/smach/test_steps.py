"""Generated entry, exit, triggerless and targetless behavior."""

from collections.abc import Callable
from typing import Any

import pytest

HEADER = """
package lab

message m/Note { id : string, level : int32 }
service m/Ask { request { times : int32 } response { answer : string } }
action m/Count { result { seen : int32, again : bool } }

function work  : abstraction { action "work" : m/Work }
function rest  : abstraction { action "rest" : m/Rest }
function count : abstraction { action "count" : m/Count }
function ask   : abstraction { service "ask" : m/Ask }
event Go   : m/Note
event Stop : m/Note
event Said : m/Note
"""

Run = Callable[..., Any]


def _said(robot: Any) -> list[str]:
    return [message.id for _, message in robot.world.sent]


def test_exit_effects_and_entry_in_this_order(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          initial Outer
          state Outer {
            entry / send Said(id = "into Outer")
            exit / send Said(id = "out of Outer")
            initial A
            state A {
              entry / send Said(id = "into A"), send Said(id = "now in A")
              do work
              exit / send Said(id = "out of A")
              on succeeded / send Said(id = "A to B") -> B
              on aborted -> B
            }
            state B {
              exit / send Said(id = "out of B")
              on Go / send Said(id = "B to C: " + event.id) -> C
            }
          }
          state C {
            entry / send Said(id = "into C")
            exit / send Said(id = "out of C")
            after 1 ms / send Said(id = "C to End") -> End
          }
          final End
        }"""
    )
    work.start()
    work.world.finish("work")
    work.wait_in("Outer/B")
    work.world.publish("go", id="x")
    assert work.ended() == "End"
    assert _said(work) == [
        *("into Outer", "into A", "now in A", "out of A", "A to B"),
        *("out of B", "out of Outer", "B to C: x", "into C", "out of C", "C to End"),
    ]


def test_exit_of_all_that_an_outer_transition_leaves(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          initial Both
          parallel state Both {
            entry / send Said(id = "into Both")
            exit / send Said(id = "out of Both")
            region Left {
              initial A
              state A { entry / send Said(id = "into A"); exit / send Said(id = "out of A")
                        do work; on succeeded -> A; on aborted -> A }
            }
            on Stop / send Said(id = "effect") -> End
          }
          final End
        }"""
    )
    work.start()
    work.world.wait_for("work")
    work.wait_in("Both/Left/A")
    work.world.publish("stop")
    assert work.ended() == "End"
    assert _said(work) == ["into Both", "into A", "out of A", "out of Both", "effect"]
    assert ("cancel", "work") in work.world.log


def test_exit_when_the_node_shuts_down(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          initial A
          state A { exit / send Said(id = "out"); on Go -> End }
          final End
        }"""
    )
    work.start()
    work.wait_in("A")
    assert work.preempt() == "preempted"
    assert _said(work) == ["out"]


def test_guard_is_for_before_the_exit(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          var n : int32 = 1
          initial A
          state A {
            do work
            exit / n = 2
            on succeeded [n == 1] / n = n * 10 -> B
            on succeeded -> Bad
            on aborted -> Bad
          }
          state B { do ask(times = n); on succeeded -> Good; on aborted -> Bad }
          final Good
          final Bad
        }"""
    )
    work.start()
    work.world.finish("work")
    assert work.world.wait_for("ask").content.times == 20
    work.world.finish("ask")
    assert work.ended() == "Good"


def test_effects_on_a_state_that_waits_for_nothing(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        endless statemachine Work {
          initial A
          state A { entry / send Said(id = "in") }
        }"""
    )
    work.start()
    work.wait_in("A")
    assert _said(work) == ["in"]


def test_variables_of_a_submachine_start_anew(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Sub {
          var tries : int32 = 1
          initial A
          state A {
            do ask(times = tries)
            on succeeded -> Over
            on aborted / tries = tries + 1 -> A
          }
          final Over
        }
        endless statemachine Work {
          initial S
          state S = Sub { on done -> Again }
          state Again { after 1 ms -> S }
        }"""
    )
    world = work.world
    work.start()
    for times in (1, 2):
        assert world.wait_for("ask").content.times == times
        world.finish("ask", "aborted")
    world.finish("ask")
    world.wait_until(lambda: world.called() == ["ask"] * 4, "the machine is entered again")
    assert world.wait_for("ask").content.times == 1


CONDITION = """
statemachine Work {
  var n : int32
  initial Both
  parallel state Both {
    region Left {
      initial A
      state A {
        [n > 5] / n = n + 100 -> B
        on Stop -> Lost
      }
      state B { do ask(times = n); on succeeded -> Over; on aborted -> Over }
      final Over
      final Lost
    }
    region Right {
      initial C
      state C { on Go / n = 10, n = n + event.level -> D }
      state D { on Go / n = event.level -> C }
    }
    on Left.done.Over -> Good
    on Left.done -> Bad
  }
  final Good
  final Bad
}
"""


def test_condition_that_another_region_makes_true(robot: Run) -> None:
    work = robot(HEADER + CONDITION)
    work.start()
    work.wait_in("Both/Left/A", "Both/Right/C")
    work.world.publish("go", level=-6)  # 10 for a moment only: steps are seen as a whole
    work.wait_in("Both/Left/A", "Both/Right/D")
    work.world.publish("go", level=7)
    assert work.world.wait_for("ask").content.times == 107
    work.world.finish("ask")
    assert work.ended() == "Good"


def test_condition_is_preempted(robot: Run) -> None:
    work = robot(HEADER + CONDITION)
    work.start()
    work.wait_in("Both/Left/A", "Both/Right/C")
    work.world.publish("stop")
    assert work.ended() == "Bad"


def test_condition_that_holds_at_once(robot: Run) -> None:
    """The activity of the state does not even start."""
    work = robot(
        HEADER
        + """
        statemachine Work {
          var n : int32
          initial A
          state A {
            entry / n = n + 1
            do work
            [n == 2] -> End
            on succeeded -> A
            on aborted -> Bad
          }
          final End
          final Bad
        }"""
    )
    work.start()
    work.world.finish("work")
    assert work.ended() == "End"
    assert work.world.called() == ["work"]


def test_condition_on_a_result(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          var seen : int32
          var again : bool
          initial Both
          parallel state Both {
            region Left {
              initial A
              state A { [seen == 3 and not again] -> Bad;  [seen == 3] -> Good }
            }
            region Right {
              initial B
              state B {
                do count gives (seen => seen, again => again)
                on succeeded -> C
                on aborted -> B
              }
              state C
            }
          }
          final Good
          final Bad
        }"""
    )
    work.start()
    work.world.finish("count", seen=3, again=True)
    assert work.ended() == "Good"


def test_a_condition_that_fails_is_false(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          var n : int32
          initial A
          state A { [10 / n > 1] -> End; on Go / n = event.level }
          final End
        }"""
    )
    work.start()
    work.wait_in("A")
    assert any(what == "error" for what, _ in work.world.log)
    work.world.publish("go", level=2)
    assert work.ended() == "End"


def test_state_that_is_done_at_once(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          var n : int32
          initial A
          state A { on Go -> Bad; on done [n > 0] -> Bad; on done / n = 4 -> B }
          state B { entry / n = n + 1; on done -> C; exit / n = n + 10 }
          state C { do ask(times = n); on succeeded -> End; on aborted -> End }
          final End
          final Bad
        }"""
    )
    work.start()
    assert work.world.wait_for("ask").content.times == 15
    work.world.finish("ask")
    assert work.ended() == "End"


def test_transition_without_target_stays(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          var n : int32
          initial Outer
          state Outer {
            initial A
            state A {
              exit / send Said(id = "out")
              do work
              on succeeded -> B
              on aborted -> B
              on Go [event.level > 0] / n = n + event.level, send Said(id = event.id)
            }
            state B { do ask(times = n); on succeeded -> Over; on aborted -> Over }
            final Over
            on done -> End
            on Go -> Bad
          }
          final End
          final Bad
        }"""
    )
    world = work.world
    work.start()
    world.wait_for("work")
    work.wait_in("Outer/A")
    for name in ("x", "y"):
        world.publish("go", level=3, id=name)
    assert _said(work) == ["x", "y"]
    world.finish("work")
    assert world.wait_for("ask").content.times == 6
    assert _said(work) == ["x", "y", "out"]
    assert world.called() == ["work", "ask"]
    world.finish("ask")
    assert work.ended() == "End"


def test_time_and_outcome_without_target(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          var n : int32
          initial A
          state A {
            do work
            on succeeded / n = n + 1
            on aborted -> Bad
            after 1 ms / n = n + 10
            [n == 11] -> End
          }
          final End
          final Bad
        }"""
    )
    work.start()
    work.world.finish("work")
    assert work.ended() == "End"
    assert work.world.called() == ["work"]


TWO = """
endless statemachine Work {{
  initial Both
  parallel state Both {{
    region Left  {{ initial A; state A {{ on Go -> {left} }}  state A2 }}
    region Right {{ initial B; state B {{ {nested} }}  state B2 }}
  }}
  state First {{ on Stop -> Both }}
  state Second {{ on Stop -> Both }}
}}
"""
DEEP = "initial C; state C { on Go -> Second }"


RIGHT = {"on Go -> Second": "Both/Right/B", DEEP: "Both/Right/B/C"}


@pytest.mark.parametrize("nested", RIGHT)
def test_two_regions_that_leave_on_one_event(nested: str, robot: Run) -> None:
    """The first region in the model wins, however deep the other one waits."""
    work = robot(HEADER + TWO.format(left="First", nested=nested))
    work.start()
    for _ in range(30):
        work.wait_in("Both/Left/A", RIGHT[nested])
        work.world.publish("go")
        work.wait_in("First")
        work.world.publish("stop")


def test_region_that_stays_keeps_a_later_one_from_leaving(robot: Run) -> None:
    work = robot(HEADER + TWO.format(left="A2", nested="on Go -> Second"))
    work.start()
    work.wait_in("Both/Left/A", "Both/Right/B")
    work.world.publish("go")
    work.wait_in("Both/Left/A2", "Both/Right/B")
    work.world.publish("go")
    work.wait_in("Second")


def test_two_regions_that_stay_both_take_an_event(robot: Run) -> None:
    work = robot(HEADER + TWO.format(left="A2", nested="on Go -> B2"))
    work.start()
    work.wait_in("Both/Left/A", "Both/Right/B")
    work.world.publish("go")
    work.wait_in("Both/Left/A2", "Both/Right/B2")


def test_only_one_of_two_ways_out_has_its_effects(robot: Run) -> None:
    """Effects of a way out are for when all has ended, so none is done for the way not taken."""
    work = robot(
        HEADER
        + """
        statemachine Work {
          initial Outer
          state Outer {
            initial A
            state A { on Go / send Said(id = "inner") -> Inner }
            on Stop / send Said(id = "outer") -> Wait
          }
          state Inner { on Stop -> Wait }
          state Wait { on Go -> End }
          final End
        }"""
    )
    work.start()
    work.wait_in("Outer/A")
    work.world.publish("go")
    work.wait_in("Inner")
    work.world.publish("stop")
    work.wait_in("Wait")
    work.world.publish("go")
    assert work.ended() == "End"
    assert _said(work) == ["inner"]


def test_regions_keep_their_messages_apart(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        endless statemachine Work {
          initial Both
          parallel state Both {
            region Left {
              initial A
              state A { on Go [event.level == 1] / send Said(id = event.id) -> A2 }
              state A2 { on Stop / send Said(id = event.id) -> A }
            }
            region Right {
              initial B
              state B { on Go [event.level == 2] / send Said(id = event.id) -> B }
            }
          }
        }"""
    )
    work.start()
    for _ in range(5):
        work.wait_in("Both/Left/A", "Both/Right/B")
        work.world.publish("go", level=1, id="left")
        work.world.publish("go", level=2, id="right")
        work.wait_in("Both/Left/A2", "Both/Right/B")
        work.world.publish("stop", id="stop")
    work.wait_in("Both/Left/A", "Both/Right/B")
    assert sorted(_said(work)) == ["left"] * 5 + ["right"] * 5 + ["stop"] * 5


def test_deferred_events_are_handled_in_the_next_state(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          var names : string[<=3]
          initial Busy
          state Busy {
            defer Go
            on Stop -> Idle
          }
          state Idle {
            var left : int32 = 2
            on Go [left > 1] / append event.id to names, left = left - 1
            on Go / append event.id to names, send Said(id = names[0] + names[1]) -> End
          }
          final End
        }"""
    )
    work.start()
    work.wait_in("Busy")
    work.world.publish("go", id="a")
    work.world.publish("go", id="b")
    work.wait_in("Busy")
    assert _said(work) == []
    work.world.publish("stop")
    assert work.ended() == "End"
    assert _said(work) == ["ab"]


def test_a_delayed_send_arrives_unless_it_is_cancelled(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          initial A
          state A {
            entry / send Said(id = "never") after 1 ms, cancel Said
            exit  / send Said(id = "left") after 1 ms
            on Go / send Said(id = event.id) after 2 ms -> B
          }
          state B { on Stop -> End }
          final End
        }"""
    )
    work.start()
    work.wait_in("A")
    work.world.publish("go", id="later")
    work.world.wait_until(lambda: len(_said(work)) > 1, "both are sent")
    # What was due first was cancelled, or it would be before both.
    assert _said(work) == ["left", "later"]
    work.world.publish("stop")
    assert work.ended() == "End"
