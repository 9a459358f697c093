"""Result of a search, as text and as plain data."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from swarmdsl.base.diagnostics.render import counted
from swarmdsl.execution.estimation.intervals import Interval
from swarmdsl.execution.experiments.report.importance import share_text
from swarmdsl.execution.experiments.search.evaluation import Evaluation
from swarmdsl.execution.experiments.search.importance import importances
from swarmdsl.execution.experiments.search.optimizing import Found, Observed, Plan
from swarmdsl.execution.experiments.task import Candidate, settings_text
from swarmdsl.execution.simulate.evaluation.summary import format_table

_SHOWN = 5
"""Candidates of the race that are shown."""
_ANSWERS = {
    "yes": "the winner is better",
    "no": "today's model is better",
    "not yet": "the runs do not tell which is better",
}


def conditions_text(tried: int, plan: Plan) -> str:
    """Return the size of a search, its method and its scenarios."""
    scenarios = ", ".join(each for each in plan.scenarios if each)
    where = f", {plan.aim.together} of scenarios {scenarios}" if "," in scenarios else ""
    if not where and scenarios:
        where = f", scenario {scenarios}"
    return f"{counted(tried, 'candidate')}, method {plan.chosen}{where}"


def matters_text(observed: Sequence[Observed], plan: Plan, objective: int) -> str:
    """Return the share of each setting in the differences between candidates, empty if unknown."""
    pairs = [(candidate, means[objective]) for candidate, means in observed]
    found = [each for each in importances(pairs, plan.space) if each.share is not None]
    return ", ".join(f"{each.setting} {share_text(each)}" for each in found)


def importance_data(observed: Sequence[Observed], plan: Plan, objective: int) -> dict[str, Any]:
    """Return the share of each setting in the differences between candidates, as JSON types."""
    pairs = [(candidate, means[objective]) for candidate, means in observed]
    return {each.setting: each.share for each in importances(pairs, plan.space)}


def as_text(found: Found, plan: Plan, subject: str, fitness: str) -> Iterator[str]:
    """Yield the lines of the result."""
    yield f"{subject}: {conditions_text(found.tried, plan)}"
    yield ""
    rows = [
        (settings_text(each.candidate), str(len(each.values)), number_text(each.mean), each.reason)
        for each in found.finals[:_SHOWN]
    ]
    if len(found.finals) > _SHOWN:
        rows.append((f"and {len(found.finals) - _SHOWN} more", "", "", ""))
    yield from format_table(("race", "seeds", fitness, ""), rows)
    named = (("winner", found.winner), ("today", found.today))
    measured = [_measured(name, each, found, plan) for name, each in named]
    if found.comparison is not None:
        between = interval_text(found.comparison.interval)
        measured.append(("difference", number_text(found.comparison.difference), between, ""))
    if matters := matters_text(found.observed, plan, 0):
        yield f"shares of the differences: {matters}"
        yield ""
    head = (f"{counted(plan.fresh, 'fresh seed')}", fitness, f"{plan.level:.0%} interval", "")
    yield from format_table(head, measured)
    yield f"winner: {settings_text(found.winner.candidate)}"
    known = {each.name: each.today_value for each in plan.space.dimensions}
    today = Candidate.of({name: value for name, value in known.items() if value is not None})
    yield f"today:  {settings_text(today)}"
    if not plan.space.changed(found.winner.candidate).settings:
        yield "the winner is the model as it is"
    elif found.comparison is not None:
        yield f"with {plan.level:.0%} confidence: {_ANSWERS[found.comparison.answer]}"
    elif found.today.broken:
        yield f"today's model is out: {found.today.reason}"


def _measured(name: str, each: Evaluation, found: Found, plan: Plan) -> tuple[str, str, str, str]:
    sample = found.sample(each, plan.level)
    return (
        name,
        number_text(each.mean),
        interval_text(sample.interval if sample else None),
        each.reason,
    )


def interval_text(interval: Interval | None) -> str:
    """Write an interval for people."""
    return f"{interval.lower:.6g} .. {interval.upper:.6g}" if interval is not None else "-"


def number_text(value: float | None) -> str:
    """Write a number for people."""
    return f"{value:.6g}" if value is not None else "-"


def as_data(found: Found, plan: Plan, subject: str, fitness: str) -> dict[str, Any]:
    """Return the result as JSON types."""
    comparison = found.comparison
    return {
        "subject": subject,
        "fitness": {"name": fitness, "goal": plan.aim.goal},
        "method": plan.chosen,
        "scenarios": [each for each in plan.scenarios if each],
        "together": plan.aim.together,
        "properties": list(plan.aim.properties),
        "tried": found.tried,
        "seed": plan.seed,
        "level": plan.level,
        "winner": _evaluated(found.winner, found, plan),
        "today": _evaluated(found.today, found, plan),
        "difference": None
        if comparison is None
        else {
            "mean": comparison.difference,
            "interval": interval_data(comparison.interval),
            "better": comparison.answer,
        },
        "importance": importance_data(found.observed, plan, 0),
        "race": [each.as_data(plan.aim) for each in found.finals],
    }


def _evaluated(each: Evaluation, found: Found, plan: Plan) -> dict[str, Any]:
    sample = found.sample(each, plan.level)
    data = each.as_data(plan.aim)
    data["interval"] = interval_data(sample.interval) if sample is not None else None
    data["by_seed"] = {str(seed): value for seed, value in each.values.items()}
    return data


def interval_data(interval: Interval | None) -> list[float] | None:
    """Return an interval as JSON types."""
    return list(interval) if interval is not None else None
