"""Behavior of generated machines, one construct of the model per test."""

import random
import sys
import time
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import pytest

HEADER = """
package lab

message m/Pose { x : float64, y : float64 }
message m/Note {
  header : std_msgs/Header, swarmio : swarmros/EventHeader
  id : string, level : int32, pose : m/Pose
}
message std_msgs/Header { stamp : time }
message swarmros/EventHeader { name : string, node : string }
action m/Move {
  goal { to : m/Pose, speed : float64 }
  result { id : string, at : m/Pose }
}
service m/Ask { request { times : int32 } response { answer : string } }

function move : abstraction { action "move" : m/Move }
function work : abstraction { action "work" : m/Work }
function rest : abstraction { action "rest" : m/Rest }
function ask  : abstraction { service "ask" : m/Ask }
function land : abstraction { service "land" : m/Land }
event Go   : m/Note
event Stop : m/Note
swarm event Found : m/Note
"""

Run = Callable[..., Any]


def test_activity_outcomes(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          initial A
          state A { do work; on succeeded -> B; on aborted -> Bad }
          state B { do land; on succeeded -> A; on aborted -> Good }
          final Good
          final Bad
        }"""
    )
    work.world.answers.update(work=["succeeded", "succeeded", "aborted"], land=["succeeded"])
    work.start()
    work.world.finish("land", "aborted")
    assert work.ended() == "Good"
    assert work.world.called() == ["work", "land", "work", "land"]


def test_initial_state_that_is_not_the_first(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          initial B
          state A { do work; on succeeded -> End; on aborted -> End }
          state B { do land; on succeeded -> A; on aborted -> A }
          final End
        }"""
    )
    work.world.answers.update(work=["succeeded"], land=["succeeded"])
    work.start()
    assert work.ended() == "End"
    assert work.world.called() == ["land", "work"]


@pytest.mark.parametrize(("success", "end"), [(True, "Good"), (False, "Bad")])
def test_a_service_that_says_whether_it_has_succeeded(success: bool, end: str, robot: Run) -> None:
    work = robot(
        HEADER
        + """
        service m/Ring { response { success : bool, message : string } }
        function ring : abstraction { service "ring" : m/Ring }
        statemachine Work {
          initial A
          state A { do ring; on succeeded -> Good; on aborted -> Bad }
          final Good
          final Bad
        }"""
    )
    work.start()
    work.world.finish("ring", success=success)
    assert work.ended() == end


@pytest.mark.parametrize(("success", "end"), [(True, "Good"), (False, "Bad")])
def test_a_model_that_looks_itself_whether_a_service_has_succeeded(
    success: bool, end: str, robot: Run
) -> None:
    work = robot(
        HEADER
        + """
        service m/Ring { response { success : bool } }
        function ring : abstraction { service "ring" : m/Ring }
        statemachine Work {
          var rung : bool = true
          initial A
          state A {
            do ring gives (success => rung)
            on succeeded [rung] -> Good
            on succeeded        -> Bad
            on aborted          -> Gone
          }
          final Good
          final Bad
          final Gone
        }"""
    )
    work.start()
    work.world.finish("ring", success=success)
    assert work.ended() == end


def test_guard_and_effect_on_an_outcome(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          param limit : int32 = 2
          var tries : int32 = 0
          initial A
          state A {
            do work
            on succeeded -> End
            on aborted [tries < limit] / tries = tries + 1 -> A
            on aborted -> Bad
          }
          final End
          final Bad
        }""",
        **{"~limit": 3},
    )
    work.world.answers["work"] = ["aborted"] * 4
    work.start()
    assert work.ended() == "Bad"
    assert work.world.called() == ["work"] * 4


def test_state_stays_where_no_guard_holds(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          var ready : bool
          initial A
          state A {
            initial B
            state B { do work; on succeeded -> Over; on aborted -> Over }
            final Over
            on done [ready] -> End
            on Go / ready = true -> A
          }
          final End
        }"""
    )
    work.start()
    work.world.finish("work")
    work.wait_in("A/Over")
    work.world.publish("go")
    work.world.finish("work")
    assert work.ended() == "End"


