"""Arrows of a timeline: single swarm events, and bundles of one sender at almost one time."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from enum import Enum
from math import log2
from typing import NamedTuple

from swarmdsl.execution.simulate.network.packets import Transmission
from swarmdsl.execution.simulate.pictures.svg import Drawing
from swarmdsl.execution.simulate.scenario.durations import format_duration
from swarmdsl.execution.simulate.scenario.scenario import Robot

NEAR = 9.0
"""Arrows of one robot that begin within this distance are drawn as one."""
_WIDEST = 4.0


class Fate(Enum):
    """Outcome of a swarm event for one receiver; the values are styles of the drawing."""

    TAKEN = "arrow"
    IGNORED = "ignored"
    LOST = "dropped"


class Crossing(NamedTuple):
    """Swarm event from one robot to another, with its fate there."""

    sent: Transmission
    fate: Fate


class Scale(NamedTuple):
    """Place of times and robots in the drawing: `edges` are top and bottom of a lane."""

    x: Callable[[float], float]
    end: int
    edges: Mapping[Robot, tuple[float, float]]


def draw_arrows(drawing: Drawing, crossings: Iterable[Crossing], scale: Scale) -> bool:
    """Draw all arrows; return True if some are bundled."""
    known = [
        each
        for each in crossings
        if each.sent.source in scale.edges and each.sent.target in scale.edges
    ]
    bundled = False
    for bundle in bundles(known, scale):
        if len(bundle) == 1 or _width(bundle[0], scale) > NEAR:
            _single(drawing, bundle, scale)
        else:
            bundled = True
            _comb(drawing, bundle, scale)
    return bundled


def bundles(crossings: Iterable[Crossing], scale: Scale) -> Iterator[list[Crossing]]:
    """Group what one robot sends at almost one time.

    Events that are on their way for a visible time are in a bundle only with others of the same
    receiver and fate.
    """
    open_: dict[object, list[Crossing]] = {}
    for each in sorted(crossings, key=lambda one: one.sent.sent):
        sent = each.sent
        slow = _width(each, scale) > NEAR
        key = (sent.source, sent.target, each.fate) if slow else sent.source
        bundle = open_.get(key)
        if bundle is not None and _is_near(bundle[0], each, scale):
            bundle.append(each)
            continue
        if bundle is not None:
            yield bundle
        open_[key] = [each]
    yield from open_.values()


def _is_near(first: Crossing, other: Crossing, scale: Scale) -> bool:
    """Return True if two arrows begin and end at almost the same times."""
    return all(
        abs(scale.x(min(b, scale.end)) - scale.x(min(a, scale.end))) <= NEAR
        for a, b in ((first.sent.sent, other.sent.sent), (first.sent.due, other.sent.due))
    )


def _width(crossing: Crossing, scale: Scale) -> float:
    sent = crossing.sent
    return scale.x(min(sent.due, scale.end)) - scale.x(sent.sent)


def _single(drawing: Drawing, bundle: Sequence[Crossing], scale: Scale) -> None:
    """Draw one arrow from the time of sending to that of arrival."""
    (first, fate), last = bundle[0], bundle[-1].sent
    start, end = _ends(first.source, first.target, scale)
    x, to = scale.x(first.sent), scale.x(min(first.due, scale.end))
    if len(bundle) > 1:
        words = _described(bundle)
    else:
        address = f" to {first.to}" if first.to is not None else ""
        time = format_duration(last.sent)
        words = f"{first.event}{address}: {first.source.name} -> {first.target.name}, {time}"
        words += {Fate.LOST: ", lost", Fate.IGNORED: ", ignored"}.get(fate, "")
    drawing.arrow(x, start, to, end, fate.value, _stroke(len(bundle)), words)


def _comb(drawing: Drawing, bundle: Sequence[Crossing], scale: Scale) -> None:
    """Draw a line from the sender along all receivers, with marks where they are."""
    xs = [scale.x(each.sent.sent) for each in bundle]
    x = (min(xs) + max(xs)) / 2
    fates: dict[Robot, set[Fate]] = {}
    for sent, fate in bundle:
        fates.setdefault(sent.target, set()).add(fate)
    ends = {target: _ends(bundle[0].sent.source, target, scale) for target in fates}
    marks = [
        (x + 6 * (number - (len(found) - 1) / 2), end, end > start, fate.value)
        for target, found in fates.items()
        for start, end in (ends[target],)
        for number, fate in enumerate(each for each in Fate if each in found)
    ]
    spines = []
    for down in (False, True):
        reached = [(start, end) for start, end in ends.values() if (end > start) is down]
        if reached:
            furthest = (max if down else min)(end for _, end in reached)
            spines.append((x, reached[0][0], furthest))
    all_lost = all(each.fate is Fate.LOST for each in bundle)
    style = "spine lost" if all_lost else "spine"
    drawing.comb(spines, marks, style, _stroke(len(bundle) / len(fates)), _described(bundle))


def _ends(source: Robot, target: Robot, scale: Scale) -> tuple[float, float]:
    """Return where an arrow leaves the lane of a robot and reaches that of another one."""
    (top, bottom), (to_top, to_bottom) = scale.edges[source], scale.edges[target]
    return (bottom, to_top) if to_top > top else (top, to_bottom)


def _stroke(count: float) -> float:
    return min(1 + log2(count) / 2, _WIDEST)


def _described(bundle: Sequence[Crossing]) -> str:
    """Describe a bundle: its size and times, and a line for each event and receiver."""
    counts = Counter((sent.event, sent.target.name, fate) for sent, fate in bundle)
    first, last = bundle[0].sent, bundle[-1].sent
    times = f"{format_duration(first.sent)} to {format_duration(last.sent)}"
    lines = [f"{len(bundle)} swarm events of {first.source.name}, {times}"]
    words = {Fate.TAKEN: "", Fate.IGNORED: ", ignored", Fate.LOST: ", lost"}
    for (event, target, fate), count in counts.items():
        times = f" \N{MULTIPLICATION SIGN}{count}" if count > 1 else ""
        lines.append(f"{event} -> {target}{times}{words[fate]}")
    return "\n".join(lines)
