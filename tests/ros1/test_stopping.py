"""A node ends when it is told to, whatever it does, with goals cancelled: it waits for nobody."""

import signal
from collections.abc import Callable
from typing import Any

import pytest

MODEL = """
package lab
action Move { goal { x : float64 } }
service Ask { }
function move : abstraction { action "move" : Move }
function ask  : abstraction { service "ask" : Ask }
event Go   : std_msgs/Empty
event Stop : std_msgs/Empty
event Left : std_msgs/String
statemachine Work {
  initial Choose
  state Choose {
    exit / send Left(data = "Choose")
    on Go -> Moving
    on Stop -> Asking
    after 1 h -> End
  }
  state Moving { do move(x = 1.0); on succeeded, aborted -> End }
  state Asking { do ask; on succeeded, aborted -> End }
  final End
}
"""
World = Callable[..., Any]
SIGNALS = [signal.SIGINT, signal.SIGTERM]


@pytest.mark.parametrize("number", SIGNALS)
def test_in_a_state_that_waits(number: signal.Signals, world: World) -> None:
    work = world(MODEL)
    work.serve()
    node = work.node("work")
    node.wait_in("Choose")
    work.hears("Left")
    assert node.signal(number) == 0
    assert work.sent("Left") == {"data": "Choose"}


@pytest.mark.parametrize("number", SIGNALS)
def test_in_an_action(number: signal.Signals, world: World) -> None:
    work = world(MODEL)
    work.serve()
    node = work.node("work")
    node.wait_in("Choose")
    work.publish("Go")
    work.wait_for("move")
    assert node.signal(number) == 0
    work.cancelled("move")


def test_in_an_action_whose_server_does_not_answer(world: World) -> None:
    work = world(MODEL)
    work.serve(deaf=["move"])
    node = work.node("work")
    node.wait_in("Choose")
    work.publish("Go")
    work.wait_for("move")
    assert node.signal(signal.SIGTERM) == 0
    work.cancelled("move")


def test_in_a_service_that_does_not_answer(world: World) -> None:
    work = world(MODEL)
    work.serve()
    node = work.node("work")
    node.wait_in("Choose")
    work.publish("Stop")
    work.wait_for("ask")
    assert node.signal(signal.SIGTERM) == 0


@pytest.mark.parametrize("function", ["move", "ask"])
def test_while_a_server_is_missing(function: str, world: World) -> None:
    work = world(MODEL)
    work.serve(function)
    node = work.node("work")
    node.wait_in("Choose")
    work.publish({"move": "Go", "ask": "Stop"}[function])
    node.wait_in({"move": "Moving", "ask": "Asking"}[function])
    assert node.signal(signal.SIGTERM) == 0


@pytest.mark.parametrize("call", ["registerPublisher", "registerService", "getParam"])
def test_while_it_begins(call: str, world: World) -> None:
    work = world(MODEL)
    script = work.package / "scripts" / "work"
    environment = work.graph.environment(work.modules, ROS_NAMESPACE=work.namespace)
    assert work.graph.interrupt([work.graph.python, str(script)], call, environment) == 0


def test_although_the_master_does_not_answer(world: World) -> None:
    work = world(MODEL)
    (source,) = work.package.rglob("node.py")
    text = source.read_text(encoding="utf-8")
    source.write_text(text.replace("\nLATE = 20", "\nLATE = 2"), encoding="utf-8")
    script = work.package / "scripts" / "work"
    environment = work.graph.environment(work.modules, ROS_NAMESPACE=work.namespace)
    command = [work.graph.python, str(script)]
    assert work.graph.interrupt(command, "getParam", environment, answers=False) == 1