def test_data_of_an_event(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          var pose : m/Pose
          var last : m/Note
          initial Idle
          state Idle {
            on Go [event.level > 2 and event.id != "x"]
              / pose = event.pose, last.id = event.id, last.pose.x = 5.0 -> Drive
          }
          state Drive {
            do move(to = pose, speed = 2 * last.pose.x)
            on succeeded -> End
            on aborted -> End
          }
          final End
        }"""
    )
    world = work.world
    pose = world.modules["m.msg"].Pose(x=1.0, y=2.0)
    work.start()
    work.wait_in("Idle")
    world.publish("go", level=2, id="a")
    world.publish("go", level=3, id="x")
    world.publish("go", level=3, id="a", pose=pose)
    goal = world.wait_for("move").content
    assert (goal.to, goal.speed) == (pose, 10.0)
    world.publish("go", level=9)
    world.finish("move")
    assert work.ended() == "End"


def test_a_guard_that_fails_is_false(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          initial A
          state A { on Go [10 / event.level > 1] -> End; on Stop -> End }
          final End
        }"""
    )
    work.start()
    work.wait_in("A")
    work.world.publish("go", level=0)
    assert any(what == "error" for what, _ in work.world.log)
    work.wait_in("A")
    work.world.publish("stop")
    assert work.ended() == "End"


def test_one_event_with_several_targets(robot: Run) -> None:
    model = (
        HEADER
        + """
        statemachine Work {
          var count : int32
          initial A
          state A {
            on Go [event.level == 1] -> One
            on Go [event.level == 2] / count = 7 -> Two
            on Go [event.level > 5] -> One
            on Stop -> Other
          }
          state Two { do ask(times = count); on succeeded -> Other; on aborted -> Other }
          final One
          final Other
        }"""
    )
    work = robot(model)
    work.start()
    work.wait_in("A")
    work.world.publish("go", level=3)
    work.world.publish("go", level=2)
    assert work.world.wait_for("ask").content.times == 7
    work.world.finish("ask")
    assert work.ended() == "Other"


def test_event_cancels_the_activity(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          initial A
          state A { do work; on succeeded -> Bad; on aborted -> Bad; on Stop -> B }
          state B { do rest; on succeeded -> End; on aborted -> Bad }
          final End
          final Bad
        }"""
    )
    work.start()
    work.wait_in("A")
    work.world.wait_for("work")
    work.world.publish("stop")
    work.world.finish("rest")
    assert work.ended() == "End"
    assert work.world.log[1:3] == [("cancel", "work"), ("preempted", "work")]


def test_inner_transition_hides_the_outer(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          initial Outer
          state Outer {
            initial A
            state A { on Go [event.level > 0] -> B }
            state B { on Stop -> A }
            on Go -> End
          }
          final End
        }"""
    )
    work.start()
    work.wait_in("Outer/A")
    work.world.publish("go", level=1)
    work.wait_in("Outer/B")
    work.world.publish("stop")
    work.wait_in("Outer/A")
    work.world.publish("go", level=0)
    assert work.ended() == "End"


