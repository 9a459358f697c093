"""Running activities and delays of a robot in a fixed order, and where they are after a move."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

from swarmdsl.execution.engine import Event, Run
from swarmdsl.execution.verify.automata.labels import Carried, Slot
from swarmdsl.execution.verify.robot.body import Body
from swarmdsl.execution.verify.robot.tasks import Delay, Input


class Occupied(NamedTuple):
    """A slot with its task; equal labels tell that two robots in one state have the same task."""

    slot: Slot
    label: Any
    task: object


def occupied(body: Body, shown: Callable[[Event], Any]) -> list[Occupied]:
    """Return the slots of a body; `shown` returns what decides of an event that waits."""
    found = []
    numbers: dict[tuple[int, int | str], int] = {}
    for (kind, actor, key), task in body.all_tasks():
        if isinstance(task, Run):
            found.append(Occupied(Slot(kind, actor, key, task.activity.name), (actor, key), task))
        elif isinstance(task, Delay):
            order = numbers.get((actor, key), 0)
            numbers[actor, key] = order + 1
            message = task.timer.message
            label = (actor, key, repr(message and shown(message)))
            found.append(Occupied(Slot(kind, actor, key, "", order), label, task))
    return found


def carried(
    before: Sequence[Occupied], after: Sequence[Occupied], labels: Sequence[Any]
) -> tuple[Carried, ...]:
    """Return where the tasks of a state come from; `labels` are those of its slots in order."""
    sources = {id(each.task): number for number, each in enumerate(before)}
    return tuple(_carried(sources, each.task) for each in _in_order(after, labels))


def slot_of(slots: Sequence[Slot], given: Input) -> int | None:
    """Return the number of the slot of the task that an input ends, None if it ends none."""
    wanted: tuple[Any, ...]
    if given.kind == "end":
        wanted = ("end", given.actor, given.choice[0], 0)
    elif given.kind == "time":
        wanted = ("time", given.actor, given.name, given.choice)
    else:
        return None
    return next(
        number
        for number, each in enumerate(slots)
        if (each.kind, each.actor, each.key, each.order) == wanted
    )


def _carried(sources: dict[int, int], task: object) -> Carried:
    source = sources.get(id(task))
    is_new = source is None and isinstance(task, Delay)
    return Carried(source, task.length if is_new and isinstance(task, Delay) else None)


def _in_order(after: Sequence[Occupied], labels: Sequence[Any]) -> Iterator[Occupied]:
    left = list(after)
    for label in labels:
        found = next(each for each in left if each.label == label)
        left.remove(found)
        yield found
