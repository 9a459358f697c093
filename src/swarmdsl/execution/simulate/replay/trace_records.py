"""Lines of the traces that robots and simulations write, with their places."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Source, Span
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND
from swarmdsl.execution.simulate.world.trace_line import read_line


@dataclass(frozen=True)
class Record:
    """Line of a trace, with its span."""

    time: int
    event: str | None
    data: Any
    done: Mapping[str, Any]
    place: Span


def read_records(source: Source, report: Diagnostics) -> Iterator[Record]:
    """Yield the lines of a trace; report invalid ones.

    Nodes write when they began, so that their times have a common beginning.
    """
    found = []
    for start, end in zip(source.line_starts, [*source.line_starts[1:], None], strict=True):
        place = Span(source, start, len(source.text) if end is None else end - 1)
        if place.text.strip():
            value = read_line(place.text)
            if isinstance(value, dict):
                found.append((value, place))
            else:
                help_ = (
                    "`swarmc simulate --trace json` and nodes of target `ros2` write trace lines"
                )
                report.report("bad-trace-line", place, reason=value, help=help_)
    zero = min((value["began"] for value, _ in found if "began" in value), default=0)
    for value, place in found:
        time = value["t"] + max(value.get("began", zero) - zero, 0)
        yield Record(time * MILLISECOND, value.get("event"), value.get("data"), value, place)


def find_loop(records: Sequence[Record], report: Diagnostics) -> int | None:
    """Return how many lines repeat for ever, which the last one says; report another number."""
    for number, record in enumerate(records, start=1):
        loop = record.done.get("loop")
        if loop is None:
            continue
        if number == len(records) and loop <= number:
            return int(loop)
        reason = "only the last line has `loop`" if loop <= number else "`loop` has too many lines"
        report.report("bad-trace-line", record.place, reason=reason)
    return None