def test_only_the_transition_taken_has_its_effects(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          var a : int32
          var b : int32
          initial A
          state A {
            do work
            on succeeded -> Bad
            on aborted   -> Bad
            on Go   / a = 1 -> B
            on Stop / b = 1 -> B
          }
          state B { do ask(times = 10 * a + b); on succeeded -> End; on aborted -> End }
          final End
          final Bad
        }"""
    )
    world = work.world
    world.deaf.add("work")
    work.start()
    work.wait_in("A")
    call = world.wait_for("work")
    world.publish("stop")
    world.wait_until(lambda: call.cancelled, "the goal is cancelled")
    world.publish("go")
    world.finish("work", "succeeded")
    assert world.wait_for("ask").content.times == 1
    world.finish("ask")
    assert work.ended() == "End"


ABORT = (
    HEADER
    + """
    endless statemachine Work {
      var landings : int32
      initial Mission
      state Mission {
        initial A
        state A {
          do land
          on succeeded / landings = landings + 1, send Found(level = landings) -> B
          on aborted -> A
        }
        state B { do work; on succeeded -> A; on aborted -> A }
        on Stop -> Home
      }
      state Home {
        initial Back
        state Back { do rest; on succeeded -> Done; on aborted -> Back }
        final Done
        on done -> Mission
      }
    }"""
)


def test_abort_during_a_call_that_is_not_answered(robot: Run) -> None:
    work = robot(ABORT)
    world = work.world
    work.start()
    for _ in range(3):
        work.wait_in("Mission/A")
        world.wait_for("land")
        world.publish("stop")
        world.wait_for("rest")
        world.finish("land")
        world.finish("rest")
    # Neither the effect of the call's end nor the state after it was reached.
    assert world.called()[:6] == ["land", "rest"] * 3
    assert not world.sent
    # A preempt that nothing was left to take back does not end the next run.
    world.finish("land")
    world.finish("work")
    world.wait_for("land")
    assert [(topic, message.level) for topic, message in world.sent] == [("found", 1)]


def test_goal_that_ends_while_it_is_cancelled(robot: Run) -> None:
    work = robot(ABORT)
    world = work.world
    world.deaf.add("work")
    work.start()
    for _ in range(3):
        world.finish("land")
        call = world.wait_for("work")
        work.wait_in("Mission/B")
        world.publish("stop")
        world.wait_until(lambda call=call: call.cancelled, "the goal is cancelled")
        world.finish("work", "succeeded")
        world.finish("rest")
    world.finish("land")
    world.wait_for("work")


def test_abort_at_any_time_is_never_lost(robot: Run) -> None:
    work = robot(ABORT)
    world = work.world
    choice = random.Random(1)
    work.start()
    for _ in range(60):
        world.wait_for("land")
        work.wait_in("Mission/A")
        world.answers["land"] = ["succeeded"] * 2
        world.answers["work"] = ["succeeded"]
        world.finish("land")
        time.sleep(choice.random() * 0.004)
        world.publish("stop")
        world.answers["land"].clear()
        world.answers["work"].clear()
        world.wait_until(
            lambda: "rest" in world._active or "land" in world._active, "the abort is heard"
        )
        if "rest" not in world._active:
            world.finish("land")
        world.finish("rest")


PARALLEL = (
    HEADER
    + """
    statemachine Work {
      initial Both
      parallel state Both {
        region Left {
          initial A
          state A { do work; on succeeded -> Ok; on aborted -> Lost }
          final Ok
          final Lost
        }
        region Right {
          initial B
          state B { do rest; on succeeded -> Ok; on aborted -> Panic }
          final Ok
        }
        on Left.done.Lost -> Bad
        on done -> Good
        on Stop -> Stopped
      }
      state Panic { do land; on succeeded -> Bad; on aborted -> Bad }
      final Good
      final Bad
      final Stopped
    }"""
)


def test_parallel_state_joins(robot: Run) -> None:
    work = robot(PARALLEL)
    work.start()
    work.world.finish("work")
    work.wait_in("Both/Left/Ok", "Both/Right/B")
    work.world.finish("rest")
    assert work.ended() == "Good"


def test_region_that_is_done_ends_the_parallel_state(robot: Run) -> None:
    work = robot(PARALLEL)
    work.start()
    work.world.wait_for("rest")
    work.world.finish("work", "aborted")
    assert work.ended() == "Bad"
    assert ("cancel", "rest") in work.world.log


def test_transition_out_of_a_region(robot: Run) -> None:
    work = robot(PARALLEL)
    work.start()
    work.world.wait_for("work")
    work.world.finish("rest", "aborted")
    work.world.finish("land")
    assert work.ended() == "Bad"
    assert ("cancel", "work") in work.world.log


def test_event_ends_all_regions(robot: Run) -> None:
    work = robot(PARALLEL)
    work.start()
    work.world.wait_for("work")
    work.world.wait_for("rest")
    work.wait_in("Both/Left/A", "Both/Right/B")
    work.world.publish("stop")
    assert work.ended() == "Stopped"
    assert {("cancel", "work"), ("cancel", "rest")} <= set(work.world.log)


def test_variables_are_shared_between_regions(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          var level : int32
          initial Both
          parallel state Both {
            region Left {
              initial A
              state A { on Go / level = event.level -> D }
              state D { on Stop -> A }
            }
            region Right {
              initial B
              state B { on Found -> C }
              state C { do ask(times = level); on succeeded -> End; on aborted -> End }
              final End
            }
            on Right.done -> End
          }
          final End
        }"""
    )
    world = work.world
    work.start()
    work.wait_in("Both/Left/A", "Both/Right/B")
    world.publish("go", level=4)
    work.wait_in("Both/Left/D", "Both/Right/B")
    world.publish("bridge/events/found")
    assert world.wait_for("ask").content.times == 4
    world.finish("ask")
    assert work.ended() == "End"


