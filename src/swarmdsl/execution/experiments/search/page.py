"""Page of a search: where it went, the winner beside today's model, and its worst runs."""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import tomli

from swarmdsl.base.diagnostics.render import counted
from swarmdsl.base.records import dataclass
from swarmdsl.execution.experiments.designs.factors import Value
from swarmdsl.execution.experiments.report.coordinates import Scored
from swarmdsl.execution.experiments.report.importance import importance_section
from swarmdsl.execution.experiments.report.page import Page, html
from swarmdsl.execution.experiments.report.search import FRESH, Search, Worst, search_sections
from swarmdsl.execution.experiments.search.evaluation import Evaluation
from swarmdsl.execution.experiments.search.importance import importances
from swarmdsl.execution.experiments.search.optimizing import Found, Plan
from swarmdsl.execution.experiments.settings import merged
from swarmdsl.execution.experiments.study.tables import number, verdict
from swarmdsl.execution.experiments.task import Candidate, settings_text
from swarmdsl.execution.experiments.toml_text import toml_text
from swarmdsl.execution.simulate.scenario.durations import SECOND, duration

_MOST_WORST = 3
Line = Mapping[str, Any]
"""Line of the history."""


def search_facts(plan: Plan, tried: int) -> list[tuple[str, str]]:
    """Return facts that begin each page of a search."""
    scenarios = ", ".join(each for each in plan.scenarios if each)
    return [
        ("search", f"{counted(tried, 'candidate')}, method {plan.chosen}"),
        ("scenario", scenarios or "none"),
    ]


def search_page(
    found: Found,
    plan: Plan,
    names: tuple[str, str],
    history: Sequence[Line],
    worst: Sequence[Worst],
) -> str:
    """Return the page of a search as HTML; `names` are those of the subject and the fitness."""
    subject, fitness = names
    facts = [
        *search_facts(plan, found.tried),
        ("measured", f"{fitness}, to {plan.aim.goal}"),
        ("winner and today", f"{counted(plan.fresh, 'seed')} that the search has not seen"),
        ("intervals", f"{100 * plan.level:g} %"),
    ]
    search = Search(
        fitness,
        plan.aim.goal,
        list(_candidates(history, plan, found)),
        list(found.winner.values.values()),
        list(found.today.values.values()) if not found.today.broken else [],
        plan.level,
        worst,
        plan.aim.is_property,
    )
    answers = list(_answers(found))
    sections = list(search_sections(search))
    first = [(candidate, means[0]) for candidate, means in found.observed]
    matters = importance_section(importances(first, plan.space), fitness)
    if matters is not None:
        at = next((n for n, each in enumerate(sections) if each.title == FRESH), len(sections))
        sections.insert(at, matters)
    return html(Page(f"Search: {subject}", facts, answers, sections))


def _answers(found: Found) -> Iterator[str]:
    winner = found.winner
    yield f"the winner is {settings_text(winner.candidate)}: {_mean(winner)} in the mean"
    if found.comparison is not None:
        yield f"the winner is better than the model as it is: {verdict(found.comparison)}"
    elif found.today.broken:
        yield f"the model as it is, is out: {found.today.reason}"


def _mean(each: Evaluation) -> str:
    return number(each.mean) if each.mean is not None else "-"


def _candidates(history: Sequence[Line], plan: Plan, found: Found) -> Iterator[Scored]:
    """Yield each candidate with what is known of it last, in the order of the search."""
    latest: dict[str, Line] = {}
    for line in history:
        if line.get("stage") in ("search", "race"):
            latest[Candidate.of(line["candidate"]).text] = line
    today = {each.name: each.today_value for each in plan.space.dimensions}
    for text, line in latest.items():
        kind = "today" if line["candidate"] == today else ""
        kind = "best" if text == found.winner.candidate.text else kind
        settings = {name: _plain(value) for name, value in line["candidate"].items()}
        yield Scored(settings, line["value"], kind)


def _plain(value: Value) -> Value:
    """Return a time in seconds, and anything else as it is."""
    time = duration(value) if isinstance(value, str) else None
    return value if time is None else time / SECOND


@dataclass(frozen=True)
class Chosen:
    """Runs to show: so many of the worst ones of a candidate, by an objective."""

    why: str
    evaluation: Evaluation
    objective: int = 0
    most: int = 1


def worst_of_winner(found: Found) -> list[Chosen]:
    """Return the runs of a winner that are worth a look."""
    return [Chosen("worst run of the winner", found.winner, 0, _MOST_WORST)]


def worst_runs(
    chosen: Sequence[Chosen],
    plan: Plan,
    texts: Mapping[str, str],
    words: Sequence[str],
    folder: Path,
) -> tuple[list[Worst], dict[Path, str]]:
    """Return the worst runs, and the scenarios in a folder for the commands that play them.

    `texts` are the scenarios by name, `words` those of the command before its options.
    """
    paths: dict[tuple[str, str], Path] = {}
    scenarios: dict[Path, str] = {}
    runs = []
    for each in chosen:
        candidate, objective = each.evaluation.candidate, plan.aim.objectives[each.objective]
        values = each.evaluation.of_objective(each.objective)
        by_loss = [(-objective.loss(value), seed) for seed, value in values.items()]
        for name in plan.scenarios:
            path = folder / f"{len(paths) + 1}.toml"
            path = paths.setdefault((candidate.text, name), path)
            scenarios[path] = toml_text(merged(candidate, tomli.loads(texts.get(name, ""))))
        for _, seed in sorted(by_loss)[: each.most]:
            for name in plan.scenarios:
                path = paths[candidate.text, name]
                page = str(path.with_name(f"{path.stem}-{seed}.html"))
                given = ("--scenario", str(path), "--play", page, "--seed", str(seed))
                command = shlex.join([*words, *given])
                runs.append(Worst(each.why, seed, values[seed], command))
    return runs, scenarios
