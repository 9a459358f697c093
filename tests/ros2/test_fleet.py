"""Fleets on a real ROS 2, one computer a robot: partitions, lost packets, robots that die."""

from __future__ import annotations

import signal
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from .conftest import HERE, check_trace, write_package
from .fleet import Fleet
from .radio import missing
from .watching import FleetPage, address_of, browser_beside, watched

EXAMPLES = HERE.parents[1] / "examples"
PICTURES = HERE.parents[1] / "docs" / "pictures"
PERIOD, TIMEOUT = 0.2, 2.5
SLACK = 2.0
"""Seconds that a machine which does much else may add to a timeout."""
_FOUND = 10.0
"""Seconds that DDS may take to find a new process on a busy machine."""
_ROUNDED = 0.002
"""Error of times that are rounded to milliseconds, in seconds."""


@pytest.fixture(scope="module")
def behaviors(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """The packages of the swarms that run as fleets."""
    folder = tmp_path_factory.mktemp("fleets")
    return [write_package(EXAMPLES / name, folder) for name in ("agriculture", "search_and_rescue")]


@pytest.fixture
def fleet(
    ros_folder: Path, behaviors: list[Path], tmp_path: Path
) -> Iterator[Callable[..., Fleet]]:
    """Make a fleet; the trace of each of its nodes must agree with the model."""
    if reason := missing():
        pytest.skip(f"no fleet: {reason}")
    made: list[Fleet] = []

    def make(*names: str) -> Fleet:
        made.append(Fleet(ros_folder, behaviors, names, tmp_path))
        return made[-1]

    try:
        yield make
    finally:
        for each in made:
            each.close()
    for each in made:
        for number, node in enumerate(each.nodes):
            check_trace(node, tmp_path / f"replay_{number}.toml")


class Farm:
    """The base and two scouts of the agricultural swarm."""

    robots = ("scout[0]", "scout[1]", "base[0]")

    def __init__(self, fleet: Fleet) -> None:
        self.fleet = fleet
        self.fakes, *scouts = fleet.fakes("base_0", "scout_0", "scout_1")
        self.fakes.publisher("/field/base_0/rain", "std_msgs/msg/Bool")
        for number, fakes in enumerate(scouts):
            space = f"/field/scout_{number}"
            fakes.action(f"{space}/survey", "farm_interfaces/action/Survey", "never")
            fakes.service(f"{space}/fly_home", "std_srvs/srv/Trigger")

    def scout(self, number: int) -> Any:
        """Start a scout."""
        return self.start("scouting", f"scout[{number}]", altitude=8.0, strips=4)

    def start(self, machine: str, member: str, **parameters: Any) -> Any:
        """Start the node of a robot."""
        name = member[:-1].replace("[", "_")
        return self.fleet.computers[name].node(
            f"farm_behavior.{machine}",
            f"/field/{name}",
            member=member,
            self__count=2 if member.startswith("scout") else 1,
            heartbeat__period=PERIOD,
            heartbeat__timeout=TIMEOUT,
            heartbeat__members=" ".join(self.robots),
            **parameters,
        )


def begun(node: Any) -> float:
    """Return when a node has begun, in seconds since 1970 by its clock."""
    return float(node.trace[0]["began"]) / 1000


def heard_of(node: Any, event: str, member: str, since: float) -> float:
    """Wait for an event about another robot; return how long after a moment it came."""

    def times(trace: list[dict[str, Any]]) -> list[float]:
        lines = [line for line in trace if line["event"] == event]
        found = [begun(node) + line["t"] / 1000 for line in lines if line["data"]["id"] == member]
        return [each - since for each in found if each > since - _ROUNDED]

    node.until(lambda trace: bool(times(trace)), f"{event} {member}")
    return times(node.trace)[0]


def count(node: Any, event: str) -> int:
    """Return how often an event is in the trace of a node."""
    return sum(line["event"] == event for line in node.trace)


def now(*nodes: Any) -> dict[str, str]:
    """Return the states of robots as their own traces tell them."""
    return {node.parameters["member"]: ", ".join(node.trace[-1]["configuration"]) for node in nodes}


def test_the_farm_is_partitioned_and_a_scout_is_killed(
    fleet: Callable[..., Fleet], bless: bool, tmp_path: Path
) -> None:
    """A person sees it, and ends the work of all that can hear."""
    made = fleet("base_0", "scout_0", "scout_1", "ground")
    ground, follow = made.computers["ground"], ("--follow", "ros2:/field")
    with (
        browser_beside(ground.prefix, tmp_path) as browser,
        watched(ground, EXAMPLES / "agriculture", *follow) as process,
    ):
        page = FleetPage(browser, address_of(process))
        _watch_the_farm(made, page, PICTURES if bless else None)
        assert page.wrong == []


def _watch_the_farm(made: Fleet, page: FleetPage, pictures: Path | None) -> None:
    # All that it sends and hears has a time that is a second away.
    made.set_clock_wrong("scout_1", 1000)
    farm = Farm(made)
    base = farm.start("farm", "base[0]")
    first = farm.scout(0)
    first.wait_in("Work.Survey")
    base.wait_for("member_lost")
    second = farm.scout(1)  # late
    second.wait_in("Work.Survey")
    for node in (base, first):
        assert heard_of(node, "member_joined", "scout[1]", begun(second) - 1) < _FOUND
    page.wait_for("scout[1]", "there", "Work.Survey")
    farm.fakes.listeners("/field/base_0/rain")

    cut = time.time()
    made.radio.cut("scout_0")
    assert heard_of(base, "member_lost", "scout[0]", cut) < TIMEOUT + SLACK
    assert heard_of(first, "member_lost", "base[0]", cut) < TIMEOUT + SLACK
    farm.fakes.publish("/field/base_0/rain", data=True)
    second.wait_in("Landed")
    assert first.trace[-1]["configuration"] == ["Work.Survey"]
    page.wait_for("scout[0]", "lost", "Work.Survey")
    page.wait_for("scout[1]", "there", "Landed")
    there = {"scout[0]": "lost", "scout[1]": "there", "base[0]": "there"}
    states = now(base, first, second)
    assert page.shown() == {name: (each, states[name]) for name, each in there.items()}
    assert page.alarms() == ["scout[0] is lost"]
    if pictures is not None:
        page.draw(pictures, "fleet-cut")

    healed = time.time()
    made.radio.heal("scout_0")
    for node, other in ((base, "scout[0]"), (first, "base[0]"), (first, "scout[1]")):
        assert heard_of(node, "member_joined", other, healed) < PERIOD + SLACK
    first.wait_in("Landed")
    page.wait_for("scout[0]", "there", "Landed")

    before = [count(node, "member_lost") for node in (base, first, second)]
    made.radio.lose(0.2)
    farm.fakes.publish("/field/base_0/rain", data=False)
    for node in (first, second):
        node.wait_in("Work.Survey")
    made.radio.wait_for_losses(20)
    assert [count(node, "member_lost") for node in (base, first, second)] == before
    made.radio.lose_nothing()

    # A line that was lost comes again only as long as its sender is there.
    page.wait_for("scout[1]", "there", "Work.Survey")
    killed = time.time()
    second.process.send_signal(signal.SIGKILL)
    for node in (base, first):
        assert heard_of(node, "member_lost", "scout[1]", killed) < TIMEOUT + SLACK
    page.wait_for("scout[1]", "lost", "Work.Survey")
    again = farm.scout(1)
    again.wait_in("Work.Survey")
    for node in (base, first):
        heard_of(node, "member_joined", "scout[1]", killed)
    again.wait_for("Weather")  # the last one
    page.wait_for("scout[1]", "there", "Work.Survey")

    made.radio.cut("scout_0")
    page.wait_for("scout[0]", "lost", "Work.Survey")
    page.press("Abort", "lost: scout[0]")
    for node, state in ((base, "Closed"), (again, "Parked")):
        page.wait_for(node.parameters["member"], "ended", state)
        assert node.exit_code() == 0
    assert now(base, first, again) == {name: each for name, (_, each) in page.shown().items()}
    assert now(first) == {"scout[0]": "Work.Survey"}
    made.radio.heal("scout_0")
    assert first.exit_code() == 0
    page.wait_for("scout[0]", "ended", "Parked")
    assert page.alarms() == []


# In 25 s, DDS would forget a robot without the lease of the profile.
@pytest.mark.parametrize("away", [0, pytest.param(25, marks=pytest.mark.thorough)])
def test_an_abort_lands_all_that_can_hear_and_later_the_others(
    fleet: Callable[..., Fleet], variant: Callable[..., Path], away: int
) -> None:
    """With the profiles for a radio, of which 20 % of the packets get lost."""
    made = fleet("ground", "uav_0", "uav_1", "rover_0")
    settings = {"network": "wifi", "peers": ",".join(made.radio.addresses.values())}
    package = variant("examples/search_and_rescue", **settings)
    (folder,) = package.glob("config/*/network")
    made.use_profile(folder / "fastdds.xml")
    (ground,) = made.fakes("ground")
    for event in ("mission_start", "mission_abort"):
        ground.publisher(f"/sar/{event}", "swarmros/msg/SimpleEvent")
    rover = made.computers["rover_0"].node(
        "sar_behavior.rover_rescue", "/sar/rover_0", member="rover[0]"
    )
    with made.profile(folder / "fastdds_functions.xml"):
        servers = made.fakes("uav_0", "uav_1")
    uavs = [_uav(made, number, fakes) for number, fakes in enumerate(servers)]
    ground.listeners("/sar/mission_start", "/sar/mission_abort", count=3)
    made.radio.lose(0.2)
    ground.publish("/sar/mission_start")
    for uav in uavs:
        uav.wait_in("Mission.Coverage")
    rover.wait_in("Mission.Rescue.Ready", "Mission.Watch.Watching")

    made.radio.cut("uav_0")
    ground.publish("/sar/mission_abort")
    uavs[1].wait_in("Mission.Idle")
    assert rover.exit_code() == 0
    assert rover.trace[-1]["configuration"] == ["Parked"]
    time.sleep(away)
    assert uavs[0].trace[-1]["configuration"] == ["Mission.Coverage"]

    made.radio.heal("uav_0")
    uavs[0].wait_in("Mission.Idle")
    made.radio.wait_for_losses(1)
    made.radio.lose_nothing()
    for uav in uavs:
        assert uav.terminate() == 0


def _uav(made: Fleet, number: int, fakes: Any) -> Any:
    name = f"uav_{number}"
    space = f"/sar/{name}"
    fakes.action(f"{space}/cmd/takeoff", "uav_mavros_takeoff/action/TakeOff", "succeeded")
    fakes.action(f"{space}/uav_coverage", "cpswarm_msgs/action/Coverage", "never")
    fakes.service(f"{space}/cmd/land", "std_srvs/srv/Empty", "ok")
    parameters = {"member": f"uav[{number}]", "altitude": 2.5}
    return made.computers[name].node("sar_behavior.uav_search", space, **parameters)
