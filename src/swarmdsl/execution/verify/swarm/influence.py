"""Influence of groups of robots on others, by the messages that they send."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from swarmdsl.execution.verify.swarm.groups import Group
from swarmdsl.execution.verify.swarm.model import Model


def influences(model: Model, groups: Sequence[Group]) -> list[set[int]]:
    """Return for each group those that can send it a message."""
    sent = list(map(sent_by, groups))
    more = [model.may_send(each) for each in groups]
    return [
        {
            other
            for other, source in enumerate(groups)
            if any(map(group.automaton.whole.kind.listens, more[other]))
            or any(group.hears(message, source) for message in sent[other])
        }
        for group in groups
    ]


def cone(model: Model, groups: Sequence[Group], about: Iterable[int]) -> list[Group]:
    """Return the groups that can influence some of them."""
    sources = influences(model, groups)
    found = set(about)
    todo = list(found)
    while todo:
        for each in sources[todo.pop()] - found:
            found.add(each)
            todo.append(each)
    return [group for number, group in enumerate(groups) if number in found]


def apart(model: Model, groups: Sequence[Group]) -> Iterator[list[Group]]:
    """Yield groups that exchange messages together, independent ones apart.

    A robot that no other one influences stands for all of its group.
    """
    sources = influences(model, groups)
    left = set(range(len(groups)))
    while left:
        part = {min(left)}
        grown = True
        while grown:
            more = {
                n for n in left - part if sources[n] & part or any(n in sources[m] for m in part)
            }
            grown = bool(more)
            part |= more
        left -= part
        if len(part) == 1 and not sources[next(iter(part))]:
            (only,) = part
            yield [Group(groups[only].automaton, groups[only].robots[:1])]
        else:
            yield [groups[number] for number in sorted(part)]


def sent_by(group: Group) -> set[int]:
    """Return the messages that a robot of a group was seen to send."""
    return {message for move in group.automaton.whole.every_move() for message in move.sends}
