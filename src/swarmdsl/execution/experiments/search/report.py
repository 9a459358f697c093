"""Result of a search, as text and as plain data."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from swarmdsl.base.diagnostics.render import counted
from swarmdsl.execution.estimation.intervals import Interval
from swarmdsl.execution.experiments.search.evaluation import Evaluation
from swarmdsl.execution.experiments.search.optimizing import Found, Plan
from swarmdsl.execution.experiments.task import Candidate
from swarmdsl.execution.simulate.summary import format_table

_SHOWN = 5
"""Candidates of the race that are shown."""
_ANSWERS = {
    "yes": "the winner is better",
    "no": "today's model is better",
    "not yet": "the runs do not tell which is better",
}


def settings_text(candidate: Candidate) -> str:
    """Write settings as a reader sees them."""
    return ", ".join(f"{name} = {value}" for name, value in candidate.settings) or "as it is"


def as_text(found: Found, plan: Plan, subject: str, fitness: str) -> Iterator[str]:
    """Yield the lines of the result."""
    scenarios = ", ".join(each for each in plan.scenarios if each)
    where = f", {plan.aim.together} of scenarios {scenarios}" if "," in scenarios else ""
    if not where and scenarios:
        where = f", scenario {scenarios}"
    tried = counted(found.tried, "candidate")
    yield f"{subject}: {tried}, method {plan.chosen}{where}"
    yield ""
    rows = [
        (settings_text(each.candidate), str(len(each.values)), _number(each.mean), each.reason)
        for each in found.finals[:_SHOWN]
    ]
    if len(found.finals) > _SHOWN:
        rows.append((f"and {len(found.finals) - _SHOWN} more", "", "", ""))
    yield from format_table(("race", "seeds", fitness, ""), rows)
    named = (("winner", found.winner), ("today", found.today))
    measured = [_measured(name, each, found, plan) for name, each in named]
    if found.comparison is not None:
        between = _interval(found.comparison.interval)
        measured.append(("difference", _number(found.comparison.difference), between, ""))
    head = (f"{counted(plan.fresh, 'fresh seed')}", fitness, f"{plan.level:.0%} interval", "")
    yield from format_table(head, measured)
    yield f"winner: {settings_text(found.winner.candidate)}"
    if found.comparison is not None:
        yield f"with {plan.level:.0%} confidence: {_ANSWERS[found.comparison.answer]}"
    elif found.today.broken:
        yield f"today's model is out: {found.today.reason}"


def _measured(name: str, each: Evaluation, found: Found, plan: Plan) -> tuple[str, str, str, str]:
    sample = found.sample(each, plan.level)
    return name, _number(each.mean), _interval(sample.interval if sample else None), each.reason


def _interval(interval: Interval | None) -> str:
    return f"{interval.lower:.6g} .. {interval.upper:.6g}" if interval is not None else "-"


def _number(value: float | None) -> str:
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
            "interval": _list(comparison.interval),
            "better": comparison.answer,
        },
        "race": [each.as_data() for each in found.finals],
    }


def _evaluated(each: Evaluation, found: Found, plan: Plan) -> dict[str, Any]:
    sample = found.sample(each, plan.level)
    data = each.as_data()
    data["interval"] = _list(sample.interval) if sample is not None else None
    data["by_seed"] = {str(seed): value for seed, value in each.values.items()}
    return data


def _list(interval: Interval | None) -> list[float] | None:
    return list(interval) if interval is not None else None
