"""Ways through generated machines that SMACH has nothing like: back, inside, and while it waits."""

from collections.abc import Callable
from typing import Any

import pytest

HEADER = """
package lab
message m/Note { id : string }
function work : abstraction { action "work" : m/Work }
function rest : abstraction { action "rest" : m/Rest }
event Go   : m/Note
event Stop : m/Note
event Back : m/Note
event Said : m/Note
"""
Run = Callable[..., Any]


def _said(robot: Any) -> list[str]:
    return [message.id for _, message in robot.world.sent]


@pytest.mark.parametrize(
    ("kind", "reached"), [("history", "Mission/Inner/One"), ("deep history", "Mission/Inner/Two")]
)
def test_history(kind: str, reached: str, robot: Run) -> None:
    work = robot(
        HEADER
        + f"""
        endless statemachine Work {{
          initial Pause
          state Mission {{
            initial Outer
            state Outer {{ on Go -> Inner }}
            state Inner {{
              initial One
              state One {{ on Go -> Two }}
              state Two
            }}
            {kind} Last -> Outer
            on Stop -> Pause
          }}
          state Pause {{ on Back -> Mission.Last }}
        }}"""
    )
    world = work.world
    work.start()
    work.wait_in("Pause")
    world.publish("back")
    work.wait_in("Mission/Outer")  # the default: it was never left
    for _ in range(2):
        world.publish("go")
    work.wait_in("Mission/Inner/Two")
    for _ in range(2):
        world.publish("stop")
        work.wait_in("Pause")
        world.publish("back")
        work.wait_in(reached)


def test_history_inside_of_the_state_itself(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        endless statemachine Work {
          initial Box
          state Box {
            exit / send Said(id = "out")
            initial A
            state A { on Go -> B }
            state B { on Go -> Last }
            history Last -> A
            on Stop -> Box.Last
          }
        }"""
    )
    world = work.world
    work.start()
    work.wait_in("Box/A")
    world.publish("go")
    work.wait_in("Box/B")
    world.publish("stop")
    work.wait_in("Box/B")
    assert _said(work) == ["out"]
    world.publish("go")
    work.wait_in("Box/B")  # what was active when Box was left last


def test_into_a_state_and_a_region(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        endless statemachine Work {
          initial Box.Deep.Inmost
          state Box {
            initial Shallow
            state Shallow { on Go -> Both.D }
            state Deep {
              initial Inner
              state Inner
              state Inmost { on Go -> Shallow }
            }
          }
          parallel state Both {
            region Left  { initial A; state A }
            region Right { initial C; state C; state D { on Go -> E }  state E }
            on Stop -> Box
          }
        }"""
    )
    world = work.world
    work.start()
    work.wait_in("Box/Deep/Inmost")
    world.publish("go")
    work.wait_in("Box/Shallow")
    world.publish("go")
    work.wait_in("Both/Left/A", "Both/Right/D")
    world.publish("go")
    work.wait_in("Both/Left/A", "Both/Right/E")
    world.publish("stop")
    work.wait_in("Box/Shallow")


def test_internal_transition_does_not_leave_its_state(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        endless statemachine Work {
          initial Box
          state Box {
            entry / send Said(id = "into Box")
            exit / send Said(id = "out of Box")
            initial A
            state A { exit / send Said(id = "out of A"); on Go -> B }
            state B { entry / send Said(id = "into B") }
            internal on Stop -> A
            on Back -> Box
          }
        }"""
    )
    world = work.world
    work.start()
    work.wait_in("Box/A")
    world.publish("stop")
    world.publish("go")
    work.wait_in("Box/B")
    world.publish("stop")
    work.wait_in("Box/A")
    world.publish("back")
    work.wait_in("Box/A")
    assert _said(work) == [
        *("into Box", "out of A", "out of A", "into B"),
        *("out of A", "out of Box", "into Box"),
    ]


def test_nothing_is_lost_while_a_server_is_cancelled(robot: Run) -> None:
    """Pending decisions are carried out; states already left start nothing."""
    work = robot(
        HEADER
        + """
        endless statemachine Work {
          initial A
          state A { do work; on succeeded, aborted -> A; on Stop -> B }
          state B { do rest; on succeeded, aborted -> A; on Go / send Said(id = event.id) -> C }
          state C { on Back -> D }
          state D { do rest; on succeeded, aborted -> A }
        }"""
    )
    world = work.world
    world.deaf.add("work")
    work.start()
    call = world.wait_for("work")
    world.publish("stop")
    world.wait_until(lambda: call.cancelled, "the goal is cancelled")
    world.publish("go", id="heard")
    world.publish("back")
    assert _said(work) == ["heard"]
    assert world.called() == ["work"]
    world.finish("work")
    work.wait_in("D")
    world.wait_for("rest")
    assert world.called() == ["work", "rest"]


def test_one_server_for_two_states_is_cancelled_before_it_is_called_again(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        endless statemachine Work {
          initial Both
          parallel state Both {
            region Left {
              initial A
              state A { do work; on succeeded, aborted -> A; on Go -> B }
              state B
            }
            region Right {
              initial C
              state C { on Go -> D }
              state D { do work; on succeeded, aborted -> C }
            }
          }
        }"""
    )
    world = work.world
    world.deaf.add("work")
    work.start()
    call = world.wait_for("work")
    world.publish("go")
    world.wait_until(lambda: call.cancelled, "the goal is cancelled")
    assert world.called() == ["work"]
    world.finish("work")
    world.wait_until(lambda: world.called() == ["work"] * 2, "the other state calls")
    work.wait_in("Both/Left/B", "Both/Right/D")


def test_a_machine_that_does_not_come_to_rest_fails(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        endless statemachine Work {
          var n : int32
          initial A
          state A { on Go / n = 1;  [n > 0] -> B }
          state B { [n > 0] -> A }
        }"""
    )
    work.start()
    work.wait_in("A")
    work.world.publish("go")
    with pytest.raises(Exception, match="does not come to rest: it loops through `A`, `B`"):
        work.ended()
