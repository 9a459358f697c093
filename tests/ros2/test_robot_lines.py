"""Lines of robots are ordered by time, and what is missing of them is told."""

from __future__ import annotations

import json
from typing import Any

from swarmdsl.codegen.bundled.ros2.runtime.robot_lines import Machine, RobotLines

MACHINES = {
    "robot": Machine("work", ("Idle", "Busy")),
    "robot.arm": Machine("arm", ("Up", "Down")),
}
LISTS = ("entered", "exited", "taken", "started", "cancelled", "sent")
ZERO = 1_000_000


def line(
    began: int, number: int, event: str | None, at: int, member: str = "robot[0]", **more: Any
) -> str:
    """Write a line of a node that began, at a time since the first start in ms."""
    record = {
        "t": at - began,
        "began": ZERO + began,
        "number": number,
        "member": member,
        "event": event,
        "configuration": ["Idle"],
        **{key: [] for key in LISTS},
    }
    return json.dumps({**record, **more})


def lines_of(*expected: str) -> RobotLines:
    return RobotLines(MACHINES, expected, wait=100, start=5000)


def told(lines: RobotLines, now: int) -> list[tuple[int, str, str | None]]:
    """Return the lines that are judged until a time: their times in ms, machines and events."""
    return [
        (each.time // 1_000_000, each.actor.name, each.event) for each in lines.ready(ZERO + now)
    ]


def test_lines_are_judged_in_the_order_of_time() -> None:
    lines = lines_of()
    lines.hear(line(0, 0, None, 0), ZERO + 5)
    lines.hear(line(0, 1, "Late", 60), ZERO + 90)
    lines.hear(line(10, 0, None, 10, "robot[1]"), ZERO + 95)
    lines.hear(line(10, 1, "Early", 50, "robot[1]"), ZERO + 96)

    assert told(lines, 104) == []
    assert told(lines, 105) == [(0, "robot[0]", None)]
    assert told(lines, 195) == [(10, "robot[1]", None)]
    assert told(lines, 200) == [(50, "robot[1]", "Early"), (60, "robot[0]", "Late")]
    assert list(lines.conditions()) == []


def test_starts_come_first_and_parts_are_known() -> None:
    lines = lines_of()
    lines.hear(line(0, 0, None, 0), ZERO)
    lines.hear(line(0, 1, "Go", 7), ZERO + 7)
    lines.hear(line(7, 0, None, 7, "robot[0].arm"), ZERO + 8)

    found = list(lines.rest())
    assert [(each.actor.name, each.event) for each in found] == [
        ("robot[0]", None),
        ("robot[0].arm", None),
        ("robot[0]", "Go"),
    ]
    arm = found[1].actor
    assert (arm.robot.name, arm.robot.role, arm.states) == ("robot[0]", "robot", ("Up", "Down"))


def test_first_lines_wait_for_all_that_are_expected() -> None:
    lines = lines_of("robot[0]", "robot[1]")
    lines.hear(line(0, 0, None, 0), ZERO)
    assert told(lines, 4999) == []
    assert lines.next_look(None) == ZERO + 5000

    lines.hear(line(2000, 0, None, 2000, "robot[1]"), ZERO + 2100)
    assert [name for _, name, _ in told(lines, 2200)] == ["robot[0]", "robot[1]"]


def test_who_is_not_heard_is_told() -> None:
    lines = lines_of("robot[0]", "robot[1]")
    lines.hear(line(0, 0, None, 0), ZERO)
    assert told(lines, 5000) == [(0, "robot[0]", None)]
    assert list(lines.conditions()) == ["robot[1] not heard"]


def test_lines_that_are_missing_late_or_heard_twice() -> None:
    lines = lines_of()
    lines.hear(line(0, 3, "First", 40), ZERO + 40)
    lines.hear(line(0, 3, "First", 40), ZERO + 41)
    lines.hear(line(0, 6, "Last", 50), ZERO + 50)
    assert [event for _, _, event in told(lines, 150)] == ["First", "Last"]

    # Time is settled until 60 ms then, and a line of 55 ms comes too late.
    assert lines.settled(ZERO + 160) == ZERO + 60
    lines.hear(line(20, 0, None, 55, "robot[1]"), ZERO + 161)
    assert told(lines, 261) == [(60, "robot[1]", None)]
    assert list(lines.conditions()) == [
        "5 lines of robot[0] not heard",
        "1 line of robot[1] too late",
    ]


def test_lines_that_are_no_lines_of_a_robot() -> None:
    lines = lines_of()
    good = json.loads(line(0, 0, None, 0))
    changes: tuple[dict[str, Any], ...] = (
        {"member": "rover[0]"},
        {"member": "robot[0].leg"},
        {"member": None},
        {"sent": "Go"},
        {"began": "0"},
        {"number": None},
        {"t": -1},
        {"event": 1},
        {"envelope": []},
        {"values": []},
    )
    for text in ("no JSON", "[]", "{}", *(json.dumps({**good, **each}) for each in changes)):
        assert lines.hear(text, ZERO) is None
    assert list(lines.rest()) == []
    assert list(lines.conditions()) == ["13 lines of no robot of the swarm left out"]


def test_a_robot_that_starts_again_was_lost() -> None:
    lines = lines_of()
    lines.hear(line(0, 0, None, 0), ZERO)
    lines.hear(line(400, 0, None, 400, configuration=["Busy"]), ZERO + 400)
    lines.hear(line(0, 1, "Old", 30), ZERO + 401)

    found = list(lines.rest())
    assert [(each.time // 1_000_000, each.event) for each in found] == [
        (0, None),
        (399, "fault.lost"),
        (400, None),
    ]
    assert found[1].configuration == ["Idle"]

    # It is lost once, where its end was noticed.
    lines.lose("robot[0]", ZERO + 500)
    lines.hear(line(900, 0, None, 900), ZERO + 900)
    assert [each.event for each in lines.rest()] == ["fault.lost", None]
    assert list(lines.conditions()) == []


def test_a_robot_is_lost_once_and_may_be_heard_again() -> None:
    lines = lines_of()
    lines.lose("robot[0]", ZERO)
    lines.hear(line(0, 0, None, 0), ZERO)
    for now in (300, 400):
        lines.lose("robot[0]", ZERO + now)
    lines.hear(line(0, 1, "Go", 500), ZERO + 500)

    assert [each.event for each in lines.rest()] == [None, "fault.lost", "Go"]
    assert list(lines.conditions()) == ["robot[0] lost and heard again"]


def test_a_machine_that_has_ended_is_not_lost() -> None:
    lines = lines_of()
    lines.hear(line(0, 0, None, 0, ended=True), ZERO)
    lines.hear(line(0, 0, "node.shutdown", 9, "robot[1]"), ZERO + 9)
    for name in ("robot[0]", "robot[1]"):
        lines.lose(name, ZERO + 300)
    assert [each.event for each in lines.rest()] == [None, "node.shutdown"]


def test_time_limits_are_looked_at_when_no_line_can_come_any_more() -> None:
    lines = lines_of()
    assert lines.next_look(7_000_000) is None
    lines.hear(line(0, 0, None, 0), ZERO)
    assert lines.next_look(7_000_000) == ZERO + 100
    assert told(lines, 100) == [(0, "robot[0]", None)]

    assert lines.next_look(None) is None
    assert lines.next_look(7_000_000) == ZERO + 108
    # A line from before must be judged first.
    lines.hear(line(0, 1, "Go", 5), ZERO + 50)
    assert lines.next_look(7_000_000) == ZERO + 150
    assert lines.settled(ZERO + 140) == ZERO + 5


def test_robots_beyond_the_multiplicity_are_left_out() -> None:
    machines = {"robot": Machine("work", ("Idle", "Busy"), most=2)}
    lines = RobotLines(machines, (), wait=100, start=5000)
    lines.hear(line(0, 0, None, 0), ZERO)
    for number in range(2):
        assert lines.hear(line(0, number, None, 0, "robot[2]"), ZERO) is None
    lines.hear(line(0, 0, None, 0, "robot"), ZERO)
    assert [each.actor.name for each in lines.rest()] == ["robot[0]"]
    assert list(lines.conditions()) == [
        "2 lines left out, because robot[2] is none of the 2 robots of role robot",
        "1 line of no robot of the swarm left out",
    ]
