"""Diagnostics of fields that a message does not have."""

from __future__ import annotations

from collections.abc import Collection

from swarmdsl.base.diagnostics.advice import only
from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import did_you_mean


def report_unknown_field(
    owner: str,
    name: str,
    at: Span,
    fields: Collection[str],
    report: Diagnostics,
    facts: Collection[str] = (),
) -> None:
    """Report a field that is missing in a message, with the existing fields.

    `facts` are the fields that the event has whatever its message.
    """
    if not report.wants_hint("unknown-field"):
        report.report("unknown-field", at, owner=owner, name=name)
        return
    names = [*fields, *facts]
    has = f"it has {listed([*fields], 'and')}" if fields else "it has no fields"
    if facts:
        has += f"; the event itself has {listed([*facts], 'and')}"
    help_ = did_you_mean(name, names) or only(has, names)
    report.report("unknown-field", at, owner=owner, name=name, help=help_)
