"""Apply a candidate to a scenario: its settings replace what the file says."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import COMMAND_LINE, Source, Span
from swarmdsl.driver.config.toml import Document, Keys, Place
from swarmdsl.execution.experiments.task import COUNT, SCENARIO, Candidate
from swarmdsl.execution.simulate.inputs.scenario_file import read_scenario
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.scenario import Scenario

EMPTY = Document(Source(COMMAND_LINE, ""), {})
"""Document of runs without a scenario."""


class _Places(dict[Keys, Place]):
    """Places of a document; settings of a candidate are at the candidate itself."""

    def __init__(self, known: dict[Keys, Place], candidate: Candidate) -> None:
        super().__init__(known)
        text = candidate.text
        span = Span(Source(COMMAND_LINE, text), 0, len(text))
        self._place = Place(span, span)

    def __missing__(self, _keys: Keys) -> Place:
        return self._place


def keys_of(setting: str) -> tuple[str, ...]:
    """Return the keys of a setting in a scenario."""
    if setting.startswith(COUNT):
        return "count", setting.removeprefix(COUNT)
    if setting.startswith(SCENARIO):
        return tuple(setting.removeprefix(SCENARIO).split("."))
    word, _, param = setting.rpartition(".")
    return "params", word, param


def merged(candidate: Candidate, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the values of a scenario with the settings of a candidate in them."""
    found: dict[str, Any] = copy.deepcopy(dict(values))
    for name, value in candidate.settings:
        *above, last = keys_of(name)
        table = found
        for key in above:
            inner = table.get(key)
            table[key] = table = inner if isinstance(inner, dict) else {}
        table[last] = value
    return found


def apply_candidate(
    candidate: Candidate, document: Document, subject: Subject, report: Diagnostics
) -> Scenario | None:
    """Return the scenario with the settings of a candidate; None if it has mistakes."""
    values = merged(candidate, document.values)
    places = _Places(document.places, candidate)
    for name, _ in candidate.settings:
        keys = keys_of(name)
        for known in [each for each in places if each[: len(keys)] == keys]:
            del places[known]
    found = read_scenario(Document(document.source, values, places), subject, report)
    return found if not report.has_errors else None
