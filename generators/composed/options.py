"""Options of a composed swarm: those of `swarmc verify`."""

from __future__ import annotations

import re

from swarmdsl.codegen import dataclass, option

MOST = 200
"""Greatest number of robots, and of events on their way to one: they fit a byte."""
_SIZE = re.compile(r"\s*([A-Za-z_]\w*)\s*=\s*([0-9]{1,3})\s*")


def counts_of(text: str) -> dict[str, int] | None:
    """Parse `drone=3, tower=1`; None if it is something else."""
    found: dict[str, int] = {}
    for each in text.split(",") if text.strip() else ():
        match = _SIZE.fullmatch(each)
        if match is None or match[1] in found or not int(match[2]) <= MOST:
            return None
        found[match[1]] = int(match[2])
    return found


def _size_fault(text: str) -> str | None:
    if counts_of(text) is not None:
        return None
    return f"`size` must be numbers of members up to {MOST}, such as `drone=3, tower=1`"


def _channel_fault(number: int) -> str | None:
    return None if 1 <= number <= MOST else f"`channel` must be a number from 1 to {MOST}"


@dataclass(frozen=True)
class Options:
    """The options of the targets."""

    size: str = option(
        "",
        "numbers of members, such as `drone=3, tower=1`; else the smallest, but at least one",
        check=_size_fault,
    )
    channel: int = option(
        2, "number of one event on their way to a robot at a time", check=_channel_fault
    )
    lossy: bool = option(False, "true if any event between robots may be lost")
