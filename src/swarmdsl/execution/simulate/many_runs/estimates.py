"""Estimates from many runs: verdicts, measures and fitness as text, plain data, diagnostics."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.diagnostics.render import counted
from swarmdsl.base.records import dataclass
from swarmdsl.execution.estimation.intervals import Interval, clopper_pearson
from swarmdsl.execution.estimation.sample import Sample, summarize
from swarmdsl.execution.monitor import FALSE, OPEN, TRUE
from swarmdsl.execution.simulate.evaluation.measures import inputs_of, value_text
from swarmdsl.execution.simulate.evaluation.summary import format_table
from swarmdsl.execution.simulate.many_runs.chances import Chance, Level
from swarmdsl.execution.simulate.many_runs.one_run import Outcome
from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.ir import Fitness, Property
from swarmdsl.syntax.types import DURATION

_WORST = 3
"""Number of seeds of the worst runs that are shown."""
Command = Callable[[int], str]


@dataclass(frozen=True)
class Value:
    """A measure or the fitness in all runs that have a value of it, by seed."""

    name: str
    is_time: bool
    by_seed: tuple[tuple[int, float], ...]
    unreached: int = 0
    missing: int = 0
    """Number of runs with a result, but without this value; the first of them has a `reason`."""
    reason: str = ""


class Estimates:
    """Outcomes of runs, in the order of their seeds, and what follows from them."""

    def __init__(
        self, properties: Sequence[Property], fitness: Fitness | None, level: Level
    ) -> None:
        self.outcomes: list[Outcome] = []
        self._properties = properties
        self._fitness = fitness
        self._level = level
        self._chances = {
            each.name: Chance(each, level) for each in properties if each.chance is not None
        }

    def add(self, outcome: Outcome) -> None:
        """Add the next run."""
        self.outcomes.append(outcome)
        for each, verdict in zip(self._properties, outcome.verdicts, strict=False):
            if each.name in self._chances:
                self._chances[each.name].add(verdict)

    @property
    def all_decided(self) -> bool:
        """True if there are properties with a chance, and all tests have decided."""
        found = [each.verdict != OPEN for each in self._chances.values()]
        return bool(found) and all(found)

    @property
    def values(self) -> list[Value]:
        """Measures and fitness in all runs."""
        if self._fitness is None:
            return []
        found = []
        for index, each in enumerate(inputs_of(self._fitness)):
            read = [(o.seed, *o.measures[index]) for o in self.outcomes if o.measures]
            by_seed = tuple((seed, value) for seed, value, _ in read if value is not None)
            missed = sum(not reached for *_, reached in read)
            missing = len(read) - len(by_seed)
            found.append(Value(each.name, each.type == DURATION, by_seed, missed, missing))
        ran = [each for each in self.outcomes if not each.failure]
        fitness = tuple((o.seed, o.fitness) for o in ran if o.fitness is not None)
        missing = len(ran) - len(fitness)
        reason = next((each.reason for each in ran if each.reason), "")
        found.append(Value(self._fitness.name, False, fitness, missing=missing, reason=reason))
        return found

    # ---- text

    def head(
        self, subject: str, scenario: str | None, wanted: int, *, interrupted: bool, early: bool
    ) -> str:
        """Return the conditions of all numbers; runs that end `early` do so by their outcomes."""
        done = len(self.outcomes)
        of = "" if done == wanted else f" of {wanted}"
        why = " (interrupted)" if interrupted else ""
        seeds = f", seeds {self.outcomes[0].seed} to {self.outcomes[-1].seed}" if done else ""
        environment = f"scenario {scenario}" if scenario is not None else "no scenario"
        level = f"intervals of {_percent(self._level.confidence)}"
        if early and done < wanted and not interrupted:
            level += " for a fixed number of runs"
        return f"{subject}: {done}{of} runs{why}{seeds}, {environment}, {level}"

    def text(self, command: Command) -> Iterator[str]:
        """Yield tables of verdicts and values, and how to look at the worst runs."""
        failed = [each for each in self.outcomes if each.failure]
        if failed:
            yield f"{counted(len(failed), 'run')} without a result"
            yield ""
        yield from format_table(
            ("property", "true", "false", "open", "chance", "estimate", "test", ""),
            (self._verdict_row(number) for number in range(len(self._properties))),
        )
        yield from format_table(
            ("measure", "mean", "interval", "least", "median", "95 %", "greatest", ""),
            (_value_row(each, self._level.confidence) for each in self.values),
        )
        for name, region in ((n, c.region) for n, c in self._chances.items()):
            span = f"{region.lower:.4g} to {region.upper:.4g}"
            yield (
                f"test of {name}: sequential (Wald), indifferent from {span}, "
                f"errors of {_percent(region.error)}"
            )
        for what, seed, text in self._worst():
            yield f"{what}: seed {seed}{text}: {command(seed)}"

    def _verdict_row(self, number: int) -> tuple[str, ...]:
        each = self._properties[number]
        counts = self._counts(number)
        remarks = self._remarks(number).items()
        notes = ", ".join(f"{said} in {counted(runs, 'run')}" for said, runs in remarks)
        chance = self._chances.get(each.name)
        if chance is None or each.chance is None:
            return each.name, *map(str, counts), "", "", "", notes
        interval = self._interval(counts)
        test = chance.verdict
        if chance.runs is not None:
            test += f" after {counted(chance.runs, 'run')}"
        wanted = f"at {each.chance.bound} {each.chance.probability:g}"
        estimate = f"{_share(counts)} in {interval.lower:.4f} .. {interval.upper:.4f}"
        return each.name, *map(str, counts), wanted, estimate, test, notes

    def _remarks(self, number: int) -> Counter[str]:
        """Return why true verdicts are about no part of a run, and in how many runs."""
        remarks = (each.remarks[number] for each in self.outcomes if not each.failure)
        return Counter(filter(None, remarks))

    def _counts(self, number: int) -> tuple[int, int, int]:
        """Return how often a verdict was true, false and open."""
        found = [each.verdicts[number] for each in self.outcomes if not each.failure]
        return found.count(TRUE), found.count(FALSE), found.count(OPEN)

    def _interval(self, counts: tuple[int, int, int]) -> Interval:
        """Return the interval of a chance, whatever open runs would have become."""
        true, _, left = counts
        runs, level = sum(counts), self._level.confidence
        if not runs:
            return Interval(0.0, 1.0)
        low = clopper_pearson(true, runs, level)
        return Interval(low.lower, clopper_pearson(true + left, runs, level).upper)

    def _violating(self, number: int) -> list[int]:
        """Return the seeds of the runs that violate a property."""
        return [o.seed for o in self.outcomes if o.verdicts and o.verdicts[number] == FALSE]

    def _worst(self) -> Iterator[tuple[str, int, str]]:
        """Yield runs that are worth a look: what is bad, the seed, and the value."""
        for number, each in enumerate(self._properties):
            violating = [
                o.seed for o in self.outcomes if o.verdicts[number : number + 1] == (FALSE,)
            ]
            for seed in violating[:_WORST]:
                yield f"violates {each.name}", seed, ""
        if self._fitness is not None:
            fitness = self.values[-1].by_seed
            sign = 1 if self._fitness.goal == "maximize" else -1
            for seed, value in sorted(fitness, key=lambda each: sign * each[1])[:_WORST]:
                yield f"worst {self._fitness.name}", seed, f" ({value:.6g})"
        for outcome in [each for each in self.outcomes if each.failure][:_WORST]:
            yield "no result", outcome.seed, f" ({outcome.failure})"

    # ---- plain data

    def as_data(self) -> dict[str, Any]:
        """Return everything as plain data; times are in seconds."""
        return {
            "confidence": self._level.confidence,
            "failed": [each.seed for each in self.outcomes if each.failure],
            "properties": [self._property(number) for number in range(len(self._properties))],
            "measures": [_value(each, self._level.confidence) for each in self.values],
            "worst": [{"why": why, "seed": seed} for why, seed, _ in self._worst()],
        }

    def _property(self, number: int) -> dict[str, Any]:
        each = self._properties[number]
        counts = self._counts(number)
        found: dict[str, Any] = {
            "name": each.name,
            **dict(zip(("true", "false", "open"), counts, strict=True)),
        }
        if remarks := self._remarks(number):
            found["remarks"] = dict(remarks)
        chance = self._chances.get(each.name)
        if chance is not None and each.chance is not None:
            found |= {
                "bound": each.chance.bound,
                "probability": each.chance.probability,
                "interval": list(self._interval(counts)),
                "verdict": chance.verdict,
                "decided_after": chance.runs,
                "indifference": [chance.region.lower, chance.region.upper],
                "error": chance.region.error,
            }
        return found

    # ---- diagnostics

    def _failures(self) -> dict[tuple[str, str], list[int]]:
        """Return the evaluations that failed, with their number in each run where any did."""
        found: dict[tuple[str, str], list[int]] = {}
        for outcome in self.outcomes:
            for what, count in outcome.failed:
                found.setdefault(what, []).append(count)
        return found

    def report(self, report: Diagnostics, command: Command) -> None:
        """Report failures, runs without a result, violated properties, and refuted chances."""
        for (machine, reason), failures in self._failures().items():
            runs = f"{len(failures)} of {len(self.outcomes)} runs"
            notes = (f"{_times(sum(failures))} in {runs}",)
            report.report("failed-expression", machine=machine, reason=reason, notes=notes)
        failed = [each for each in self.outcomes if each.failure]
        if failed:
            report.report(
                "failed-runs",
                count=len(failed),
                runs=len(self.outcomes),
                reason=failed[0].failure,
                help=f"look at one: {command(failed[0].seed)}",
            )
        for number, each in enumerate(self._properties):
            counts = self._counts(number)
            chance = self._chances.get(each.name)
            seeds = self._violating(number)
            if chance is None and seeds:
                report.report(
                    "violated-in-runs",
                    each.origin,
                    name=each.name,
                    count=len(seeds),
                    runs=sum(counts),
                    help=f"look at one: {command(seeds[0])}",
                )
            elif chance is not None and chance.verdict == FALSE and each.chance is not None:
                interval = self._interval(counts)
                between = (
                    f"{interval.lower:.4f} to {interval.upper:.4f} at "
                    f"{_percent(self._level.confidence)}"
                )
                report.report(
                    "refuted-chance",
                    each.origin,
                    name=each.name,
                    bound=each.chance.bound,
                    probability=f"{each.chance.probability:g}",
                    runs=chance.runs,
                    notes=(f"true in {counts[0]} of {sum(counts)} runs: {between}",),
                )


def _times(count: int) -> str:
    return "once" if count == 1 else f"{count} times"


def _share(counts: tuple[int, int, int]) -> str:
    true, _, left = counts
    runs = sum(counts)
    if not runs:
        return "-"
    share = f"{true / runs:.4f}"
    return share if not left else f"{share} to {(true + left) / runs:.4f}"


def _percent(share: float) -> str:
    return f"{100 * share:.10g} %"


def _value_row(each: Value, level: float) -> tuple[str, ...]:
    sample = _sample(each, level)
    if sample is None:
        return each.name, "-", "", "", "", "", "", _notes(each)

    def text(value: float) -> str:
        return value_text(value, is_time=each.is_time)

    interval = sample.interval
    between = "" if interval is None else f"{text(interval.lower)} .. {text(interval.upper)}"
    least, _, _, median, _, high, greatest = sample.quantiles
    return (
        each.name,
        *(text(sample.mean), between, text(least), text(median), text(high), text(greatest)),
        _notes(each),
    )


def _notes(each: Value) -> str:
    found = (("not reached", each.unreached), ("no value", each.missing))
    said = ", ".join(f"{what} in {counted(runs, 'run')}" for what, runs in found if runs)
    return f"{said}: {each.reason}" if each.reason else said


def _sample(each: Value, level: float) -> Sample | None:
    return summarize([value for _, value in each.by_seed], level)


def _value(each: Value, level: float) -> dict[str, Any]:
    sample = _sample(each, level)
    found: dict[str, Any] = {"name": each.name, "count": len(each.by_seed)}
    if each.is_time:
        found["unit"] = "s"
    if each.unreached:
        found["unreached"] = each.unreached
    if sample is not None:
        scale = SECOND if each.is_time else 1
        interval = [bound / scale for bound in sample.interval] if sample.interval else None
        quantiles = zip(
            ("0", "0.05", "0.25", "0.5", "0.75", "0.95", "1"), sample.quantiles, strict=True
        )
        found |= {
            "mean": sample.mean / scale,
            "deviation": sample.deviation / scale,
            "interval": interval,
            "quantiles": {name: value / scale for name, value in quantiles},
        }
    return found
