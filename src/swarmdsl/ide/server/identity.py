"""Fields of `self`, for completion and hover, and facts about events."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.base.source import Span
from swarmdsl.ide.server.fields import facts_of, is_of_member
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import FieldUse, NameUse, TopLevel, nodes_of
from swarmdsl.syntax.types import SELF_FIELDS

_MEANINGS = {
    "id": "The name of the robot in the swarm, such as `uav[0]`.",
    "role": "The role of the robot in the swarm, such as `uav`.",
    "index": "The number of the robot in its role, from 0.",
    "count": "The number of robots in the role, as started.",
}
_FACTS = {
    "sender": "The robot that sent the event, by its id; empty for an event from outside.",
    "sent": "The time at which the event was sent.",
}
_OF_MEMBER = {
    "id": "The name of the robot that joined or was lost, such as `uav[0]`.",
    "role": "The role of the robot that joined or was lost, such as `uav`.",
}
_ALL = "The robot that runs the state machine: its `id`, `role`, `index` and `count`."


def own_fields() -> dict[str, str]:
    """Return the type of each field."""
    return {name: str(type_) for name, type_ in SELF_FIELDS.items()}


def is_own(use: FieldUse) -> bool:
    """Return True for a field of `self`."""
    return isinstance(use.base, NameUse) and use.base.name == "self"


def described_at(owner: TopLevel, offset: int, project: Project) -> tuple[Span, str] | None:
    """Return `self`, its field or a fact about an event at an offset; its meaning as Markdown."""
    for span, text in [*_described(owner), *_facts(owner, project)]:
        if span.start <= offset <= span.end:
            return span, text
    return None


def _facts(owner: TopLevel, project: Project) -> Iterator[tuple[Span, str]]:
    for use in nodes_of(owner, FieldUse):
        if use.name in _FACTS and use.name in (facts := facts_of(use, owner, project)):
            declared = f"```swarm\nevent.{use.name} : {facts[use.name]}\n```"
            yield use.name.span.absolute, f"{declared}\n\n{_FACTS[use.name]}"
        elif use.name in _OF_MEMBER and is_of_member(use, owner, project):
            declared = f"```swarm\nevent.{use.name} : {SELF_FIELDS[use.name]}\n```"
            yield use.name.span.absolute, f"{declared}\n\n{_OF_MEMBER[use.name]}"


def _described(owner: TopLevel) -> Iterator[tuple[Span, str]]:
    for use in nodes_of(owner, FieldUse):
        if is_own(use) and use.name in SELF_FIELDS:
            declared = f"```swarm\nself.{use.name} : {SELF_FIELDS[use.name]}\n```"
            yield use.name.span.absolute, f"{declared}\n\n{_MEANINGS[use.name]}"
    for name in nodes_of(owner, NameUse):
        if name.name == "self":
            yield name.span.absolute, _ALL
