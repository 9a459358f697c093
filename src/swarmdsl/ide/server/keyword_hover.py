"""Hover of keywords: the beginning of their section in the language reference.

`keyword_sections.json` has these sections, by heading; a test writes it from `docs/language.md`
(`make bless`).
"""

from __future__ import annotations

import json
import re
from functools import cache
from pathlib import Path

from swarmdsl.base.read_files import read_text
from swarmdsl.base.source import Span
from swarmdsl.ide.server.code import find_tokens
from swarmdsl.project.loader import File

SECTIONS = {
    **dict.fromkeys(("sensor", "actuator", "controller", "virtual", "inout", "out"), "Component"),
    **dict.fromkeys(("do", "gives", "succeeded", "aborted", "preempted"), "Activity"),
    **dict.fromkeys(("on", "after", "monitor", "done"), "Transition"),
    **dict.fromkeys(("and", "or", "not", "true", "false"), "Expressions"),
    **dict.fromkeys(("statemachine", "endless", "var"), "State machine"),
    **dict.fromkeys(("state", "entry", "exit"), "State"),
    **dict.fromkeys(("parallel", "region"), "Parallel state"),
    **dict.fromkeys(("choice", "else"), "Choice"),
    **dict.fromkeys(("member", "behavior"), "Member"),
    "action": "Action",
    "communication": "Communication",
    "connect": "Connectors",
    "const": "Constant",
    "enum": "Enum",
    "environment": "Environment",
    "event": "Event",
    "extends": "Inheritance",
    "final": "Final state",
    "fitness": "Fitness",
    "function": "Function",
    "history": "History",
    "import": "Import",
    "initial": "Composite state",
    "message": "Message",
    "operation": "Operation",
    "optimize": "Optimization",
    "package": "Package",
    "param": "Param",
    "property": "Property",
    "self": "The robot itself",
    "send": "Between robots",
    "service": "Service",
    "struct": "Struct",
    "swarm": "Swarm",
    "type": "Type alias",
}
"""Headings in the language reference, by keyword; `in` has too many meanings."""

TABLE = Path(__file__).parent / "keyword_sections.json"
_TOKEN = re.compile(r'"(?:\\.|[^"\\\n])*"|//[^\n]*|/\*|[.]?[A-Za-z_]\w*')


def keyword_at(file: File, offset: int) -> tuple[Span, str] | None:
    """Return the keyword at an offset, and the beginning of its section as Markdown."""
    text = file.source.text
    line = text.rfind("\n", 0, offset) + 1
    # Comments can begin lines above.
    for at, word in find_tokens(text, _TOKEN):
        if at > offset:
            break
        heading = SECTIONS.get(word)
        if heading is not None and at >= line and offset <= at + len(word):
            return Span(file.source, at, at + len(word)), _sections()[heading]
    return None


@cache
def _sections() -> dict[str, str]:
    found: dict[str, str] = json.loads(read_text(TABLE))
    return found
