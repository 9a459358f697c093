"""Lines of made-up runs, and the states after them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from random import Random
from typing import Any

STATES = ("Day.Quiet", "Day.Thinking", "Day.Telling", "Night")


def lines_of(count: int, members: int, seed: int = 0) -> Iterator[dict[str, Any]]:
    """Yield lines of robots that walk, talk, get lost and come back."""
    dice = Random(seed)
    names = [f"talker[{number}]" for number in range(members)]
    places = {name: [round(dice.uniform(0, 50), 3) for _ in range(2)] for name in names}
    time, before = 0, dict.fromkeys(names, "")
    for number in range(count):
        time += dice.choice((0, 0, 3, 40))
        name = names[number] if number < members else dice.choice(names)
        state = dice.choice(STATES)
        lost = number >= members and dice.random() < 0.002
        event = (
            "fault.lost"
            if lost
            else dice.choice(("News", "after.Day.Quiet.1", "do.walk.succeeded"))
        )
        place = places[name]
        place[:] = [round(each + dice.uniform(-1, 1), 3) for each in place]
        line: dict[str, Any] = {
            "t": time,
            "member": name,
            "event": event if number >= members else None,
            "configuration": [] if lost else [state, "Legs.Rest"],
            "entered": [] if state == before[name] else [state],
            "exited": [before[name]] if before[name] not in ("", state) else [],
            "taken": [] if state == before[name] else [f"{before[name]}->0"],
            "started": ["walk"] if dice.random() < 0.1 else [],
            "cancelled": [],
            "sent": ["News"] if state == "Day.Telling" else [],
            "at": list(place),
        }
        if event == "News" and number >= members:
            line["data"] = {"data": dice.randrange(1000)}
            line["envelope"] = {"sender": dice.choice(names), "sent": time * 1_000_000 - 12_345_678}
            if state == before[name]:
                line["ignored"] = True
        if dice.random() < 0.2:
            line["variables"] = {"heard": dice.randrange(1000)}
        before[name] = state
        yield line


def moment(lines: Sequence[dict[str, Any]], index: int) -> dict[str, dict[str, Any]]:
    """Return states, variables and places of the members after a line, by the plainest way."""
    found: dict[str, dict[str, Any]] = {}
    for line in lines[: index + 1]:
        if "configuration" not in line:
            continue
        last = found.get(line["member"], {"variables": {}})
        lost = line["event"] == "fault.lost"
        found[line["member"]] = {
            "states": [] if lost else line["configuration"],
            "variables": {**last["variables"], **line.get("variables", {})},
            "place": line.get("at", last.get("place")),
            "alive": not lost,
        }
    return found
