"""The example visits the same states as the CPSwarm machine that it re-models."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from swarmdsl.ir import System

Emit = Callable[..., dict[str, str]]
Walk = Callable[..., list[set[str]]]

# Event in our portable file, event in a file of the CPSwarm dialect, the state that follows.
# What the real machine does not handle (an aborted take-off, for instance) is not in it.
MISSION = [
    ("MissionStart", "missionStart", "TakeOff"),
    ("do.TakeOff.succeeded", "succeeded", "Coverage"),
    ("do.Coverage.succeeded", "succeeded", "SelectRover"),
    ("do.SelectRover.aborted", "aborted", "SelectRover"),
    ("do.SelectRover.succeeded", "succeeded", "Tracking"),
    ("do.Tracking.aborted", "aborted", "LocalCoverage"),
    ("do.LocalCoverage.succeeded", "succeeded", "Tracking"),
    ("do.Tracking.aborted", "aborted", "LocalCoverage"),
    ("do.LocalCoverage.aborted", "aborted", "Coverage"),
    ("do.Coverage.succeeded", "succeeded", "SelectRover"),
    ("do.SelectRover.succeeded", "succeeded", "Tracking"),
    ("do.Tracking.succeeded", "succeeded", "Coverage"),
    ("MissionAbort", "missionAbort", "Land"),
    ("do.Land.succeeded", "succeeded", "Idle"),
    ("MissionAbort", "missionAbort", "Land"),
    ("do.Land.succeeded", "succeeded", "Idle"),
    ("MissionStart", "missionStart", "TakeOff"),
]
EXPECTED = ["Idle", *(state for *_, state in MISSION)]


def named(active: list[set[str]]) -> list[str]:
    """Return the active state of the mission at each step."""
    walked = [sorted(states & set(EXPECTED)) for states in active]
    assert all(len(states) == 1 for states in walked), walked
    return [states[0] for states in walked]


def test_our_portable_file(search_and_rescue: System, emit: Emit, walk: Walk) -> None:
    document = emit(search_and_rescue)["UavSearch.scxml"]

    assert named(walk(document, [event for event, *_ in MISSION])) == EXPECTED


def test_the_real_file(corpus: Path, walk: Walk) -> None:
    document = (corpus / "scxml" / "head_UAV_sar_FSM2.xml").read_text(encoding="utf-8")
    # The engine takes the first `<state>` for the initial one when none is named.
    document = document.replace('id="SarBehavior"', 'id="SarBehavior" initial="IdleThreads"')

    assert named(walk(document, [event for _, event, _ in MISSION])) == EXPECTED


def test_our_file_in_the_dialect(search_and_rescue: System, emit: Emit, walk: Walk) -> None:
    files = emit(search_and_rescue, "both", ["complete-by-hand", "profile-left-out"])
    document = files["UavSearch.cpswarm.xml"].replace(
        'id="MissionBehavior"', 'id="MissionBehavior" initial="IdleThreads"'
    )
    # A state that only waits is a monitor alone: without a call it would have no code.
    document = document.replace('id="MissionStartMonitoring"', 'id="Idle"')

    assert named(walk(document, [event for _, event, _ in MISSION])) == EXPECTED
