"""Error at one place of an interface file."""

from __future__ import annotations

from swarmdsl.base.source import Span


class InterfaceError(Exception):
    """A line that cannot be parsed; the reader of the file catches and reports it."""

    def __init__(self, span: Span, message: str, help: str | None = None) -> None:  # noqa: A002
        super().__init__(message)
        self.span = span
        self.message = message
        self.help = help
