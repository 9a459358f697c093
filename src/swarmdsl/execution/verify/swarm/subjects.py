"""Groups of robots that a property is about."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from swarmdsl import ir
from swarmdsl.execution.verify.swarm.groups import Group
from swarmdsl.execution.verify.swarm.model import Model
from swarmdsl.execution.verify.swarm.propositions import facts_of, roles_of


def place_of(me: str | None, groups: Sequence[Group]) -> int | None:
    """Return the number of the group of one robot, None if there is none."""
    return next((n for n, g in enumerate(groups) if me is not None and g.robots == (me,)), None)


DEADLINES = "when a missed deadline is told is not looked at: it ends what happens at one moment"
"""Reason why a property is not decided that holds but for the steps of missed deadlines."""


def expects_in_time(model: Model, groups: Sequence[Group]) -> bool:
    """Return True if a robot of some groups is told that an event has missed its deadline."""
    expected = [
        event.name
        for event in model.system.events
        if event.delivery is not None and event.delivery.deadline is not None
    ]
    return any(any(map(group.automaton.whole.kind.listens, expected)) for group in groups)


def about(property_: ir.Property, model: Model, groups: Sequence[Group]) -> Iterator[int]:
    """Yield the groups that the facts of a property are about."""
    for fact in facts_of(property_):
        roles = roles_of(fact, property_)
        for number, group in enumerate(groups):
            if isinstance(fact, ir.Fact) and fact.act == "arrives":
                if fact.name in group.automaton.whole.kind.outside.messages:
                    yield number
            elif isinstance(fact, ir.Fact) and fact.robots is None and property_.each is not None:
                continue
            elif not roles or group.role in roles:
                yield number
