"""Comparison of two samples of a measure: A is better than B: yes, no, or not yet.

Runs with the same seeds are compared pair by pair (Student, 1908), because chance is the same in
both of a pair; others by the test of B. Welch, 1947. Where all differences are equal, there is
nothing to estimate a deviation from, and the sign test decides; for independent runs, the rank
test.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from statistics import NormalDist
from typing import Literal

from swarmdsl.execution.estimation.intervals import Interval, student_quantile
from swarmdsl.execution.estimation.sample import Sample, summarize

Goal = Literal["maximize", "minimize"]
Answer = Literal["yes", "no", "not yet"]
_MOST_MORE = 1_000_000


@dataclass(frozen=True)
class Comparison:
    """Difference of a measure between A and B, positive where it is greater in A.

    `answer` is about "A is better than B": "no" says that B is better, "not yet" that the interval
    of the difference contains 0. `size` is the difference by the deviation of one run (J. Cohen's
    d), None without a deviation. `superiority` is the share of pairs in which A is better, with
    half of the ties. `deviation` is that of the difference in one run.
    """

    answer: Answer
    is_paired: bool
    runs: int
    difference: float
    interval: Interval | None
    size: float | None
    superiority: float
    deviation: float
    level: float

    @property
    def more(self) -> int | None:
        """Number of further runs that would decide, if mean and deviation stayed as they are.

        None if it is decided, would need more than a million, or if independent runs do not vary.
        """
        if self.answer != "not yet" or self.difference == 0:
            return None
        if _is_constant(self.difference, self.deviation):
            if not self.is_paired:
                return None
            return math.ceil(1 - math.log2(1 - self.level)) - self.runs
        # Student's distribution has longer tails than the normal one: it needs a few runs more.
        width = NormalDist().inv_cdf((1 + self.level) / 2) * self.deviation / abs(self.difference)
        if width**2 > _MOST_MORE:
            return None
        count = max(math.ceil(width**2), self.runs + 1, 2)
        while _half(count, self.deviation, self.level) >= abs(self.difference):
            count += 1
        return count - self.runs


def compare(
    a: Mapping[int, float], b: Mapping[int, float], goal: Goal, level: float
) -> Comparison | None:
    """Compare values by seed: paired if there are common seeds; None if there is nothing to do.

    With common seeds, the others are left out. `level` is that of the interval.
    """
    common = sorted(a.keys() & b.keys())
    if common:
        return compare_paired(
            [a[seed] for seed in common], [b[seed] for seed in common], goal, level
        )
    if not a or not b:
        return None
    return compare_unpaired(list(a.values()), list(b.values()), goal, level)


def compare_paired(a: Sequence[float], b: Sequence[float], goal: Goal, level: float) -> Comparison:
    """Compare the values of runs with the same seeds, in the same order."""
    sample = summarize([left - right for left, right in zip(a, b, strict=True)], level)
    assert sample is not None
    interval = trusted_interval(sample, level)
    wins = [_win(left, right, goal) for left, right in zip(a, b, strict=True)]
    return _judge(sample, interval, goal, level, _pooled(a, b), math.fsum(wins) / len(wins), True)


def compare_unpaired(
    a: Sequence[float], b: Sequence[float], goal: Goal, level: float
) -> Comparison:
    """Compare the values of independent runs."""
    first, second = summarize(a, level), summarize(b, level)
    assert first is not None
    assert second is not None
    difference = first.mean - second.mean
    errors = [each.deviation**2 / each.count for each in (first, second)]
    error = math.sqrt(sum(errors))
    interval = None
    if _is_constant(difference, error):
        # All values of one are above those of the other.
        arrangements = math.comb(first.count + second.count, first.count)
        if difference and 2 / arrangements <= 1 - level:
            interval = Interval(difference, difference)
    elif min(first.count, second.count) >= 2:
        # The formula of Welch and Satterthwaite.
        parts = (
            each**2 / (sample.count - 1)
            for each, sample in zip(errors, (first, second), strict=True)
        )
        half = student_quantile((1 + level) / 2, error**4 / sum(parts)) * error
        interval = Interval(difference - half, difference + half)
    count = min(first.count, second.count)
    merged = Sample(count, difference, error * math.sqrt(count), interval, ())
    pairs = first.count * second.count
    wins = math.fsum(_win(left, right, goal) for left in a for right in b) / pairs
    return _judge(merged, interval, goal, level, _pooled(a, b), wins, False)


def together(level: float, comparisons: int) -> float:
    """Return the level of each of some intervals that hold together at a level (Bonferroni)."""
    return 1 - (1 - level) / max(comparisons, 1)


def _judge(
    sample: Sample,
    interval: Interval | None,
    goal: Goal,
    level: float,
    deviation: float,
    superiority: float,
    is_paired: bool,
) -> Comparison:
    sign = 1 if goal == "maximize" else -1
    answer: Answer = "not yet"
    if interval is not None and (interval.lower > 0 or interval.upper < 0):
        answer = "yes" if sign * sample.mean > 0 else "no"
    size = sample.mean / deviation if deviation > 0 else None
    return Comparison(
        answer,
        is_paired,
        sample.count,
        sample.mean,
        interval,
        size,
        superiority,
        sample.deviation,
        level,
    )


def _half(count: int, deviation: float, level: float) -> float:
    return student_quantile((1 + level) / 2, count - 1) * deviation / math.sqrt(count)


def trusted_interval(sample: Sample, level: float) -> Interval | None:
    """Return the interval of a mean; None if all values are equal and too few to show it.

    The probability that so many have one sign by chance is that of the sign test.
    """
    constant = _is_constant(sample.mean, sample.deviation)
    too_few = constant and 0.5 ** (sample.count - 1) > 1 - level
    return None if too_few else sample.interval


def _is_constant(mean: float, deviation: float) -> bool:
    return deviation <= 1e-12 * abs(mean)


def _win(left: float, right: float, goal: Goal) -> float:
    if left == right:
        return 0.5
    return float((left > right) == (goal == "maximize"))


def _pooled(a: Sequence[float], b: Sequence[float]) -> float:
    """Return the deviation of one run, from both samples."""
    squares = 0.0
    for values in (a, b):
        mean = math.fsum(values) / len(values)
        squares += math.fsum((each - mean) ** 2 for each in values)
    freedom = len(a) + len(b) - 2
    return math.sqrt(squares / freedom) if freedom > 0 else 0.0
