"""Servers that are killed during a call and start again, or beside which another one starts."""

from __future__ import annotations

import re
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

HERE = Path(__file__).resolve().parent
WORK = ("/lab/work", "lab_msgs/action/Work")
RESULT = ("/lab/work/_action/get_result", "lab_msgs/action._work/Work_GetResult")
ASK = ("/lab/ask", "lab_msgs/srv/Ask")
WORKING = "do.Busy.Hands.Working"
ASKING = "do.Busy.Head.Thinking.Asking"
CHANGED = "work on work has other servers, and is still worked on"


class Lab:
    """A node of the lab, and whoever makes it call its servers."""

    def __init__(self, ros: Any, module: str = "lab") -> None:
        self.ros = ros
        self.module = module
        self.processes: list[Any] = []
        self.fakes = self._process()
        self.fakes.publisher("/go", "lab_msgs/msg/Order")

    def begin(self, **parameters: Any) -> Any:
        """Start the node, and let it call its servers."""
        self.node = self.ros.node(f"lab_behavior.{self.module}", "/lab", **parameters)
        self.node.wait_in("Idle")
        for number, each in enumerate(self.processes):
            # Their servers are known to the node as soon as it hears them.
            each.listeners("/told")
            each.publish("/told")
            self.node.wait_for("Told", number + 1)
        self.fakes.listeners("/go")
        self.fakes.publish("/go", name="box", speed=1.0)
        return self.node

    def server(self, *what: Any) -> Any:
        """A server in a process of its own: an action or a service, and how its calls end."""
        made = self._process()
        serve = made.action if what[0] is WORK else made.service
        serve(*what[0], *what[1:])
        return made

    def _process(self) -> Any:
        made = self.ros.fakes()
        made.publisher("/told", "lab_msgs/msg/Report")
        self.processes.append(made)
        return made


@pytest.fixture
def default_lease(ros: Any, tmp_path: Path) -> None:
    """A process that was killed stays in the graph as long as Fast DDS has it by default."""
    profile = tmp_path / "default_lease.xml"
    text = (HERE / "loopback.xml").read_text(encoding="utf-8")
    profile.write_text(re.sub(r"<builtin>.*</builtin>", "", text, flags=re.DOTALL))
    for name in ("FASTRTPS", "FASTDDS"):
        ros.environment[f"{name}_DEFAULT_PROFILES_FILE"] = str(profile)


@pytest.mark.usefixtures("default_lease")
@pytest.mark.parametrize("target", ["ros2", "yasmin"])
def test_an_action_server_that_starts_again(
    ros: Any, variant: Callable[..., Path], target: str
) -> None:
    """Its new process does not know the goal, which ends before the middleware drops the old."""
    if target == "yasmin":
        ros.prefer(HERE.parent / "yasmin" / "stand_in")
        ros.prefer(variant("tests/ros2/models", target=target))
    lab = Lab(ros, "lab" if target == "ros2" else "lab_fsm")
    server = lab.server(WORK, {"outcome": "never", "feedback": [{"share": 0.5}]})
    node = lab.begin(timeouts__server=5.0, tries=0)
    node.wait_for("WorkFeedback")  # after it has accepted the goal
    server.process.kill()
    lab.server(WORK, "never")

    node.wait_for(f"{WORKING}.aborted")
    assert "work on work has another server, which does not know of it" in node.log


def test_a_service_server_that_starts_again(ros: Any) -> None:
    """Its call ends when the middleware has dropped the process that was asked."""
    lab = Lab(ros)
    lab.fakes.action(*WORK, "never")
    server = lab.server(ASK, "never")
    node = lab.begin(timeouts__server=10.0)
    server.wait("request", ASK[0])
    server.process.kill()
    lab.server(ASK, "never")

    node.wait_for(f"{ASKING}.aborted")
    assert "ask on ask has another server, which does not know of it" in node.log


def test_an_action_server_beside_which_another_one_starts(ros: Any) -> None:
    lab = Lab(ros)
    server = lab.server(WORK, "never")
    node = lab.begin(timeouts__server=60.0, tries=0)
    server.wait("goal", WORK[0])
    lab.server(WORK, "never")
    wait_in_log(node, CHANGED)
    server.do("finish", name=WORK[0], outcome="succeeded", number=1)

    node.wait_for(f"{WORKING}.succeeded")


def test_one_of_two_action_servers_that_goes(ros: Any) -> None:
    """Both have the goal, and the other one goes on with it."""
    lab = Lab(ros)
    servers = [lab.server(WORK, "never") for _ in range(2)]
    node = lab.begin(timeouts__server=60.0, tries=0)
    for each in servers:
        each.wait("goal", WORK[0])
    servers[0].do("gone", name=WORK[0])
    wait_in_log(node, CHANGED)
    servers[1].do("finish", name=WORK[0], outcome="succeeded", number=1)

    node.wait_for(f"{WORKING}.succeeded")


def test_a_server_that_answers_without_knowing_the_goal(ros: Any) -> None:
    """Another one works on it, and is asked for the result again."""
    lab = Lab(ros)
    stranger = lab.server(RESULT, "succeeded", "never")  # its status is UNKNOWN
    server = lab.server(WORK, "never")
    node = lab.begin(timeouts__server=60.0, tries=0)
    server.wait("goal", WORK[0])
    stranger.wait("request", RESULT[0], 2)
    server.do("finish", name=WORK[0], outcome="succeeded", number=1)

    node.wait_for(f"{WORKING}.succeeded")


def test_one_of_two_service_servers_that_goes(ros: Any) -> None:
    """Both have the request, and the other one responds long after the first has gone."""
    lab = Lab(ros)
    lab.fakes.action(*WORK, "never")
    first = lab.server(ASK, "never")
    second = lab.server(ASK, {"outcome": "succeeded", "after": 3.0})
    node = lab.begin(timeouts__server=0.5)
    for each in (first, second):
        each.wait("request", ASK[0])
    first.do("gone", name=ASK[0])

    node.wait_for(f"{ASKING}.succeeded")


def wait_in_log(node: Any, text: str) -> None:
    end = time.monotonic() + 60
    while text not in node.log:
        assert time.monotonic() < end, node.log
        time.sleep(0.02)
