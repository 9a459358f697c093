"""Names that somebody gives on the command line: whether a model can have them."""

from __future__ import annotations

import re

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.naming import camel_case, snake_case
from swarmdsl.base.source import COMMAND_LINE, Source, Span
from swarmdsl.syntax.parser.keywords import RESERVED

_CAMEL = re.compile(r"[A-Z][A-Za-z0-9]*")
_SNAKE = re.compile(r"[a-z][a-z0-9_]*")


def command_line_span(text: str) -> Span:
    """The place of what stands on the command line, to show it as it is written."""
    source = Source(COMMAND_LINE, text)
    return Span(source, 0, len(text))


def check_type_name(name: str, kind: str, report: Diagnostics) -> None:
    """Report a name that is no `LikeThis`: of a swarm, a member or a component.

    In the model that begins with it, a role or part is called the same in lower case.
    """
    better = camel_case(name)
    small = snake_case(name)
    if not _CAMEL.fullmatch(name) or name in RESERVED:
        usable = _CAMEL.fullmatch(better) is not None
        _report(name, kind, f"call it `{better}`" if usable else "write it `LikeThis`", report)
    elif small in RESERVED:
        _report(name, kind, f"`{small}` is a word of the language: say more", report)


def check_project_name(name: str, report: Diagnostics) -> None:
    """Report a name that neither a package of the model nor one of ROS can have."""
    package = snake_case(name)
    if name != package and name != package.replace("_", "-"):
        usable = _SNAKE.fullmatch(package) is not None and package not in RESERVED
        _report(name, "a project", f"call it `{package}`" if usable else _HOW, report)
    elif not _SNAKE.fullmatch(package) or package in RESERVED:
        _report(name, "a project", _HOW, report)


_HOW = "write it `like_this`, with letters first, and no word of the language"


def _report(name: str, kind: str, way: str, report: Diagnostics) -> None:
    report.report(
        "bad-name", command_line_span(name), name=name, what=f"the name of {kind}", help=way
    )
