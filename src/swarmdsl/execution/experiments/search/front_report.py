"""Result of a search with several objectives: text, plain data and a page."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from typing import Any

from swarmdsl.base.diagnostics.render import counted
from swarmdsl.execution.estimation.intervals import Interval
from swarmdsl.execution.experiments.measured import FITNESS, summary_of
from swarmdsl.execution.experiments.report.charts import Spot, front_chart
from swarmdsl.execution.experiments.report.importance import importance_section
from swarmdsl.execution.experiments.report.page import Figure, Page, Section, html, text_table
from swarmdsl.execution.experiments.report.search import Worst, worst_runs
from swarmdsl.execution.experiments.search.evaluation import Evaluation
from swarmdsl.execution.experiments.search.front_search import FoundFront
from swarmdsl.execution.experiments.search.importance import importances
from swarmdsl.execution.experiments.search.optimizing import Plan
from swarmdsl.execution.experiments.search.page import Chosen, search_facts
from swarmdsl.execution.experiments.search.report import (
    conditions_text,
    importance_data,
    interval_data,
    interval_text,
    matters_text,
    number_text,
)
from swarmdsl.execution.experiments.task import settings_text
from swarmdsl.execution.simulate.evaluation.summary import format_table

Rows = list[tuple[str, ...]]


def names_of(plan: Plan, fitness: str) -> list[str]:
    """Return the names of the objectives; `fitness` is that of the fitness."""
    return [fitness if each.measure == FITNESS else each.measure for each in plan.aim.objectives]


def goals_text(plan: Plan, fitness: str) -> str:
    """Return the objectives for people."""
    pairs = zip(plan.aim.objectives, names_of(plan, fitness), strict=True)
    return ", ".join(f"{each.goal} {name}" for each, name in pairs)


def front_text(found: FoundFront, plan: Plan, subject: str, fitness: str) -> Iterator[str]:
    """Yield the lines of the result."""
    yield f"{subject}: {conditions_text(found.tried, plan)}"
    yield goals_text(plan, fitness)
    yield ""
    head, rows = _table(found, plan, fitness)
    yield f"front on {counted(plan.fresh, 'fresh seed')}, intervals of {100 * plan.level:g} %:"
    yield from format_table(head, rows, 2)
    for number, name in enumerate(names_of(plan, fitness)):
        if matters := matters_text(found.observed, plan, number):
            yield f"shares of the differences in {name}: {matters}"
    yield from front_answers(found)


def front_answers(found: FoundFront) -> Iterator[str]:
    """Yield what the runs say."""
    sure = sum(each.is_certain for each in found.points)
    yield f"{counted(len(found.points), 'point')} on the front, {sure} of them for certain"
    if found.near:
        yield f"{counted(len(found.near), 'candidate')} more may be on it"
    if found.unmeasured:
        more = counted(found.unmeasured, "further candidate")
        yield f"{more} of the race had no fresh seeds; more `--seeds` tell candidates apart"
    better = [str(n) for n, each in enumerate(found.points, 1) if each.dominates_today == "yes"]
    if better:
        yield f"better than the model as it is, and worse in nothing: point {', '.join(better)}"


def _table(found: FoundFront, plan: Plan, fitness: str) -> tuple[tuple[str, ...], Rows]:
    names = [part for name in names_of(plan, fitness) for part in (name, "interval")]
    rows: Rows = []
    for number, point in enumerate(found.points, 1):
        sure = "yes" if point.is_certain else "not yet"
        settings = settings_text(point.evaluation.candidate)
        numbers = _numbers(point.evaluation, plan)
        rows.append((str(number), settings, *numbers, sure, point.dominates_today or "it is out"))
    for each in found.near:
        rows.append(("", settings_text(each.candidate), *_numbers(each, plan), "not yet", ""))
    rows.append(("", "today", *_numbers(found.today, plan), "", found.today.reason))
    return ("point", "settings", *names, "on the front", "better than today"), rows


def _numbers(each: Evaluation, plan: Plan) -> tuple[str, ...]:
    means = each.means
    if means is None:
        return ("-", "-") * len(plan.aim.objectives)
    pairs = zip(means, _intervals(each, plan), strict=True)
    return tuple(text for mean, i in pairs for text in (number_text(mean), interval_text(i)))


def _intervals(each: Evaluation, plan: Plan) -> list[Interval | None]:
    """Return the interval of the mean of each objective."""
    found = []
    for number, objective in enumerate(plan.aim.objectives):
        values = list(each.of_objective(number).values())
        sample = summary_of(values, plan.level, is_property=objective.is_property)
        found.append(sample.interval if sample is not None else None)
    return found


def front_data(found: FoundFront, plan: Plan, subject: str, fitness: str) -> dict[str, Any]:
    """Return the result as JSON types."""
    aim = plan.aim
    return {
        "subject": subject,
        "fitness": {"name": fitness},
        "objectives": [{"name": each.measure, "goal": each.goal} for each in aim.objectives],
        "method": plan.chosen,
        "scenarios": [each for each in plan.scenarios if each],
        "together": aim.together,
        "properties": list(aim.properties),
        "tried": found.tried,
        "seed": plan.seed,
        "level": plan.level,
        "front": [
            {
                **_evaluated(each.evaluation, plan),
                "certain": each.is_certain,
                "better_than_today": each.dominates_today,
            }
            for each in found.points
        ],
        "near": [_evaluated(each, plan) for each in found.near],
        "unmeasured": found.unmeasured,
        "today": _evaluated(found.today, plan),
        "importance": {
            each.measure: importance_data(found.observed, plan, number)
            for number, each in enumerate(aim.objectives)
        },
        "race": [each.as_data(aim) for each in found.finals],
    }


def _evaluated(each: Evaluation, plan: Plan) -> dict[str, Any]:
    names = [objective.measure for objective in plan.aim.objectives]
    intervals = map(interval_data, _intervals(each, plan))
    data = each.as_data(plan.aim)
    data["intervals"] = dict(zip(names, intervals, strict=True))
    data["by_seed"] = {
        str(seed): dict(zip(names, values, strict=True)) for seed, values in each.by_seed.items()
    }
    return data


def worst_of_front(found: FoundFront, plan: Plan, fitness: str) -> list[Chosen]:
    """Return the runs of a front that are worth a look: the worst in each objective that varies."""
    return [
        Chosen(f"worst {name} of point {number}", point.evaluation, objective)
        for number, point in enumerate(found.points, 1)
        for objective, name in enumerate(names_of(plan, fitness))
        if len(set(point.evaluation.of_objective(objective).values())) > 1
    ]


def front_page(
    found: FoundFront, plan: Plan, names: tuple[str, str], worst: Sequence[Worst]
) -> str:
    """Return the page of a search as HTML; `names` are those of the subject and the fitness."""
    subject, fitness = names
    facts = [
        *search_facts(plan, found.tried),
        ("objectives", goals_text(plan, fitness)),
        ("front", f"{counted(plan.fresh, 'seed')} that the search has not seen"),
        ("intervals", f"{100 * plan.level:g} %, of each number by itself"),
    ]
    head, rows = _table(found, plan, fitness)
    sections = [Section("Front", [*_figures(found, plan, fitness), text_table(head, rows)])]
    for number, name in enumerate(names_of(plan, fitness)):
        pairs = [(candidate, means[number]) for candidate, means in found.observed]
        matters = importance_section(importances(pairs, plan.space), name)
        sections += [matters] if matters is not None else []
    sections += [worst_runs(worst)] if worst else []
    return html(Page(f"Search: {subject}", facts, list(front_answers(found)), sections))


def _figures(found: FoundFront, plan: Plan, fitness: str) -> Iterator[Figure]:
    """Yield a chart for each pair of objectives."""
    names, goals = names_of(plan, fitness), [each.goal for each in plan.aim.objectives]
    caption = (
        "Numbered points are the front, with their intervals; pale ones may be on it; the other "
        "colour is the model as it is. Grey dots are candidates of the search, with few seeds."
    )
    for x, y in combinations(range(len(names)), 2):
        spots = list(_spots(found, plan, x, y))
        whole = len(names) == 2
        drawn = front_chart((names[x], names[y]), (goals[x], goals[y]), spots, is_whole=whole)
        yield Figure(drawn, caption)


def _spots(found: FoundFront, plan: Plan, x: int, y: int) -> Iterator[Spot]:
    for candidate, means in found.observed:
        yield Spot(settings_text(candidate), means[x], means[y])
    groups: Mapping[str, Sequence[Evaluation]] = {
        "front": [each.evaluation for each in found.points],
        "near": found.near,
        "today": [found.today] if found.today.means is not None else [],
    }
    for kind, evaluations in groups.items():
        for number, each in enumerate(evaluations, 1):
            means, intervals = each.means or (), _intervals(each, plan)
            title = "the model as it is" if kind == "today" else settings_text(each.candidate)
            label = str(number) if kind == "front" else ""
            yield Spot(title, means[x], means[y], intervals[x], intervals[y], kind, label)
