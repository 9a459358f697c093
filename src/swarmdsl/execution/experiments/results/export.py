"""Kept runs as CSV: a line a run."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from typing import Any, TextIO

from swarmdsl.execution.experiments.results.records import Record, names_of


def write_csv(records: Sequence[Record], stream: TextIO) -> None:
    """Write runs with all their settings, measures and verdicts; a value that is missing is empty.

    Numbers have all their digits. A text that a spreadsheet would take for a formula begins with
    an apostrophe.
    """
    settings, measures, properties = names_of(records)
    writer = csv.writer(stream, lineterminator="\n")
    head = ("model", "scenario", *settings, "seed", "fitness", *measures, *properties)
    writer.writerow([_cell(each) for each in (*head, "failure", "seconds")])
    for record in records:
        values = (
            record.model,
            record.scenario,
            *(record.settings.get(name) for name in settings),
            record.seed,
            record.fitness,
            *(record.measures.get(name) for name in measures),
            *(record.verdicts.get(name) for name in properties),
            record.failure,
            record.seconds,
        )
        writer.writerow([_cell(each) for each in values])


def _cell(value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (int, float)):
        return repr(value)
    text = str(value)
    return f"'{text}" if text[:1] in ("=", "+", "-", "@", "\t", "\r") else text
