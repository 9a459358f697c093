"""The node of offboard control on real ROS 2, with stand-ins for autopilots around it."""

from __future__ import annotations

import json
import math
import signal
import subprocess
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from .conftest import HERE, emit, load_module
from .domains import free_domain
from .harness import PATIENCE, Ros

pytestmark = [pytest.mark.thorough, pytest.mark.timeout(600)]
SUCCEEDED, CANCELED, ABORTED = 4, 5, 6


@pytest.fixture(scope="module")
def built(ros_folder: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """Folders with the interfaces as they are built, and with the package of the model."""
    environment = load_module("environment")
    workspace = tmp_path_factory.mktemp("px4")
    (system,) = [environment.pipeline.check([HERE / "px4"]).system]
    files, report = emit(system, interfaces="px4_msgs")
    assert not list(report)
    for file in files:
        of_interfaces = file.path.startswith("px4_")
        path = workspace / ("src" if of_interfaces else "made") / file.path
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(file.text, encoding="utf-8")
    environment.build(ros_folder, workspace=workspace)
    return workspace / "install", workspace / "made" / "flight_behavior"


@pytest.fixture
def ros(ros_folder: Path, built: tuple[Path, Path], tmp_path: Path) -> Iterator[Ros]:
    install, package = built
    with free_domain() as domain:
        made = Ros(ros_folder, [package], domain, tmp_path)
        made.overlay(install)
        yield made
        made.close()


class Sky:
    """The process with the autopilots and the clients."""

    def __init__(self, ros: Ros, *vehicles: str) -> None:
        self.seen: list[dict[str, Any]] = []
        self.numbers = 0
        self.process = ros.start(
            HERE / "px4_stand_in.py", *vehicles, stdin=subprocess.PIPE, stdout=subprocess.PIPE
        )
        threading.Thread(target=self._read, daemon=True).start()
        self.wait(ready=True)

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self.seen.append(json.loads(line))

    def wait(self, since: int = 0, **wanted: Any) -> dict[str, Any]:
        """Wait until something is told that has these values."""
        end = time.monotonic() + PATIENCE
        while True:
            for each in self.seen[since:]:
                if wanted.items() <= each.items():
                    return each
            assert time.monotonic() < end, (wanted, self.seen[-20:])
            assert self.process.poll() is None
            time.sleep(0.02)

    def do(self, what: str, **values: Any) -> None:
        assert self.process.stdin is not None
        self.process.stdin.write(json.dumps({"do": what, **values}) + "\n")
        self.process.stdin.flush()

    def begin(self, action: str, name: str, system: int = 1, **data: Any) -> int:
        self.numbers += 1
        self.do("goal", number=self.numbers, system=system, action=action, name=name, data=data)
        return self.numbers

    def fly(self, action: str, name: str, system: int = 1, **data: Any) -> tuple[int, int, str]:
        """Wait for the end of a goal: its status, code and reason."""
        number = self.begin(action, name, system, **data)
        return self.end(number)

    def end(self, number: int) -> tuple[int, int, str]:
        end = self.wait(ended=number)
        return end["status"], end["code"], end["why"]

    def set(self, system: int, **values: Any) -> None:
        since = len(self.seen)
        self.do("set", system=system, **values)
        self.wait(since, set=system)

    def ask(self, system: int) -> dict[str, Any]:
        since = len(self.seen)
        self.do("ask", system=system)
        return self.wait(since, asked=system)


def start(ros: Ros, module: str, robot: str, **parameters: object) -> subprocess.Popen[str]:
    given = [e for k, v in parameters.items() for e in ("-p", f"{k.replace('__', '.')}:={v}")]
    return ros.start(
        *("-m", f"flight_behavior.{module}", "--ros-args", "-r", f"__ns:={robot}", *given)
    )


def test_one_vehicle(ros: Ros) -> None:
    sky = Sky(ros, "3,/px4_3,/pair/copter_0")
    node = start(ros, "px4_offboard", "/pair/copter_0", system=3, vehicle="'/px4_{system}'")
    sky.set(3, checks=False)
    status, code, why = sky.fly("TakeOff", "take_off", 3, altitude=3.0)
    assert (status, code) == (ABORTED, 4)
    assert why == "the command to arm is denied: pre-flight checks do not pass"
    assert sky.fly("GoTo", "go_to", 3, x=1, y=0, z=1)[:2] == (ABORTED, 11)
    sky.set(3, checks=True)
    assert sky.fly("TakeOff", "take_off", 3, altitude=3.0) == (SUCCEEDED, 0, "")

    # Places are east, north, up, as is the feedback.
    assert sky.fly("GoTo", "go_to", 3, x=4.0, y=9.0, z=5.0, yaw=0.0) == (SUCCEEDED, 0, "")
    told = sky.ask(3)
    assert told["place"] == pytest.approx([9, 4, -5], abs=0.3)
    assert told["yaw"] == pytest.approx(math.pi / 2)
    places = [each["place"] for each in sky.seen if "feedback" in each]
    assert any(3 < x < 5 and 2 < y < 10 and 2 < z < 6 for x, y, z in places)
    assert sky.fly("Hold", "hold", 3, time=1) == (SUCCEEDED, 0, "")

    # Cancelled in flight: it stays there.
    going = sky.begin("GoTo", "go_to", 3, x=300.0, y=9.0, z=5.0)
    sky.wait(feedback=going)
    sky.do("cancel", number=going, system=3)
    assert sky.end(going) == (CANCELED, 0, "")
    assert sky.fly("Hold", "hold", 3, time=1) == (SUCCEEDED, 0, "")
    there = sky.ask(3)
    assert there["place"][1] < 200
    # PX4 wants two setpoints a second; all of them came in time.
    assert max(there["gaps"]) < 0.5
    assert len(there["gaps"]) / sum(there["gaps"]) > 4

    # A node that hangs loses offboard control, and says so.
    going = sky.begin("GoTo", "go_to", 3, x=300.0, y=9.0, z=5.0)
    sky.wait(accepted=going)
    sky.wait(feedback=going)
    node.send_signal(signal.SIGSTOP)
    sky.wait(vehicle=3, failsafe=True)
    node.send_signal(signal.SIGCONT)
    status, code, why = sky.end(going)
    assert (status, code) == (ABORTED, 8)
    assert why.startswith("the vehicle has left offboard control in a failsafe")
    sky.set(3, failsafe=False)
    since = len(sky.seen)
    assert sky.fly("Land", "land", 3) == (SUCCEEDED, 0, "")
    assert sky.wait(since, vehicle=3, armed=False)
    before = sky.ask(3)["setpoints"]
    assert sky.fly("Land", "land", 3) == (SUCCEEDED, 0, "")  # it is on the ground
    assert sky.ask(3)["setpoints"] == before
    node.send_signal(signal.SIGINT)
    assert node.wait(PATIENCE) == 0


def test_two_vehicles_of_a_swarm(ros: Ros) -> None:
    """Each robot has the system of its number, and topics in its namespace."""
    robots = ["/pair/copter_0", "/pair/copter_1"]
    sky = Sky(ros, *(f"{n + 1},{robot},{robot}" for n, robot in enumerate(robots)))
    for number, robot in enumerate(robots):
        start(ros, "px4_offboard", robot, member=f"copter[{number}]")
        start(ros, "fly", robot, member=f"copter[{number}]", pause=1.0, self__count=2)
    fakes = ros.fakes()
    fakes.publisher("/pair/start", "std_msgs/msg/Empty")
    fakes.listeners("/pair/start", count=2)
    fakes.publish("/pair/start")
    for system, side in ((1, 4), (2, 8)):
        sky.wait(vehicle=system, armed=True)
        sky.wait(vehicle=system, mode=5)
        place = sky.ask(system)["place"]
        assert place[:2] == pytest.approx([side, 8], abs=3.0)
    for system in (1, 2):
        since = next(
            i for i, each in enumerate(sky.seen) if each.get("vehicle") == system and each["armed"]
        )
        sky.wait(since, vehicle=system, armed=False)
        assert sky.ask(system)["place"] == pytest.approx([0, 0, 0], abs=0.1)
        assert set(sky.ask(system)["commands"]) == {20, 176, 400}


def test_wrong_parameters(ros: Ros) -> None:
    for name, value, told in (
        ("rate", 1.0, "rate"),
        ("frame", "map", "frame"),
        ("tolerance", 0.0, "tolerance"),
        ("vehicle", "'/px4 1'", "vehicle"),
        ("member", "copter[255]", "set `system`"),
    ):
        node = ros.start(
            *("-m", "flight_behavior.px4_offboard", "--ros-args", "-p", f"{name}:={value}"),
            stderr=subprocess.PIPE,
        )
        _, log = node.communicate(timeout=PATIENCE)
        assert node.returncode == 1
        assert told in log.rpartition("[FATAL]")[2]
        assert "Traceback" not in log
