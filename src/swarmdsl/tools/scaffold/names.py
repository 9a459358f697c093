"""Check names given on the command line."""

from __future__ import annotations

import re

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.naming import camel_case, snake_case
from swarmdsl.base.source import COMMAND_LINE, Source, Span
from swarmdsl.syntax.parser.keywords import RESERVED

_CAMEL = re.compile(r"[A-Z][A-Za-z0-9]*")
_SNAKE = re.compile(r"[a-z][a-z0-9_]*")


def command_line_span(text: str) -> Span:
    """Span of a command-line argument, to quote it in a diagnostic."""
    source = Source(COMMAND_LINE, text)
    return Span(source, 0, len(text))


def check_type_name(name: str, kind: str, report: Diagnostics) -> None:
    """Report a name of a swarm, member or component that is not in CamelCase.

    The template uses the name in snake_case for a role or part, so that must not be a keyword.
    """
    camel = camel_case(name)
    snake = snake_case(name)
    if not _CAMEL.fullmatch(name) or name in RESERVED:
        usable = _CAMEL.fullmatch(camel) is not None
        _report(name, kind, f"use `{camel}`" if usable else "write it in `CamelCase`", report)
    elif snake in RESERVED:
        _report(name, kind, f"`{snake}` is a keyword: choose another name", report)


def check_project_name(name: str, report: Diagnostics) -> None:
    """Report a name that is no valid name of a `.swarm` package or of a ROS package."""
    package = snake_case(name)
    if name != package and name != package.replace("_", "-"):
        usable = _SNAKE.fullmatch(package) is not None and package not in RESERVED
        _report(name, "a project", f"use `{package}`" if usable else _SNAKE_CASE_HINT, report)
    elif not _SNAKE.fullmatch(package) or package in RESERVED:
        _report(name, "a project", _SNAKE_CASE_HINT, report)


_SNAKE_CASE_HINT = "write it in `snake_case`, beginning with a letter; keywords are reserved"


def _report(name: str, kind: str, hint: str, report: Diagnostics) -> None:
    report.report(
        "bad-name", command_line_span(name), name=name, what=f"the name of {kind}", help=hint
    )
