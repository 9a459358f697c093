"""SARIF 2.1.0, for code scanning and editors: one document for all diagnostics."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any, TextIO

from swarmdsl import __version__
from swarmdsl.base.diagnostics import explain
from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.base.diagnostics.collector import Diagnostic, Fix, Label
from swarmdsl.base.diagnostics.render.places import uri
from swarmdsl.base.source import Span

_SCHEMA = (
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
)


def render(found: Iterable[Diagnostic], stream: TextIO) -> None:
    """Write the document; without diagnostics it has no results."""
    diagnostics = list(found)
    names = sorted({one.name for one in diagnostics}, key=lambda name: CODES[name].code)
    rules = {name: index for index, name in enumerate(names)}
    driver = {
        "name": "swarmc",
        "semanticVersion": __version__,
        "rules": [_rule(name) for name in names],
    }
    run = {
        "tool": {"driver": driver},
        "columnKind": "unicodeCodePoints",
        "results": [_result(one, rules[one.name]) for one in diagnostics],
    }
    json.dump({"$schema": _SCHEMA, "version": "2.1.0", "runs": [run]}, stream, indent=2)
    stream.write("\n")


def _rule(name: str) -> dict[str, Any]:
    entry = CODES[name]
    page = explain.page(entry.code)
    return {
        "id": entry.code,
        "name": name,
        "shortDescription": {"text": name.replace("-", " ")},
        "fullDescription": {"text": _meaning(page)},
        "help": {"text": page, "markdown": page},
        "defaultConfiguration": {
            "level": entry.severity,
            **({"enabled": False} if entry.silent else {}),
        },
    }


def _meaning(page: str) -> str:
    """Return the first section of a page, in one line."""
    _, _, rest = page.partition("## What it means\n")
    return " ".join(rest.partition("\n## ")[0].split())


def _result(diagnostic: Diagnostic, rule: int) -> dict[str, Any]:
    remarks = [f"note: {note}" for note in diagnostic.notes]
    if diagnostic.help is not None:
        remarks.append(f"help: {diagnostic.help}")
    result: dict[str, Any] = {
        "ruleId": diagnostic.code,
        "ruleIndex": rule,
        "level": diagnostic.severity.value,
        "message": {"text": "\n".join((diagnostic.message, *remarks))},
    }
    if diagnostic.primary is not None and not diagnostic.primary.span.on_command_line:
        result["locations"] = [_location(diagnostic.primary)]
    if diagnostic.related:
        result["relatedLocations"] = [
            {"id": number, **_location(label)} for number, label in enumerate(diagnostic.related)
        ]
    if diagnostic.fixes:
        result["fixes"] = [_fix(fix) for fix in diagnostic.fixes]
    return result


def _fix(fix: Fix) -> dict[str, Any]:
    replacements: dict[str, list[dict[str, Any]]] = {}
    for span, text in fix.edits:
        replacement = {"deletedRegion": _region(span), "insertedContent": {"text": text}}
        replacements.setdefault(span.source.name, []).append(replacement)
    changes = [
        {"artifactLocation": {"uri": uri(name)}, "replacements": made}
        for name, made in replacements.items()
    ]
    return {"description": {"text": fix.title}, "artifactChanges": changes}


def _region(span: Span) -> dict[str, int]:
    source, start, end = span
    line, column = source.line_column(start)
    end_line, end_column = source.line_column(end)
    return {
        "startLine": line,
        "startColumn": column,
        "endLine": end_line,
        "endColumn": end_column,
    }


def _location(label: Label) -> dict[str, Any]:
    location: dict[str, Any] = {
        "physicalLocation": {
            "artifactLocation": {"uri": uri(label.span.source.name)},
            "region": _region(label.span),
        }
    }
    if label.message:
        location["message"] = {"text": label.message}
    return location
