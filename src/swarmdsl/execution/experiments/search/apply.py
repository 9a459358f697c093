"""Write a candidate of a search into the model."""

from __future__ import annotations

from typing import Any

import click
import tomli

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.experiments.applying import apply_to_model
from swarmdsl.execution.experiments.failures import StoppedError
from swarmdsl.execution.experiments.search.problem import Problem
from swarmdsl.execution.experiments.settings import keys_of
from swarmdsl.execution.experiments.task import Candidate
from swarmdsl.execution.simulate.machines.subject import Subject


def apply_candidate_of(problem: Problem, candidate: Candidate, report: Diagnostics) -> None:
    """Write a candidate into the model, and show what changes."""
    try:
        _require_free(candidate, problem)
        changed = problem.plan.space.changed(candidate)
        layouts = apply_to_model(problem.paths, problem.subject.name, changed, report)
    except StoppedError as stopped:
        stopped.report(report)
        return
    for layout in layouts:
        click.echo(layout.diff(), nl=False, err=True)
    if not layouts and not report.has_errors:
        click.echo("the model has these values already", err=True)


def _require_free(winner: Candidate, problem: Problem) -> None:
    """Raise StoppedError if a scenario has its own value of a setting, which the model has not.

    A value for one robot is no matter: runs of the search had it too.
    """
    for path, text in problem.shipment.scenarios.items():
        values = tomli.loads(text)
        for name, value in winner.settings:
            for keys in _places_of(name, problem.subject):
                given: Any = values
                for key in keys:
                    given = given.get(key) if isinstance(given, dict) else None
                if given is None or given == value:
                    continue
                key = ".".join(keys)
                help_ = f"remove `{key}` there, or write {value} there"
                reason = f"`{path}` says `{key}` itself, for all runs with it"
                raise StoppedError("cannot-apply", help_, name=problem.subject.name, reason=reason)


def _places_of(setting: str, subject: Subject) -> list[tuple[str, ...]]:
    """Return the keys of a setting in a scenario: under the role, and under its type."""
    keys = keys_of(setting)
    assert subject.swarm is not None
    member = next((each.member for each in subject.swarm.roles if each.name == keys[1]), None)
    if keys[0] != "params" or member is None:
        return [keys]
    return [keys, (keys[0], member.rpartition(".")[2], *keys[2:])]