def test_timeout(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          param limit : duration = 30 s
          var late : bool
          initial A
          state A {
            do work
            on succeeded -> Good
            on aborted -> Good
            after 10 ms [late] -> Good
            after (2 * limit) / late = true -> B
          }
          state B { do rest; on succeeded -> Good; on aborted -> Good
            after 50 ms [late] -> Late }
          final Good
          final Late
        }""",
        **{"~limit": 0.03},
    )
    before = time.monotonic()
    work.start()
    assert work.ended() == "Late"
    assert time.monotonic() - before >= 0.11
    assert work.world.called() == ["work", "rest"]


def test_choice(robot: Run) -> None:
    model = (
        HEADER
        + """
        statemachine Work {
          var n : int32
          initial Which
          choice Which {
            [n == 0] / n = n + 1 -> A
            [n < 3]  / n = 2 * n + 1 -> More
            else -> End
          }
          choice More {
            [n != 3] -> A
            else -> End
          }
          state A { do work; on succeeded -> Which; on aborted -> Which }
          final End
        }"""
    )
    work = robot(model)
    work.world.answers["work"] = ["succeeded"]
    work.start()
    assert work.ended() == "End"
    assert work.world.called() == ["work"]


def test_send(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          var pose : m/Pose
          initial A
          state A { on Go / pose.x = 3.0, send Found(id = event.id, pose = pose) -> End }
          final End
        }"""
    )
    work.start()
    work.wait_in("A")
    work.world.publish("go", id="here")
    assert work.ended() == "End"
    ((topic, message),) = work.world.sent
    assert (topic, message.id, message.pose.x) == ("found", "here", 3.0)
    assert message.header.stamp
    assert (message.swarmio.name, message.swarmio.node) == ("found", "robot_7")


