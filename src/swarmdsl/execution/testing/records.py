"""Tests, their results and their coverage as plain data, for programs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostic, Label
from swarmdsl.base.diagnostics.render.json_lines import as_json, place_as_json
from swarmdsl.base.source import Span
from swarmdsl.execution.simulate.evaluation.coverage import Coverage, Key, place_of
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.world.line import as_text
from swarmdsl.execution.testing.case import Case, InvalidTest
from swarmdsl.execution.testing.outline import Outlined
from swarmdsl.execution.testing.selection import id_of
from swarmdsl.execution.testing.verdict import Verdict

Record = dict[str, Any]


def end_record(problems: Iterable[Diagnostic], passed: bool) -> Record:
    """Return the end, with what is wrong with the run as a whole."""
    return {"type": "end", "passed": passed, "problems": _problems(problems)}


def file_record(path: Path, read: bool, problems: Iterable[Diagnostic]) -> Record:
    """Return a test file; it is not `read` if its mistakes keep all of its tests from running."""
    return {
        "type": "file",
        "file": path.as_posix(),
        "read": read,
        "problems": _problems(problems),
    }


def listed_record(path: Path, name: str, case: Case | InvalidTest | Outlined) -> Record:
    """Return a test in a list; what is not known for its mistakes is None."""
    known = case if isinstance(case, Case) else None
    return {
        "type": "test",
        **_identity(path, name, case.place),
        "subject": _subject(known.subject) if known is not None else None,
        "seeds": len(known.seeds) if known is not None else None,
        "problems": _problems(case.problems if isinstance(case, InvalidTest) else ()),
    }


def started_record(path: Path, name: str, case: Case) -> Record:
    """Return a test that starts."""
    return {"type": "started", **_identity(path, name, case.place)}


def unread_record(
    path: Path, name: str, case: InvalidTest | Outlined, problems: Sequence[Diagnostic]
) -> Record:
    """Return the result of a test that could not run; a model with errors reports them once."""
    return {
        "type": "result",
        **_identity(path, name, case.place),
        "outcome": "unread",
        "problems": _problems(problems),
    }


def result_record(
    path: Path, name: str, verdict: Verdict, problems: Sequence[Diagnostic]
) -> Record:
    """Return the result of a test, with its first failure and what led to it."""
    failure = None if verdict.passed else next(iter(verdict.failures.values()), None)
    expected = failure.fields.get("expected") if failure is not None else None
    return {
        "type": "result",
        **_identity(path, name, verdict.case.place),
        "outcome": "passed" if verdict.passed else "failed",
        "seconds": round(verdict.seconds, 6),
        "seeds": len(verdict.seeds),
        "failed_seeds": list(verdict.failures),
        "skipped": verdict.skipped,
        "problems": _problems(problems),
        "expected": expected,
        "actual": failure.label if failure is not None and expected is not None else None,
        "trace": [as_text(line) for line in failure.last] if failure is not None else [],
    }


def coverage_records(coverage: Coverage) -> Iterator[Record]:
    """Yield a record for each machine, with its states and transitions and where they are."""
    for machine in coverage.machines:
        origins = machine.origins
        yield {
            "type": "coverage",
            "machine": machine.name,
            "states": _elements(machine.states, machine.entered, origins),
            "transitions": _elements(machine.transitions, machine.taken, origins),
        }


def _elements(
    words: Mapping[Key, str], reached: set[Key], origins: Mapping[Key, object]
) -> list[Record]:
    places = {key: place_of(origins[key]) for key in words}
    return [
        {
            **place_as_json(Label(place) if place is not None else None),
            "name": said,
            "reached": key in reached,
        }
        for key, said in words.items()
        for place in (places[key],)
    ]


def _identity(path: Path, name: str, place: Span) -> Record:
    line, column = place.source.line_column(place.start)
    return {
        "id": id_of(path, name),
        "name": name,
        "file": path.as_posix(),
        "line": line,
        "column": column,
    }


def _subject(subject: Subject) -> Record:
    return {"kind": "machine" if subject.swarm is None else "swarm", "name": subject.name}


def _problems(problems: Iterable[Diagnostic]) -> list[Record]:
    return [as_json(each) for each in problems]
