"""Influence of groups of robots on others, by the messages that they send."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from swarmdsl.execution.verify.swarm.groups import Group
from swarmdsl.execution.verify.swarm.model import Model


class Influences:
    """The groups that can send each group a message."""

    def __init__(self, model: Model, groups: Sequence[Group]) -> None:
        self._groups = groups
        self._senders = [
            (number, sent, more)
            for number, group in enumerate(groups)
            for sent, more in ((sent_by(group), model.may_send(group)),)
            if sent or more
        ]
        self._found: dict[int, set[int]] = {}

    def on(self, number: int) -> set[int]:
        """Return the groups that can send a group a message; of few groups anybody asks."""
        found = self._found.get(number)
        if found is None:
            group = self._groups[number]
            listens = group.automaton.whole.kind.listens
            found = self._found[number] = {
                other
                for other, sent, more in self._senders
                if any(map(listens, more))
                or any(group.hears(message, self._groups[other]) for message in sent)
            }
        return found


def cone(model: Model, groups: Sequence[Group], about: Iterable[int]) -> list[Group]:
    """Return the groups that can influence some of them."""
    sources = Influences(model, groups)
    found = set(about)
    todo = list(found)
    while todo:
        for each in sources.on(todo.pop()) - found:
            found.add(each)
            todo.append(each)
    return [group for number, group in enumerate(groups) if number in found]


def apart(model: Model, groups: Sequence[Group]) -> Iterator[list[Group]]:
    """Yield groups that exchange messages together, independent ones apart.

    A robot that no other one influences stands for all of its group.
    """
    sources = Influences(model, groups)
    left = set(range(len(groups)))
    while left:
        part = {min(left)}
        grown = True
        while grown:
            more = {
                n
                for n in left - part
                if sources.on(n) & part or any(n in sources.on(m) for m in part)
            }
            grown = bool(more)
            part |= more
        left -= part
        if len(part) == 1 and not sources.on(min(part)):
            (only,) = part
            yield [Group(groups[only].automaton, groups[only].robots[:1])]
        else:
            yield [groups[number] for number in sorted(part)]


def sent_by(group: Group) -> set[int]:
    """Return the messages that a robot of a group was seen to send."""
    return {message for move in group.automaton.whole.every_move() for message in move.sends}