@pytest.mark.parametrize(
    ("params", "id_", "level"),
    [
        ({"~member": "uav[1]", "~self/count": 5}, "uav[1]", 6),
        ({"~member": "uav[1]"}, "uav[1]", 3),
        ({}, "robot_7", 1),
    ],
)
def test_identity(robot: Run, params: dict[str, Any], id_: str, level: int) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          var mine : uint32 = self.index
          initial A
          state A {
            on Go [event.id == self.id and self.role != self.id] /
              send Found(id = self.id, level = mine + self.count) -> End
          }
          final End
        }""",
        **params,
    )
    work.start()
    work.wait_in("A")
    work.world.publish("go", id="other")
    work.world.publish("go", id=id_)
    assert work.ended() == "End"
    ((_, message),) = work.world.sent
    assert (message.id, message.level) == (id_, level)


ANSWERS = (
    HEADER
    + """
    message m/Word { id : string }
    swarm event Ask  : m/Word
    swarm event Tell : m/Word
    statemachine Work {
      var who : string = ""
      initial A
      state A {
        on Ask [event.sender != "" and event.sent > 2 s]
          / who = event.sender, send Tell(id = event.id) to event.sender, send Tell to base,
            send Tell to uav[self.index + 1], send Tell
        on Go / send Tell to who -> End
        on Tell [event.sender == who] -> A
      }
      final End
    }"""
)


def test_envelopes(robot: Run) -> None:
    work = robot(ANSWERS, **{"~member": "uav[1]"})
    work.start()
    work.wait_in("A")
    ask = {"sent": sys.modules["fake_ros"].Time(3.0), "message": SimpleNamespace(id="x")}
    for sender, to in (("uav[0]", "uav[2]"), ("uav[0]", "base"), ("uav[1]", ""), ("", "")):
        work.world.publish("bridge/events/ask", sender=sender, to=to, **ask)
    work.world.publish("bridge/events/ask", sender="base[0]", to="uav", **ask)
    work.world.publish("bridge/events/ask", sender="uav[0]", to="uav[1]", **ask)
    work.world.publish("go")
    assert work.ended() == "End"

    sent = [(m.sender, m.to, m.message.id) for _, m in work.world.sent]
    others = [("uav[1]", to, "") for to in ("base", "uav[2]", "")]
    assert sent == [
        *(("uav[1]", "base[0]", "x"), *others),
        *(("uav[1]", "uav[0]", "x"), *others),
        ("uav[1]", "uav[0]", ""),
    ]
    assert all(m.sent.to_sec() > 0 for _, m in work.world.sent)


@pytest.mark.parametrize("is_own", [True, False])
def test_a_robot_without_an_id_does_not_hear_its_own_event(robot: Run, is_own: bool) -> None:
    work = robot(
        """
        swarm event Ask : std_msgs/Empty
        event Go : std_msgs/Empty
        statemachine Work {
          initial A
          state A { on Go / send Ask -> B }
          state B { on Ask [event.sender == "" and event.sent > 0 s] -> Heard; on Go -> End }
          final Heard
          final End
        }
        """,
        namespace="/",
    )
    work.start()
    work.wait_in("A")
    work.world.publish("go")
    work.wait_in("B")
    ((_, sent),) = work.world.sent
    at = sent.sent if is_own else sys.modules["fake_ros"].Time(3.0)
    work.world.publish("bridge/events/ask", sender="", sent=at, to="", message=sent.message)
    work.world.publish("go")

    assert work.ended() == ("End" if is_own else "Heard")


def test_a_header_tells_the_sender_and_the_time(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          var at : duration = 0 s
          initial A
          state A {
            on Found [event.sender == "uav[3]" and event.sent > 2 s]
              / at = event.sent
            after 1 s [at == 3 s] -> End
          }
          final End
        }"""
    )
    assert "lab_events" not in work.world.modules
    work.start()
    work.wait_in("A")
    time = sys.modules["fake_ros"].Time
    for node, stamp in (("uav[2]", 4.0), ("uav[3]", 1.0), ("uav[3]", 3.0)):
        header, swarmio = SimpleNamespace(stamp=time(stamp)), SimpleNamespace(node=node)
        work.world.publish("bridge/events/found", header=header, swarmio=swarmio)
    assert work.ended() == "End"


def test_an_event_for_nobody_is_not_sent(robot: Run) -> None:
    work = robot(ANSWERS, **{"~member": "uav[1]"})
    work.start()
    work.wait_in("A")
    work.world.publish("go")
    assert work.ended() == "End"
    assert work.world.sent == []


