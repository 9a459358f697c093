"""Kept runs as CSV and as Parquet: a line a run."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence
from io import BytesIO
from typing import Any, TextIO

from swarmdsl.execution.experiments.results.records import Record, names_of, shown

PARQUET_PACKAGE = "arro3-io"
_WHOLE = 2**63
"""Greatest whole number of a column, and one more."""


def write_csv(records: Sequence[Record], stream: TextIO) -> None:
    """Write runs with all their settings, measures and verdicts; a value that is missing is empty.

    Numbers have all their digits. A text that a spreadsheet would take for a formula begins with
    an apostrophe.
    """
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow([_cell(each) for each in _head(records)])
    for values in _rows(records):
        writer.writerow([_cell(each) for each in values])


def parquet_bytes(records: Sequence[Record]) -> bytes:
    """Return runs as a file of Parquet; a value that is missing is null.

    A column has one type: boolean, integer, number or text. Raises ImportError without a writer.
    """
    from arro3.core import Array, DataType, Table
    from arro3.io import write_parquet

    types = {
        bool: DataType.bool(),
        int: DataType.int64(),
        float: DataType.float64(),
        str: DataType.utf8(),
    }
    columns, head = list(zip(*_rows(records), strict=True)), _head(records)
    arrays = []
    for values in columns or [()] * len(head):
        kind = _kind(values)
        arrays.append(Array([_fit(each, kind) for each in values], types[kind]))
    buffer = BytesIO()
    write_parquet(Table.from_arrays(arrays, names=_different(head)), buffer)
    return buffer.getvalue()


def _head(records: Sequence[Record]) -> list[str]:
    settings, measures, properties = names_of(records)
    head = ("model", "scenario", *settings, "seed", "fitness", *measures, *properties)
    return [*head, "failure", "seconds"]


def _rows(records: Sequence[Record]) -> Iterator[tuple[Any, ...]]:
    settings, measures, properties = names_of(records)
    for record in records:
        yield (
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


def _cell(value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (int, float)):
        return repr(value)
    text = str(value)
    return f"'{text}" if text[:1] in ("=", "+", "-", "@", "\t", "\r") else text


def _kind(values: Sequence[Any]) -> type:
    """Return the type that all values of a column have or can be given."""
    kinds = {type(each) for each in values if each is not None}
    if kinds == {int} and all(-_WHOLE <= each < _WHOLE for each in values if each is not None):
        return int
    if kinds and kinds <= {int, float}:
        return float
    return bool if kinds == {bool} else str


def _fit(value: Any, kind: type) -> Any:
    if value is None or type(value) is kind:
        return value
    return float(value) if kind is float else shown(value)


def _different(names: Sequence[str]) -> list[str]:
    """Return names without a repetition, which readers refuse."""
    found: dict[str, None] = {}
    for name in names:
        free, number = name, 2
        while free in found:
            free, number = f"{name} {number}", number + 1
        found[free] = None
    return list(found)
