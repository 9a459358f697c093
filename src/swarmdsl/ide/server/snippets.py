"""Whole statements with places to fill in, offered where their first word can stand."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterator
from functools import cache
from pathlib import Path

from swarmdsl.base.records import dataclass
from swarmdsl.driver.workspace import Workspace
from swarmdsl.ide.server.candidates import containers
from swarmdsl.ide.server.outcomes import outcomes_left
from swarmdsl.ide.server.speculative_parse import owner_around
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import Activity, State, StateMachine

_TABLE = Path(__file__).parent / "snippets.json"


@dataclass(frozen=True)
class Snippet:
    """A text as editors fill it in (`${1:so}`), what it is called, what it is for."""

    label: str
    text: str
    about: str


@cache
def table() -> dict[tuple[str, ...], list[Snippet]]:
    """All snippets, by the words that must be possible at a place."""
    found: dict[tuple[str, ...], list[Snippet]] = {}
    known = json.loads(_TABLE.read_text(encoding="utf-8"))
    for name, each in known.items():
        snippet = Snippet(f"{name} ...", "\n".join(each["text"]), each["about"])
        found.setdefault(tuple(each["where"]), []).append(snippet)
    return found


def snippets(
    keywords: Collection[str], workspace: Workspace, file: File, offset: int
) -> Iterator[Snippet]:
    """The statements that can stand at an offset of a file, where these keywords can."""
    for words, several in table().items():
        if all(word in keywords for word in words):
            yield from several
    if "on" not in keywords:
        return
    owner = owner_around(file, offset)
    inner = containers(owner, offset)[-1] if isinstance(owner, StateMachine) else None
    if isinstance(inner, State) and any(isinstance(item, Activity) for item in inner.items):
        left = [each for each in outcomes_left(owner, offset) if each != "preempted"]
        lines = [f"on {each} -> ${{{index}:Target}}" for index, each in enumerate(left, 1)]
        if lines:
            yield Snippet(
                "on the outcomes", "\n".join(lines), "transitions on all ends that are left"
            )
