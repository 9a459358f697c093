"""`swarmc results`: what a folder of results has."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TextIO

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.diagnostics.render import counted
from swarmdsl.base.source import COMMAND_LINE, Source, Span
from swarmdsl.base.suggest import suggest
from swarmdsl.base.write_stream import report_unwritten, write_stream
from swarmdsl.execution.estimation.sample import Sample
from swarmdsl.execution.experiments.comparing import Comparison, Goal, compare
from swarmdsl.execution.experiments.failures import StoppedError
from swarmdsl.execution.experiments.measured import summary_of
from swarmdsl.execution.experiments.results.conditions import Condition
from swarmdsl.execution.experiments.results.export import (
    PARQUET_PACKAGE,
    parquet_bytes,
    write_csv,
)
from swarmdsl.execution.experiments.results.records import (
    FIXED,
    Record,
    grouped,
    names_of,
    read_about,
    read_records,
    shown,
)
from swarmdsl.execution.experiments.study.tables import interval, number, verdict
from swarmdsl.execution.monitor import FALSE, TRUE
from swarmdsl.execution.simulate.evaluation.summary import format_table

Tell = Callable[[Diagnostics], None]
PARQUET = ".parquet"


@dataclass(frozen=True)
class Request:
    """Arguments of the command; `pair` are the numbers of two groups to compare."""

    folder: Path
    conditions: tuple[Condition, ...] = ()
    measure: str | None = None
    pair: tuple[int, int] | None = None
    goal: Goal | None = None
    level: float = 0.95
    runs: bool = False
    export: Path | None = None
    as_json: bool = False


def show_results(request: Request, out: TextIO, tell: Tell) -> bool:
    """Show or export kept runs; return True without errors."""
    report = Diagnostics()
    about = read_about(request.folder)
    try:
        records = read_records(request.folder, about)
    except StoppedError as stopped:
        stopped.report(report)
        tell(report)
        return False
    measure = request.measure or about.measure
    _check_names(request, records, report)
    groups = grouped(records)
    for group in request.pair or ():
        if group not in groups:
            at = _on_command_line("--compare", str(group))
            help_ = f"groups have the numbers 1 to {len(groups)}" if groups else "there are no runs"
            report.report("unresolved-name", at, kind="group", name=group, help=help_)
    if report.has_errors:
        tell(report)
        return False
    kept = [each for each in records if all(c.holds(each) for c in request.conditions)]
    if request.export is not None:
        _export(request.export, kept, report)
        tell(report)
        if not report.has_errors:
            out.write(f"{counted(len(kept), 'run')} written: {request.export}\n")
        return not report.has_errors
    goal: Goal = request.goal or ("minimize" if about.goal == "minimize" else "maximize")
    if request.pair is not None:
        _compare(request, grouped(kept), measure, goal, out)
    elif request.runs:
        _show(_run_table(kept), request, out)
    else:
        _show(_group_table(kept, measure, request.level), request, out)
    if not request.as_json and request.pair is None:
        left = f" of {len(records)}" if len(kept) < len(records) else ""
        out.write(f"{len(kept)}{left} runs in {counted(len(grouped(kept)), 'group')}\n")
    return True


def _check_names(request: Request, records: Sequence[Record], report: Diagnostics) -> None:
    """Report names that no run has."""
    settings, measures, properties = names_of(records)
    known = [*FIXED, *settings, *measures, *properties]
    asked = [("--where", each.name) for each in request.conditions]
    if request.measure is not None:
        asked.append(("--measure", request.measure))
    for option, name in asked if records else ():
        if name not in known:
            help_ = suggest(name, known, "names")
            at = _on_command_line(option, name)
            report.report("unresolved-name", at, kind="setting or measure", name=name, help=help_)


def _on_command_line(option: str, text: str) -> Span:
    source = Source(COMMAND_LINE, f"{option} {text}")
    return Span(source, len(option) + 1, len(source.text))


def value(record: Record, measure: str) -> float | None:
    """Return the value of a run as a number; a property counts 1 if it is true, else 0."""
    found = record.get(measure)
    if found in (TRUE, FALSE, "open"):
        return float(found == TRUE)
    return float(found) if isinstance(found, (int, float)) else None


_Table = tuple[tuple[str, ...], list[tuple[Any, ...]]]


def _group_table(records: Sequence[Record], measure: str, level: float) -> _Table:
    settings, _, properties = names_of(records)
    head = (
        "group",
        "model",
        "scenario",
        *settings,
        measure,
        "interval",
        "median",
        "runs",
        "failed",
    )
    rows: list[tuple[Any, ...]] = []
    for group, runs in grouped(records).items():
        found = [each for run in runs if (each := value(run, measure)) is not None]
        sample = summary_of(found, level, is_property=measure in properties)
        first = runs[0]
        rows.append(
            (
                group,
                first.model,
                first.scenario,
                *(first.settings.get(name) for name in settings),
                *_summary(sample),
                len(runs),
                sum(run.failure is not None for run in runs),
            )
        )
    return head, rows


def _summary(sample: Sample | None) -> tuple[Any, ...]:
    if sample is None:
        return None, None, None
    return sample.mean, interval(sample.interval), sample.quantiles[3]


def _run_table(records: Sequence[Record]) -> _Table:
    settings, measures, properties = names_of(records)
    names = ("group", "model", "scenario", *settings, "seed", "fitness", *measures, *properties)
    head = (*names, "failure")
    return head, [tuple(record.get(name) for name in head) for record in records]


def _show(table: _Table, request: Request, out: TextIO) -> None:
    head, rows = table
    if request.as_json:
        found = [dict(zip(head, row, strict=True)) for row in rows]
        out.write(f"{json.dumps(found, indent=2)}\n")
        return
    for line in _lines(head, rows):
        out.write(f"{line}\n")


def _lines(head: tuple[str, ...], rows: Sequence[tuple[Any, ...]]) -> Iterator[str]:
    texts = [
        tuple(number(cell) if type(cell) is float else shown(cell) for cell in row) for row in rows
    ]
    # Columns without a text only take room.
    kept = [at for at in range(len(head)) if any(row[at] for row in texts)]
    cells = [tuple(row[at] for at in kept) for row in texts]
    yield from format_table(tuple(head[at] for at in kept), cells, 0)


def _compare(
    request: Request,
    groups: dict[int, list[Record]],
    measure: str,
    goal: Goal,
    out: TextIO,
) -> None:
    assert request.pair is not None
    values = [
        {
            run.seed: each
            for run in groups.get(group, ())
            if (each := value(run, measure)) is not None
        }
        for group in request.pair
    ]
    found = compare(values[0], values[1], goal, request.level)
    a, b = request.pair
    if request.as_json:
        out.write(f"{json.dumps(_as_data(found, measure, goal), indent=2)}\n")
    elif found is None:
        out.write(f"{measure}: there are no values to compare\n")
    else:
        out.write(f"{measure}, to {goal}: {a} is better than {b}: {verdict(found)}\n")


def _as_data(found: Comparison | None, measure: str, goal: Goal) -> dict[str, Any]:
    if found is None:
        return {"measure": measure, "goal": goal, "better": None}
    return {
        "measure": measure,
        "goal": goal,
        "better": found.answer,
        "difference": found.difference,
        "interval": list(found.interval) if found.interval is not None else None,
        "level": found.level,
        "paired": found.is_paired,
        "runs": found.runs,
        "effect_size": found.size,
        "superiority": found.superiority,
        "more_runs": found.more,
    }


def _export(path: Path, records: Sequence[Record], report: Diagnostics) -> None:
    content = b""
    if path.suffix.lower() == PARQUET:
        try:
            content = parquet_bytes(records)
        except ImportError:
            help_ = "`pip install 'swarmdsl[parquet]'` installs it; `.csv` needs nothing"
            what = f"--export {path}"
            report.report("missing-package", what=what, package=PARQUET_PACKAGE, help=help_)
            return
    try:
        with write_stream(path) as stream:
            if content:
                stream.buffer.write(content)
            else:
                write_csv(records, stream)
    except OSError as error:
        report_unwritten(path, error, report)