def test_results(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          var id   : string = "none"
          var note : m/Note
          initial A
          state A {
            do move(to = note.pose, speed = 1.0) gives (id => id, at => note.pose)
            on succeeded -> B
            on aborted -> A
          }
          state B {
            do ask(times = 2) gives (answer => note.id)
            on succeeded -> C
            on aborted -> B
          }
          state C { on Go / send Found(id = id + note.id, pose = note.pose) -> End }
          final End
        }"""
    )
    world = work.world
    pose = world.modules["m.msg"].Pose(x=4.0)
    work.start()
    world.finish("move", "aborted", id="bad")
    world.finish("move", id="a", at=pose)
    world.finish("ask", answer="b")
    work.wait_in("C")
    world.publish("go")
    assert work.ended() == "End"
    ((_, message),) = world.sent
    assert (message.id, message.pose.x) == ("ab", 4.0)


def test_callbacks(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          var note : string
          initial A
          state A {
            do move(by make_goal) gives by take_result
            on succeeded -> B
            on aborted -> A
          }
          state B {
            do ask(by make_request) gives by take_response
            on succeeded -> C
            on aborted -> B
          }
          state C { on Go / send Found(id = note) -> End }
          final End
        }"""
    )
    # As generated they leave everything as it is.
    world = work.world
    work.start()
    assert world.wait_for("move").content.speed == 0.0
    world.finish("move")
    assert world.wait_for("ask").content.times == 0
    world.finish("ask")
    work.wait_in("C")
    world.publish("go")
    assert work.ended() == "End"


def _fails(*arguments: Any) -> None:
    raise ValueError


def _reads_what_is_not_there(userdata: Any, *arguments: Any) -> Any:
    return userdata.nowhere


def _returns_no_outcome(*arguments: Any) -> str:
    return "done"


@pytest.mark.parametrize("callback", [_fails, _reads_what_is_not_there, _returns_no_outcome])
def test_result_callback_that_fails(callback: Any, robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          initial A
          state A {
            do work gives by take_result
            on succeeded -> Bad
            on aborted -> A
            on preempted -> Bad
            on Stop -> End
          }
          final End
          final Bad
        }"""
    )

    sys.modules["lab_behavior.callbacks"].take_result = callback
    work.machine = sys.modules["lab_behavior.work"].build()
    world = work.world
    work.start()
    for _ in range(3):
        world.finish("work")
    world.wait_for("work")
    work.wait_in("A")
    world.publish("stop")
    assert work.ended() == "End"


def test_a_whole_number_stays_in_its_type(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          var n : int32 = 50000
          initial A
          state A { on Stop / n = n * n -> B }
          choice B { [n == 50000] -> Kept; else -> Grown }
          final Kept
          final Grown
        }"""
    )
    work.start()
    work.world.publish("stop")
    assert work.ended() == "Kept"


def test_goal_preempted_by_its_server(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          initial A
          state A {
            do work
            on succeeded -> Bad
            on aborted   -> Bad
            on preempted -> B
            on Stop      -> C
          }
          state B { on Go -> A }
          final C
          final Bad
        }"""
    )
    world = work.world
    work.start()
    world.finish("work", "preempted")
    work.wait_in("B")
    world.publish("go")
    world.wait_for("work")
    work.wait_in("A")
    world.publish("stop")
    assert work.ended() == "C"


def test_composite_whose_final_nobody_handles_stays(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          initial A
          state A {
            initial B
            state B { do work; on succeeded -> Over; on aborted -> Over }
            final Over
            on Stop -> End
          }
          final End
        }"""
    )
    work.start()
    work.world.finish("work")
    work.wait_in("A/Over")
    work.world.publish("stop")
    assert work.ended() == "End"


