"""Fields of `self`, for completion and hover."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import FieldUse, NameUse, TopLevel, nodes_of
from swarmdsl.syntax.types import SELF_FIELDS

_MEANINGS = {
    "id": "The name of the robot in the swarm, such as `uav[0]`.",
    "role": "The role of the robot in the swarm, such as `uav`.",
    "index": "The number of the robot in its role, from 0.",
    "count": "The number of robots in the role, as started.",
}
_ALL = "The robot that runs the state machine: its `id`, `role`, `index` and `count`."


def own_fields() -> dict[str, str]:
    """Return the type of each field."""
    return {name: str(type_) for name, type_ in SELF_FIELDS.items()}


def is_own(use: FieldUse) -> bool:
    """Return True for a field of `self`."""
    return isinstance(use.base, NameUse) and use.base.name == "self"


def described_at(owner: TopLevel, offset: int) -> tuple[Span, str] | None:
    """Return `self` or its field at an offset, and its meaning as Markdown."""
    for span, text in _described(owner):
        if span.start <= offset <= span.end:
            return span, text
    return None


def _described(owner: TopLevel) -> Iterator[tuple[Span, str]]:
    for use in nodes_of(owner, FieldUse):
        if is_own(use) and use.name in SELF_FIELDS:
            declared = f"```swarm\nself.{use.name} : {SELF_FIELDS[use.name]}\n```"
            yield use.name.span.absolute, f"{declared}\n\n{_MEANINGS[use.name]}"
    for name in nodes_of(owner, NameUse):
        if name.name == "self":
            yield name.span.absolute, _ALL
