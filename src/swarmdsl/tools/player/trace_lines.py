"""Lines of traces, in the order of time, ready for a recording."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source, Span
from swarmdsl.execution.simulate.replay.trace_records import Record, read_records
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND, format_duration
from swarmdsl.tools.player.trace_values import fitting

_SOON = 5 * MILLISECOND
"""Tolerance of clocks: traces have whole milliseconds."""
_SHOWN = 20
"""Number of invalid lines that are told one by one."""


def read_steps(sources: Sequence[Source], report: Diagnostics) -> list[tuple[dict[str, Any], Span]]:
    """Return the lines of traces by time, with their places; report invalid ones.

    The times of all begin with the first node that began. Robots whose clocks differ are told: by a
    swarm event that arrives before it was sent, or by a time that goes back.
    """
    records: list[Record] = []
    zero = None
    for source in sources:
        found = Diagnostics()
        of = list(read_records(source, found))
        _include(found, report)
        began = min((each.done["began"] for each in of if "began" in each.done), default=None)
        if began is not None:
            zero = min(began, zero if zero is not None else began)
        records += of
    steps = [(step, each) for each in records if (step := plain(each.done, zero)) is not None]
    _report_clocks(steps, report)
    steps.sort(key=lambda step: step[0]["t"])
    return [(step, record.place) for step, record in steps]


def _include(found: Diagnostics, report: Diagnostics) -> None:
    """Report invalid lines, the first ones of many."""
    for number, each in enumerate(found):
        if number < _SHOWN:
            report.include([each])
    if len(found) > _SHOWN:
        last = list(found)[_SHOWN]
        place = last.primary.span if last.primary is not None else None
        more = len(found) - _SHOWN
        report.report("bad-trace-line", place, reason=f"{more} more lines are no lines of a trace")


def plain(line: Mapping[str, Any], zero: int | None) -> dict[str, Any] | None:
    """Return the values of a line that a page can show, times since the beginning, if any."""
    value = fitting(dict(line))
    if value is None:
        return None
    began = value.pop("began", zero)
    offset = 0 if began is None or zero is None else began - zero
    value["t"] = value["t"] + offset
    envelope = value.get("envelope")
    if envelope is not None and envelope.get("sent", 0) > _EPOCH:
        # A node fills in the time of its clock, not that since it began.
        value["envelope"] = {**envelope, "sent": envelope["sent"] - (zero or 0) * MILLISECOND}
    return value


_EPOCH = 10**18
"""Nanoseconds from which on a time is one of a clock: September 2001."""


def _report_clocks(steps: Iterable[tuple[Mapping[str, Any], Record]], report: Diagnostics) -> None:
    """Report members whose times go back, and events that arrive before they were sent."""
    last: dict[object, int] = {}
    told: set[tuple[object, object]] = set()
    for value, record in steps:
        member = value.get("member")
        time = value["t"] * MILLISECOND
        for who, behind in _behind(value, time, last.get(member, 0)):
            if (who, member) not in told:
                told.add((who, member))
                report.report(
                    "clocks-differ",
                    record.place,
                    who=f"`{member}`" if member is not None else "the machine",
                    reason=(
                        f"its time goes back by {format_duration(behind)}"
                        if who == member
                        else f"`{value['event']}` of `{who}` arrives {format_duration(behind)} "
                        "before it was sent"
                    ),
                    help="set the clocks of the robots by NTP or PTP: their order is not certain",
                )
        if member is not None:
            last[member] = max(time, last.get(member, 0))


def _behind(value: Mapping[str, Any], time: int, last: int) -> Iterator[tuple[object, int]]:
    """Yield whose time does not fit to a line, and by how much."""
    if "configuration" in value and last - time > _SOON:
        yield value.get("member"), last - time
    envelope = value.get("envelope") or {}
    sender = envelope.get("sender")
    if sender and envelope.get("sent", 0) - time > _SOON:
        yield sender, envelope["sent"] - time
