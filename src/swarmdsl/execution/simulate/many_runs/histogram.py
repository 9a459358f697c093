"""Histograms of measures and the fitness, as SVG."""

from __future__ import annotations

import math
from collections.abc import Sequence

from swarmdsl.base.diagnostics.render import counted
from swarmdsl.execution.simulate.evaluation.measures import value_text
from swarmdsl.execution.simulate.many_runs.estimates import Estimates, Value
from swarmdsl.execution.simulate.pictures.svg import Drawing

_WIDTH, _HEIGHT = 320, 120
_MARGIN, _HEAD, _FOOT = 24, 34, 34
_MOST_BARS = 40
_COLOUR = "#4c78a8"


def histograms(estimates: Estimates) -> str:
    """Draw a histogram of each measure, one below the other."""
    values = [each for each in estimates.values if each.by_seed]
    each_height = _HEAD + _HEIGHT + _FOOT
    height = max(len(values), 1) * each_height + _MARGIN
    drawing = Drawing(_WIDTH + 2 * _MARGIN, "Measures of many runs")
    for number, value in enumerate(values):
        _draw(drawing, value, number * each_height + _MARGIN)
    return drawing.finish(height)


def bars(values: Sequence[float]) -> tuple[float, list[int]]:
    """Return the width of the bars and their heights (rule of Freedman and Diaconis, 1981)."""
    ordered = sorted(values)
    low, high = ordered[0], ordered[-1]
    if low == high:
        return 0.0, [len(ordered)]
    quarter = len(ordered) // 4
    spread = ordered[-1 - quarter] - ordered[quarter]
    width = 2 * spread / len(ordered) ** (1 / 3) or (high - low) / math.sqrt(len(ordered))
    count = min(max(math.ceil((high - low) / width), 1), _MOST_BARS)
    width = (high - low) / count
    heights = [0] * count
    for value in ordered:
        heights[min(int((value - low) / width), count - 1)] += 1
    return width, heights


def _draw(drawing: Drawing, value: Value, top: float) -> None:
    found = [number for _, number in value.by_seed]
    width, heights = bars(found)
    drawing.text(_MARGIN, top + 14, value.name, "machine")
    base = top + _HEAD + _HEIGHT
    drawing.rect(_MARGIN, top + _HEAD, _WIDTH, _HEIGHT, "lane")
    step = _WIDTH / len(heights)
    low = min(found)
    for number, count in enumerate(heights):
        tall = _HEIGHT * count / max(heights)
        left, right = (_text(value, low + (number + i) * width) for i in (0, 1))
        title = f"{left} to {right}: {counted(count, 'run')}"
        drawing.bar(_MARGIN + number * step, base - tall, step, tall, _COLOUR, title)
    between = f"{_text(value, low)} to {_text(value, max(found))}"
    drawing.text(_MARGIN + _WIDTH / 2, base + 14, between, "time")


def _text(value: Value, number: float) -> str:
    return value_text(number, is_time=value.is_time)
