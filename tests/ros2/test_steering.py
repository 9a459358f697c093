"""`swarmc fleet` in a browser, and nodes that come, are killed, and hear what a person sends."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from ..player.conftest import browser as browser
from .conftest import load_module, write_package
from .domains import free_domain
from .watching import FleetPage, address_of, watched

PLACED = """(async () => {
  const place = () => player.moment.members[player.recording.number("drone[1]")].place;
  while (place()?.[0] !== 4.5) await new Promise(requestAnimationFrame);
})()"""
MODEL = """
package fleet_lab

/// Land at once.
swarm operator event Abort : std_msgs/Empty { reliable }
swarm operator event Near  : std_msgs/Float64 { reliable }

endless statemachine Flying {
  initial Air
  state Air {
    on Near [event.data > 2.0] -> Close
    on Abort -> Landed
  }
  state Close { on Abort -> Landed }
  state Landed { on Near -> Air }
}

member Drone { behavior Flying }

swarm Crew {
  drone : Drone[2]
  heartbeat 200 ms lost after 1 s
}
"""


@pytest.fixture
def lab(ros_folder: Path, tmp_path: Path) -> Iterator[Any]:
    """Processes of ROS, with the package of the model."""
    folder = tmp_path / "model"
    folder.mkdir()
    (folder / "crew.swarm").write_text(MODEL, encoding="utf-8")
    package = write_package(folder, tmp_path / "ws")
    with free_domain() as domain:
        ros = load_module("harness").Ros(ros_folder, [package], domain, tmp_path)
        yield ros
        ros.close()


def drone(ros: Any, number: int) -> Any:
    given = {"heartbeat__period": 0.2, "heartbeat__timeout": 1.0}
    name = f"drone[{number}]"
    return ros.node("fleet_lab_behavior.flying", f"/crew/drone_{number}", member=name, **given)


def test_robots_are_seen_and_steered(lab: Any, browser: Any) -> None:
    fakes = lab.fakes()
    fakes.publisher("/crew/drone_0/battery", "sensor_msgs/msg/BatteryState")
    fakes.publisher("/crew/drone_1/pose", "geometry_msgs/msg/PoseStamped")
    first, second = drone(lab, 0), drone(lab, 1)
    with watched(lab, lab.scratch / "model", "--follow", "ros2:/crew") as process:
        fleet = FleetPage(browser, address_of(process))
        page = fleet.page

        def robot(number: int, status: str, state: str) -> None:
            fleet.wait_for(f"drone[{number}]", status, state)

        robot(0, "there", "Air")
        fakes.listeners("/crew/drone_0/battery", "/crew/drone_1/pose")
        robot(1, "there", "Air")
        # Both have the model of one build, which they tell.
        told = page.locator("[data-robot] td:last-child", has_text="fleet_lab")
        told.nth(1).wait_for()
        assert len(set(told.all_text_contents())) == 1
        fakes.publish("/crew/drone_0/battery", percentage=0.5)
        page.locator("[data-robot='drone[0]']", has_text="50 %").wait_for()
        fakes.publish("/crew/drone_1/pose", pose={"position": {"x": 4.5, "y": 2.0}})
        page.evaluate(PLACED)
        # Each robot is found by the publisher of the page before something can be sent.
        page.get_by_label("message of Near").fill('{"data": 3}')
        fleet.press("Near", "sent to 2 nodes")
        robot(0, "there", "Close")
        robot(1, "there", "Close")
        second.terminate(signal.SIGKILL)
        robot(1, "lost", "Close")
        page.get_by_role("alert").get_by_text("drone[1] is lost").wait_for()
        page.get_by_role("button", name="Abort", exact=True).click()
        robot(0, "there", "Landed")
        page.close()
        assert fleet.wrong == []
    first.wait_in("Landed")
    first.terminate()


def test_robots_are_lines_where_the_output_is_no_terminal(lab: Any) -> None:
    node = drone(lab, 0)
    with watched(lab, lab.scratch / "model", "--terminal", "--follow", "ros2:") as process:
        assert process.stdout is not None
        lines = iter(process.stdout)
        assert any(line == "drone[0] there Air start\n" for line in lines)
        node.terminate(signal.SIGKILL)
        assert any(line == "drone[0] lost Air start\n" for line in lines)
        assert next(lines) == "alarm: drone[0] is lost\n"
