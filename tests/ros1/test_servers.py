"""Nodes whose servers are missing, die, or do not answer."""

import operator
import signal
import subprocess
import time
from collections.abc import Callable
from typing import Any

import pytest

MODEL = """
package lab
action Move { goal { x : float64 } result { x : float64 } }
service Ask { request { times : int32 } response { answer : string } }
function move : abstraction { action "move" : Move }
function ask  : abstraction { service "ask" : Ask }
function land : abstraction { service "land" : std_srvs/Empty }
event Go   : std_msgs/Empty
event Stop : std_msgs/Empty
event Said : std_msgs/String
"""
FLIGHT = (
    MODEL
    + """
statemachine Flight {
  var x : float64 = 1.0
  initial Air
  state Air {
    initial Move
    state Move {
      do move(x = x) gives (x => x)
      on succeeded -> Ask
      on aborted   -> Lost
    }
    state Ask {
      do ask(times = 2)
      on succeeded -> Done
      on aborted   -> Lost
    }
    final Done
    final Lost
    on done.Done -> Home
    on done.Lost -> Down
    on Stop -> Down
  }
  state Down { do land; on succeeded -> Fallen; on aborted -> Down }
  final Home
  final Fallen
}"""
)
QUICK = {"timeouts__missing_server": 1, "timeouts__dead_server": 1, "timeouts__cancel": 1}
World = Callable[..., Any]


def test_what_is_there_is_used(world: World) -> None:
    flight = world(FLIGHT)
    flight.serve()
    node = flight.node("flight")
    assert flight.wait_for("move") == {"x": 1.0}
    flight.end("move", x=2.5)
    assert flight.wait_for("ask") == {"times": 2}
    flight.end("ask", answer="yes")
    assert node.ended() == 0
    assert flight.called() == ["move", "ask"]


@pytest.mark.parametrize("function", ["move", "ask"])
def test_call_that_fails(function: str, world: World) -> None:
    flight = world(FLIGHT)
    flight.serve(**{"move": ["succeeded"], "land": ["succeeded"], function: ["aborted"]})
    assert flight.node("flight").ended() == 0
    assert flight.called()[-2:] == [function, "land"]


@pytest.mark.parametrize("function", ["move", "ask"])
def test_server_that_is_missing(function: str, world: World) -> None:
    flight = world(FLIGHT)
    flight.serve(function, move=["succeeded"], land=["succeeded"])
    start = time.monotonic()
    node = flight.node("flight", **QUICK)
    assert node.ended() == 0
    assert time.monotonic() - start > 1
    assert "land" in flight.called()
    assert function in node.printed()


@pytest.mark.parametrize("function", ["move", "ask"])
def test_server_that_comes_late(function: str, world: World) -> None:
    flight = world(FLIGHT)
    flight.serve(function, move=["succeeded"], ask=["succeeded"])
    node = flight.node("flight")
    node.wait_in({"move": "Air/Move", "ask": "Air/Ask"}[function])
    flight.serve(*({"move", "ask", "land"} - {function}))
    flight.end(function)
    assert node.ended() == 0
    assert flight.called()[-1] in ("ask", function)


@pytest.mark.parametrize("function", ["move", "ask"])
def test_waiting_for_a_server_can_be_left(function: str, world: World) -> None:
    flight = world(FLIGHT)
    flight.serve(function, move=["succeeded"], land=["succeeded"])
    node = flight.node("flight")
    node.wait_in({"move": "Air/Move", "ask": "Air/Ask"}[function])
    flight.publish("Stop")
    assert node.ended() == 0
    assert flight.called()[-1] == "land"


@pytest.mark.parametrize("function", ["move", "ask"])
def test_server_that_dies(function: str, world: World) -> None:
    flight = world(FLIGHT)
    flight.serve("land", move=[] if function == "move" else ["succeeded"])
    ground = flight.beside()
    ground.serve("move", "ask", land=["succeeded"])
    node = flight.node("flight", **QUICK)
    flight.wait_for(function)
    flight.peers.process.kill()
    assert node.ended() == 0
    assert ground.called() == ["land"]


@pytest.mark.parametrize("function", ["move", "ask"])
def test_server_that_is_frozen(function: str, world: World) -> None:
    flight = world(FLIGHT)
    flight.serve("land", move=[] if function == "move" else ["succeeded"])
    ground = flight.beside()
    ground.serve("move", "ask", land=["succeeded"])
    node = flight.node("flight", **QUICK)
    flight.wait_for(function)
    flight.peers.process.send_signal(signal.SIGSTOP)
    assert node.ended() == 0
    assert ground.called() == ["land"]


def test_server_that_always_fails_is_called_again_after_pauses(world: World) -> None:
    flight = world(FLIGHT)
    flight.serve(move=["aborted"], land=["aborted", "aborted", "aborted", "aborted", "succeeded"])
    assert flight.node("flight").ended() == 0
    calls = flight.peers.times("call", "land")
    ends = flight.peers.times("aborted", "land")
    pauses = [later - earlier for earlier, later in zip(ends, calls[1:], strict=True)]
    assert len(pauses) == 4
    assert all(map(operator.ge, pauses, (0.1, 0.2, 0.4, 0.8))), pauses


def test_server_that_takes_long_is_waited_for(world: World) -> None:
    """Its node answers a probe while it works on a request."""
    flight = world(FLIGHT)
    flight.serve(move=["succeeded"])
    node = flight.node("flight", **QUICK)
    flight.wait_for("ask")
    with pytest.raises(subprocess.TimeoutExpired):
        node.process.wait(3 * QUICK["timeouts__dead_server"])
    flight.end("ask")
    assert node.ended() == 0
    assert flight.called() == ["move", "ask"]


@pytest.mark.parametrize("function", ["move", "ask"])
def test_server_that_does_not_let_go(function: str, world: World) -> None:
    flight = world(FLIGHT)
    flight.serve(
        deaf=["move"], move=[] if function == "move" else ["succeeded"], land=["succeeded"]
    )
    node = flight.node("flight", **QUICK)
    flight.wait_for(function)
    flight.publish("Stop")
    assert node.ended() == 0
    assert flight.called()[-1] == "land"


def test_server_that_is_started_anew_does_not_know_the_goal(world: World) -> None:
    flight = world(FLIGHT)
    flight.serve("land")
    ground = flight.beside()
    ground.serve("move", "ask", land=["succeeded"])
    node = flight.node("flight", **QUICK)
    flight.wait_for("move")
    flight.peers.process.kill()
    again = flight.beside()
    again.serve("ask", "land")
    assert node.ended() == 0
    assert ground.called() == ["land"]
    assert again.called() == []


def test_event_in_a_call(world: World) -> None:
    flight = world(FLIGHT)
    flight.serve(land=["succeeded"])
    node = flight.node("flight")
    flight.end("move", x=1.0)
    flight.wait_for("ask")
    node.wait_in("Air/Ask")
    flight.publish("Stop")
    assert node.ended() == 0
    assert flight.called() == ["move", "ask", "land"]
