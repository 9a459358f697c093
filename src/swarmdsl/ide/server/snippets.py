"""Snippets: complete statements with fields to fill in."""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterator
from functools import cache
from pathlib import Path

from swarmdsl.base.read_files import read_text
from swarmdsl.base.records import dataclass
from swarmdsl.driver.workspace import Workspace
from swarmdsl.ide.server.candidates import containers
from swarmdsl.ide.server.completion import word_at
from swarmdsl.ide.server.outcomes import unhandled_outcomes
from swarmdsl.ide.server.speculative_parse import declaration_at
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import Activity, State, StateMachine

_BEGINNING = re.compile(r"(?:\A|[\n{};]|\*/)[ \t]*\Z")
# Documentation on the line above, and in a snippet.
_DOCUMENTED = re.compile(r"^[ \t]*///.*\n[ \t]*\Z", re.MULTILINE)
_DOCUMENTATION = re.compile(r"\A///.*\n")
_TABLE = Path(__file__).parent / "snippets.json"


@dataclass(frozen=True)
class Snippet:
    """Label, text in the snippet syntax of the protocol (`${1:name}`), description."""

    label: str
    text: str
    about: str


@cache
def table() -> dict[tuple[str, ...], list[Snippet]]:
    """Return all snippets by the keywords that must be possible at the cursor."""
    found: dict[tuple[str, ...], list[Snippet]] = {}
    known = json.loads(read_text(_TABLE))
    for name, each in known.items():
        snippet = Snippet(f"{name} ...", "\n".join(each["text"]), each["about"])
        found.setdefault(tuple(each["where"]), []).append(snippet)
    return found


def snippets(
    keywords: Collection[str], workspace: Workspace, file: File, offset: int
) -> Iterator[Snippet]:
    """Yield the snippets that fit at an offset, given the possible keywords.

    They are whole statements, so they fit only where one begins. Below documentation they have
    none of their own.
    """
    start, _ = word_at(file.source.text, offset)
    if _BEGINNING.search(file.source.text, 0, start) is None:
        return
    documented = _DOCUMENTED.search(file.source.text, 0, start) is not None
    for words, several in table().items():
        if all(word in keywords for word in words):
            for each in several:
                text = _DOCUMENTATION.sub("", each.text) if documented else each.text
                yield Snippet(each.label, text, each.about)
    if "on" not in keywords:
        return
    owner = declaration_at(file, offset)
    inner = containers(owner, offset)[-1] if isinstance(owner, StateMachine) else None
    if isinstance(inner, State) and any(isinstance(item, Activity) for item in inner.items):
        left = [each for each in unhandled_outcomes(owner, offset) if each != "preempted"]
        lines = [f"on {each} -> ${{{index}:Target}}" for index, each in enumerate(left, 1)]
        if lines:
            yield Snippet(
                "on the outcomes", "\n".join(lines), "transitions on all unhandled outcomes"
            )
