"""Charts of reports: convergence, parallel coordinates, main effects, distributions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from swarmdsl.execution.estimation.intervals import Interval
from swarmdsl.execution.experiments.report.canvas import Canvas, short, ticks
from swarmdsl.execution.simulate.many_runs.histogram import bars

_LEFT, _RIGHT, _TOP, _BOTTOM = 62, 16, 24, 34


@dataclass(frozen=True)
class _Scale:
    """Numbers from `low` to `high` on pixels from `start` to `end`."""

    low: float
    high: float
    start: float
    end: float

    def at(self, value: float) -> float:
        width = self.high - self.low
        share = (value - self.low) / width if width > 0 else 0.5
        return self.start + share * (self.end - self.start)


def _around(values: Sequence[float], start: float, end: float) -> _Scale:
    """Return a scale with some room around values."""
    low, high = min(values), max(values)
    room = 0.06 * (high - low) or abs(low) * 0.06 or 1.0
    return _Scale(low - room, high + room, start, end)


def convergence(values: Sequence[float | None], goal: str, name: str) -> str:
    """Draw the value of each candidate, in the order of the search, and the best one so far.

    At least one candidate has a value.
    """
    width, height = 640, 260
    canvas = Canvas(width, height, f"{name} of each candidate, and the best so far")
    found = [value for value in values if value is not None]
    across = _Scale(1, max(len(values), 2), _LEFT, width - _RIGHT)
    up = _around(found, height - _BOTTOM, _TOP)
    _grid(canvas, up, width)
    for number in ticks(1, len(values)):
        if number == int(number):
            canvas.text(across.at(number), height - 14, short(number), "tick middle")
    canvas.text(_LEFT, 14, name)
    best: float | None = None
    line: list[tuple[float, float]] = []
    choose = max if goal == "maximize" else min
    for number, value in enumerate(values, 1):
        if value is not None:
            title = f"candidate {number}: {short(value)}"
            canvas.dot(across.at(number), up.at(value), "faint", title)
            before, best = best, value if best is None else choose(best, value)
            if before is not None and before != best:
                line.append((across.at(number), up.at(before)))
        if best is not None:
            line.append((across.at(number), up.at(best)))
    canvas.path(line, "line")
    return canvas.finish()


@dataclass(frozen=True)
class Way:
    """Candidate in parallel coordinates: its position on each axis, from 0 to 1.

    `quality` is 1 for the best and 0 for the worst; `kind` is empty, `best` or `today`.
    """

    positions: Sequence[float]
    quality: float
    title: str
    kind: str = ""


@dataclass(frozen=True)
class Axis:
    """Axis of parallel coordinates, with labels at positions from 0 to 1."""

    name: str
    labels: Mapping[float, str]


def parallel_coordinates(axes: Sequence[Axis], ways: Sequence[Way]) -> str:
    """Draw a line a candidate through its settings; the better, the stronger."""
    width, height = max(140 * len(axes), 320), 300
    canvas = Canvas(width, height, "Candidates as lines through their settings")
    step = (width - _LEFT - 70) / max(len(axes) - 1, 1)
    low, high = height - _BOTTOM, _TOP + 20
    for way in sorted(ways, key=lambda each: (bool(each.kind), each.quality)):
        points = [
            (_LEFT + number * step, low + position * (high - low))
            for number, position in enumerate(way.positions)
        ]
        opacity = 1.0 if way.kind else 0.08 + 0.72 * way.quality**2
        canvas.path(points, f"path {way.kind}".strip(), way.title, opacity)
    for number, axis in enumerate(axes):
        x = _LEFT + number * step
        canvas.line(x, low, x, high, "axis")
        up = _TOP - 10 if number % 2 == 0 else _TOP + 6
        canvas.text(x, up, _cut(axis.name, 24), "middle")
        for position, label in axis.labels.items():
            y = low + position * (high - low)
            canvas.text(x + 5, y + 4, _cut(label, 14), "tick")
    return canvas.finish()


@dataclass(frozen=True)
class Mean:
    """Mean at a level with its interval."""

    label: str
    mean: float
    interval: Interval | None


def main_effect(factor: str, means: Sequence[Mean], span: Interval) -> str:
    """Draw the means at the levels of a factor; `span` is that of all factors."""
    width, height = max(110 + 62 * len(means), 210), 220
    canvas = Canvas(width, height, f"Means at the levels of {factor}")
    up = _around(span, height - _BOTTOM, _TOP)
    across = _Scale(0, max(len(means) - 1, 1), _LEFT + 24, width - _RIGHT - 24)
    _grid(canvas, up, width)
    canvas.text(_LEFT, 14, _cut(factor, 30))
    middle = [(across.at(number), up.at(each.mean)) for number, each in enumerate(means)]
    canvas.path(middle, "line")
    for (x, y), each in zip(middle, means, strict=True):
        title = f"{each.label}: {short(each.mean)}"
        if each.interval is not None:
            low, high = (min(max(bound, up.low), up.high) for bound in each.interval)
            canvas.line(x, up.at(low), x, up.at(high), "whisker")
            title += f" ({short(each.interval.lower)} to {short(each.interval.upper)})"
        canvas.dot(x, y, "dot", title, 4)
        canvas.text(x, height - 14, _cut(each.label, 10), "tick middle")
    return canvas.finish()


def distributions(groups: Sequence[tuple[str, Sequence[float]]], name: str) -> str:
    """Draw the distributions of at most two groups, one above the other, on one scale."""
    width, each_height = 480, 130
    height = _TOP + each_height * len(groups) + _BOTTOM
    canvas = Canvas(width, height, f"Distributions of {name}")
    every = [value for _, values in groups for value in values]
    across = _around(every, _LEFT, width - _RIGHT)
    for number in ticks(across.low, across.high):
        canvas.line(across.at(number), _TOP, across.at(number), height - _BOTTOM, "rule")
        canvas.text(across.at(number), height - 16, short(number), "tick middle")
    for number, (label, values) in enumerate(groups):
        top = _TOP + number * each_height
        base = top + each_height - 8
        canvas.text(_LEFT, top + 12, _cut(label, 60))
        part, heights = bars(values)
        tallest = max(heights)
        low = min(values)
        style = "first" if number == 0 else "second"
        for at, count in enumerate(heights):
            left, right = across.at(low + at * part), across.at(low + (at + 1) * part)
            tall = (each_height - 32) * count / tallest
            title = f"{short(low + at * part)} to {short(low + (at + 1) * part)}: {count} runs"
            canvas.bar(left, base - tall, max(right - left, 3), tall, style, title)
        mean = across.at(sum(values) / len(values))
        canvas.line(mean, top + 18, mean, base, "mean")
        canvas.line(_LEFT, base, width - _RIGHT, base, "axis")
    return canvas.finish()


@dataclass(frozen=True)
class Spot:
    """Candidate by two objectives, with intervals as far as they are known.

    `kind` is `front`, `near`, `today`, or empty for one of the search.
    """

    title: str
    x: float
    y: float
    x_interval: Interval | None = None
    y_interval: Interval | None = None
    kind: str = ""
    label: str = ""


_STYLES = {"front": "dot", "near": "first", "today": "second", "": "faint"}


def front_chart(
    names: tuple[str, str], goals: tuple[str, str], spots: Sequence[Spot], *, is_whole: bool
) -> str:
    """Draw candidates by two objectives; `is_whole` draws the line that the front has reached."""
    width, height = 560, 380
    canvas = Canvas(width, height, f"Front of {names[0]} and {names[1]}")
    xs = [x for each in spots for x in (each.x, *(each.x_interval or ()))]
    ys = [y for each in spots for y in (each.y, *(each.y_interval or ()))]
    across = _around(xs, _LEFT, width - _RIGHT)
    up = _around(ys, height - _BOTTOM - 16, _TOP)
    _grid(canvas, up, width)
    for number in ticks(across.low, across.high):
        canvas.text(across.at(number), height - 32, short(number), "tick middle")
    words = {"maximize": "more is better", "minimize": "less is better"}
    canvas.text(_LEFT, 14, f"{_cut(names[1], 40)} ({words[goals[1]]})")
    canvas.text(width - _RIGHT, height - 10, f"{_cut(names[0], 40)} ({words[goals[0]]})", "end")
    front = sorted((each for each in spots if each.kind == "front"), key=lambda each: each.x)
    if is_whole:
        choose_x, choose_y = (min if goal == "maximize" else max for goal in goals)
        line = [(each.x, each.y) for each in front[:1]]
        for before, each in pairwise(front):
            line += [(choose_x(before.x, each.x), choose_y(before.y, each.y)), (each.x, each.y)]
        canvas.path([(across.at(x), up.at(y)) for x, y in line], "line")
    for each in sorted(spots, key=lambda spot: list(_STYLES).index(spot.kind), reverse=True):
        x, y = across.at(each.x), up.at(each.y)
        if each.x_interval is not None:
            low, high = map(across.at, each.x_interval)
            canvas.line(low, y, high, y, "axis")
        if each.y_interval is not None:
            low, high = map(up.at, each.y_interval)
            canvas.line(x, low, x, high, "axis")
        canvas.dot(x, y, _STYLES[each.kind], each.title, 4 if each.kind else 3)
        canvas.text(x + 6, y - 6, each.label)
    return canvas.finish()


def _grid(canvas: Canvas, up: _Scale, width: float) -> None:
    for number in ticks(up.low, up.high):
        y = up.at(number)
        canvas.line(_LEFT, y, width - _RIGHT, y, "rule")
        canvas.text(_LEFT - 6, y + 4, short(number), "tick end")


def _cut(text: str, most: int) -> str:
    return text if len(text) <= most else f"{text[: most - 1]}\N{HORIZONTAL ELLIPSIS}"
