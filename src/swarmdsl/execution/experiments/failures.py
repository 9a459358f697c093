"""Reasons to stop an experiment, for the user."""

from __future__ import annotations

from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics


class StoppedError(Exception):
    """Raised where an experiment cannot go on: a diagnostic with its fields and a way out."""

    def __init__(self, name: str, help_: str | None = None, /, **fields: Any) -> None:
        super().__init__(name)
        self.name = name
        self.help = help_
        self.fields = fields

    def report(self, report: Diagnostics) -> None:
        """Report the reason."""
        report.report(self.name, help=self.help, **self.fields)
