"""Verdicts with their conditions as JSON, and as JUnit XML for CI."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics, Severity
from swarmdsl.base.records import dataclass, field
from swarmdsl.execution.junit import Case, Remark, Suite, document
from swarmdsl.execution.verify.findings.finding import Finding
from swarmdsl.execution.verify.proofs.verdict import Verdict
from swarmdsl.execution.verify.report.diagnostics import code_of, rows

_REFUTED = "refuted-property"


@dataclass(frozen=True)
class Results:
    """Results of the command; `findings` and `runs`, the written files, by the names of runs.

    Properties are proved for any number of members of the roles `free`, with at most
    so many `faults`: robots that are lost. `open` says what may be wrong, though no run shows it.
    """

    subject: str
    sizes: tuple[Mapping[str, int], ...]
    conditions: tuple[str, ...]
    verdicts: tuple[Verdict, ...]
    findings: Mapping[str, Finding]
    runs: Mapping[str, Path]
    free: tuple[str, ...] = ()
    faults: int = 0
    open: tuple[str, ...] = ()
    worst_at: Mapping[str, Mapping[str, int]] = field(default_factory=dict)
    """If several sizes were looked at, the one of each verdict."""


def as_document(results: Results) -> str:
    """Return the results as a document of JSON."""
    values = {
        "subject": results.subject,
        "sizes": [dict(each) for each in results.sizes],
        **({"any": list(results.free)} if results.free else {}),
        **({"lost": results.faults} if results.faults else {}),
        "conditions": list(results.conditions),
        "properties": [_property(each, results) for each in results.verdicts],
        "findings": [_finding(*each, results.runs) for each in results.findings.items()],
        **({"open": list(results.open)} if results.open else {}),
    }
    return f"{json.dumps(values, indent=2)}\n"


def _property(verdict: Verdict, results: Results) -> dict[str, Any]:
    fails, up_to = verdict.outcome == "fails", verdict.outcome == "up to"
    size = verdict.size or results.worst_at.get(verdict.property.name)
    size = size if verdict.outcome != "holds" else None
    return {
        "name": verdict.property.name,
        "verdict": "holds up to" if up_to else verdict.outcome,
        **({"states": verdict.states} if up_to else {}),
        **({"member": verdict.robot} if fails and verdict.robot is not None else {}),
        **({"size": dict(size)} if size is not None else {}),
        **({"reason": verdict.reason} if verdict.reason else {}),
        **({"open": list(verdict.open)} if verdict.open else {}),
        **_written(verdict.property.name, results.runs),
        **_loop(verdict),
    }


def _loop(verdict: Verdict) -> dict[str, int]:
    loop = verdict.run.loop if verdict.run is not None else None
    return {"loop": loop} if loop is not None else {}


def _finding(name: str, finding: Finding, runs: Mapping[str, Path]) -> dict[str, Any]:
    values = {"code": code_of(finding), "name": finding.name}
    if finding.role:
        values["role"] = finding.role
    return {**values, **_written(name, runs)}


def _written(name: str, runs: Mapping[str, Path]) -> dict[str, str]:
    return {"run": runs[name].as_posix()} if name in runs else {}


def junit(results: Results | None, report: Diagnostics) -> str:
    """Return a suite with a case for each property, and for each other error.

    A property that is neither shown nor refuted is skipped; warnings are output.
    """
    name = results.subject if results is not None else "model"
    cases = list(_properties(results, report)) if results is not None else []
    output = []
    for found in report:
        if found.name == _REFUTED:
            continue
        if found.severity is Severity.ERROR:
            cases.append(Case(found.message, name, remark=Remark.of("error", [found])))
        else:
            output.append(f"{_place(found)}{found.severity.value}[{found.code}]: {found.message}")
    if results is not None:
        output += (f"condition: {each}" for each in results.conditions)
    return document("swarmc verify", [Suite(name, tuple(cases), tuple(output))])


def _properties(results: Results, report: Diagnostics) -> Iterator[Case]:
    refuted = [each for each in report if each.name == _REFUTED]
    told = rows(results.verdicts, results.faults, results.worst_at)
    shown = zip(results.verdicts, told, strict=True)
    for verdict, (name, outcome, reason) in shown:
        remark = None
        if verdict.outcome == "fails":
            origin = verdict.property.origin
            found = [each for each in refuted if each.primary and each.primary.span == origin]
            remark = Remark.of("failure", found, _REFUTED)
        elif verdict.outcome != "holds":
            remark = Remark("skipped", f"{outcome}: {reason}" if reason else outcome)
        yield Case(name, results.subject, remark=remark)


def _place(found: Diagnostic) -> str:
    if found.primary is None:
        return ""
    span = found.primary.span
    return f"{span.source.name}:{span.line}: "
