"""Page of a search: where it went, the winner beside today's model, and its worst runs."""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import tomli

from swarmdsl.base.diagnostics.render import counted
from swarmdsl.execution.experiments.designs.factors import Value
from swarmdsl.execution.experiments.report.coordinates import Scored
from swarmdsl.execution.experiments.report.page import Page, html
from swarmdsl.execution.experiments.report.search import Search, Worst, search_sections
from swarmdsl.execution.experiments.search.evaluation import Evaluation
from swarmdsl.execution.experiments.search.optimizing import Found, Plan
from swarmdsl.execution.experiments.search.report import settings_text
from swarmdsl.execution.experiments.settings import merged
from swarmdsl.execution.experiments.study.tables import number, verdict
from swarmdsl.execution.experiments.task import Candidate
from swarmdsl.execution.experiments.toml_text import toml_text
from swarmdsl.execution.simulate.durations import SECOND, duration

_MOST_WORST = 3
Line = Mapping[str, Any]
"""Line of the history."""


def search_page(
    found: Found,
    plan: Plan,
    names: tuple[str, str],
    history: Sequence[Line],
    worst: Sequence[Worst],
) -> str:
    """Return the page of a search as HTML; `names` are those of the subject and the fitness."""
    subject, fitness = names
    scenarios = ", ".join(each for each in plan.scenarios if each)
    facts = [
        ("search", f"{counted(found.tried, 'candidate')}, method {plan.chosen}"),
        ("scenario", scenarios or "none"),
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
    )
    answers = list(_answers(found))
    return html(Page(f"Search: {subject}", facts, answers, list(search_sections(search))))


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


def worst_runs(
    found: Found, plan: Plan, texts: Mapping[str, str], words: Sequence[str], folder: Path
) -> tuple[list[Worst], dict[Path, str]]:
    """Return the worst runs of the winner, and the scenarios in a folder that play them.

    `texts` are the scenarios by name, `words` those of the command before its options.
    """
    scenarios = {
        folder / f"{number}.toml": toml_text(
            merged(found.winner.candidate, tomli.loads(texts.get(name, "")))
        )
        for number, name in enumerate(plan.scenarios, 1)
    }
    by_value = sorted(
        found.winner.values.items(), key=lambda pair: (-plan.aim.loss(pair[1]), pair[0])
    )
    runs = [
        Worst(
            "worst run of the winner",
            seed,
            value,
            shlex.join([*words, "--scenario", str(path), "--seed", str(seed)]),
        )
        for seed, value in by_value[:_MOST_WORST]
        for path in scenarios
    ]
    return runs, scenarios