def test_done_with_guards(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          var n : int32
          initial A
          state A {
            initial B
            state B { do work; on succeeded -> Ok; on aborted -> Failed }
            final Ok
            final Failed
            on done.Failed [n < 2] / n = n + 1 -> A
            on done.Failed -> Bad
            on done -> Good
          }
          final Good
          final Bad
        }"""
    )
    work.world.answers["work"] = ["aborted", "aborted", "succeeded"]
    work.start()
    assert work.ended() == "Good"


def test_callback_that_the_file_of_the_user_lacks(robot: Run) -> None:
    robot(
        HEADER
        + """
        statemachine Work {
          initial A
          state A {
            do move(by make_goal) gives by take_result
            on succeeded, aborted, preempted -> End
          }
          final End
        }"""
    )
    del sys.modules["lab_behavior.callbacks"].take_result
    with pytest.raises(Exception, match="lacks") as found:
        sys.modules["lab_behavior.work"].build()
    assert type(found.value).__name__ == "StartError"
    assert str(found.value) == "callbacks.py lacks take_result(userdata, status, result)"


WRONG = {"speed": ["fast", True], "sides": [2.0, [1, "2"]], "times": [2.5, True], "wait": ["1 s"]}


@pytest.mark.parametrize(
    ("name", "value"), [(name, value) for name, values in WRONG.items() for value in values]
)
def test_param_of_another_type(name: str, value: Any, robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          param speed : float64
          param sides : float32[]
          param times : int32
          param wait  : duration = 1 s
          initial A
          state A {
            after wait [times > len(sides) and speed > 0.0] -> End
          }
          final End
        }""",
        **{"~speed": 2, "~sides": [1, 2.0], "~times": 3},
    )
    work.world.params["~" + name] = value
    with pytest.raises(Exception, match=f"param ~{name} is ") as found:
        sys.modules["lab_behavior.work"].build()
    assert type(found.value).__name__ == "StartError"


@pytest.mark.parametrize("model", [ABORT, PARALLEL])
def test_shutdown_from_every_depth(model: str, robot: Run) -> None:
    work = robot(model)
    work.world.answers["land"] = ["succeeded"]
    work.start()
    work.world.wait_for("work")
    assert work.preempt() == "preempted"
    assert ("cancel", "work") in work.world.log


def test_call_whose_answer_comes_too_late_runs_again(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        endless statemachine Work {
          initial Mission
          state Mission {
            initial Sub
            state Sub {
              initial Call
              state Call { do land; on succeeded -> Over; on aborted -> Over }
              final Over
              on done -> B
            }
            state B { do work; on succeeded -> Sub; on aborted -> Sub }
            on Stop -> Home
          }
          state Home { do rest; on succeeded -> Mission; on aborted -> Mission }
        }"""
    )
    world = work.world
    work.start()
    for _ in range(2):
        world.wait_for("land")
        work.wait_in("Mission/Sub/Call")
        world.publish("stop")
        world.wait_for("rest")
        world.finish("land")
        world.finish("rest")
    world.finish("land")
    world.wait_for("work")


def test_activity_that_outlasts_an_event_runs_again(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        endless statemachine Work {
          initial A
          state A { do work; on succeeded -> A; on aborted -> A; on Stop -> B }
          state B { do rest; on succeeded -> A; on aborted -> A }
        }"""
    )
    world = work.world
    world.deaf.add("work")
    work.start()
    for _ in range(3):
        call = world.wait_for("work")
        work.wait_in("A")
        world.publish("stop")
        world.wait_until(lambda call=call: call.cancelled, "the goal is cancelled")
        world.finish("work")
        world.finish("rest")
    world.wait_for("work")


def test_shutdown_during_a_call_that_is_not_answered(robot: Run) -> None:
    work = robot(
        HEADER
        + """
        statemachine Work {
          initial A
          state A { do land; on succeeded -> End; on aborted -> End }
          final End
        }"""
    )
    work.start()
    work.world.wait_for("land")
    assert work.preempt() == "preempted"
