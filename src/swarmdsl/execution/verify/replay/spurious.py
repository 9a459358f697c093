"""Reasons why a run that a search has found shows nothing."""

from __future__ import annotations

ELSEWHERE = "the real messages lead elsewhere"
NEAR = "robots are near each other in it: whether they can be depends on their places"
VIEWS = (
    "robots take each other for lost in it: whether they do depends on when faults begin and end; "
    "prove what robots do without others with `--faults`, and no scenario"
)
DEFERS = "a robot defers several events of one name in it: when they arrive is not looked at"
OPEN = (NEAR, VIEWS, DEFERS)
"""Flaws of runs that need not be flaws."""


def exceeding(capacity: int, event: str) -> str:
    """Return the flaw of a run that loses an event for lack of capacity."""
    what = f"of more than {capacity} `{event}` on the way to a robot, one is lost in it"
    return f"{what}: try `--channel {capacity + 1}`"
