"""State machine of an inspection robot, as large ones are: 57 states on three levels."""

from __future__ import annotations

from collections.abc import Iterator

PHASES: dict[str, dict[str, tuple[str, ...]]] = {
    "Preparation": {
        "SelfTest": ("CheckActuators", "CheckSensors", "CheckStorage"),
        "Localisation": ("WaitForSatellites", "AlignCompass"),
        "Briefing": ("ReceiveAssignment", "ConfirmAssignment"),
    },
    "Departure": {
        "Launch": ("SpinUpRotors", "LeaveGround", "ClimbToTransitHeight"),
        "Transit": ("FollowCorridor", "AvoidTraffic"),
    },
    "Survey": {
        "Coverage": ("SelectStrip", "FlyStrip", "TurnToNextStrip"),
        "Inspection": ("ApproachFinding", "OrbitFinding", "ClassifyFinding"),
        "Exchange": ("AnnounceFinding", "CollectOffers"),
    },
    "Delivery": {
        "Descent": ("ChooseDropZone", "LowerPayload", "ReleasePayload"),
        "Confirmation": ("PhotographPayload", "AwaitReceipt"),
    },
    "Return": {
        "Homing": ("PlanRoute", "FollowRoute"),
        "Landing": ("AcquireMarker", "DescendOnMarker", "StopRotors"),
        "Docking": ("AlignWithDock", "EngageContacts"),
    },
    "Contingency": {
        "Recovery": ("HoldPosition", "DiagnoseFault"),
        "Diversion": ("ChooseRefuge", "DivertToRefuge"),
    },
}
"""Phases of a mission, their activities, and the steps of these."""


def states() -> list[str]:
    """Return the paths of all states."""
    found = []
    for phase, activities in PHASES.items():
        found.append(phase)
        for activity, steps in activities.items():
            found.append(f"{phase}.{activity}")
            found += (f"{phase}.{activity}.{step}" for step in steps)
    return found


def mission_model() -> str:
    """Return the model: the same text each time.

    Steps follow each other and are repeated when they fail; activities follow each other and lead
    to the contingencies; what is urgent is handled by the phases, from which some steps go straight
    to a step elsewhere.
    """
    events = ("Completed", "Failed", "BatteryLow", "LinkLost", "WeatherWarning", "Resume", "Recall")
    lines = ["package mission", *(f"event {event} : std_msgs/Empty" for event in events)]
    lines += ["endless statemachine Mission {", "  var attempts : int32 = 0"]
    lines += ["  var findings : int32 = 0", f"  initial {next(iter(PHASES))}"]
    phases = list(PHASES)
    for at, phase in enumerate(phases):
        following = phases[(at + 1) % (len(phases) - 1)] if at + 1 < len(phases) else "Return"
        lines += [f"  state {phase} {{", f"    initial {next(iter(PHASES[phase]))}"]
        lines += (f"    {line}" for line in _activities(phase, following))
        if phase != "Contingency":
            lines.append("    on WeatherWarning [findings < 40] -> Contingency.Diversion")
            lines.append("    on LinkLost / attempts = 0 -> Contingency")
        if phase in ("Departure", "Survey", "Delivery"):
            lines.append("    on Recall -> Return.Homing.PlanRoute")
        lines.append("  }")
    return "\n".join([*lines, "}", ""])


def _activities(phase: str, following: str) -> Iterator[str]:
    activities = list(PHASES[phase])
    for at, activity in enumerate(activities):
        steps = PHASES[phase][activity]
        last = at + 1 == len(activities)
        after = following if last else activities[at + 1]
        yield f"state {activity} {{"
        yield f"  initial {steps[0]}"
        for number, step in enumerate(steps):
            yield f"  state {step} {{"
            yield f"    entry / attempts = attempts + {number + 1}"
            if number + 1 < len(steps):
                yield f"    on Completed -> {steps[number + 1]}"
            else:
                yield f"    on Completed / findings = findings + 1 -> {after}"
            if number:
                yield f"    on Failed [attempts < {3 + number}] -> {steps[number - 1]}"
                yield f"    on Failed [attempts >= {3 + number}] -> {_refuge(phase, at, number)}"
            else:
                yield "    on Failed / attempts = attempts + 1"
            if step in ("FlyStrip", "FollowCorridor", "LowerPayload"):
                yield "    on BatteryLow / findings = 0 -> Return.Landing.AcquireMarker"
            yield "  }"
        if phase != "Contingency":
            yield "  on BatteryLow -> Contingency.Recovery.DiagnoseFault"
        elif activity == "Recovery":
            yield "  on Resume [findings > 0] -> Survey.Coverage.SelectStrip"
            yield "  on Resume [findings == 0] -> Departure"
        yield "}"


def _refuge(phase: str, at: int, number: int) -> str:
    """Target of a step that keeps failing."""
    if phase == "Contingency":
        return "Return.Landing"
    return ("Contingency.Recovery", "Contingency.Diversion")[(at + number) % 2]
