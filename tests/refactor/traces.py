"""Comparison of a machine before and after a refactoring: traces, comments, layout."""

import random
import re
from collections import Counter
from contextlib import suppress

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.naming import snake_case
from swarmdsl.base.source import Source
from swarmdsl.execution.engine import LoopError
from swarmdsl.ir import System
from swarmdsl.syntax.formatter import format_source

from ..agreement.engines import Ours, Step
from ..agreement.scripts import Model, Subject


def behaviours(before: System, after: System, name: str, gone: str) -> int:
    """Compare a machine in two systems step by step; `gone` is a state that one has in between."""
    one, other = (
        next(each for each in system.machines if each.name == name) for system in (before, after)
    )
    first, second = Subject(one, before), Subject(other, after)

    def plain(state: str) -> str:
        return ".".join(part for part in state.split(".") if part != gone)

    renamed = {plain(state.id): state.id for state in other.walk() if plain(state.id)}
    compared, prefix = 0, f"{snake_case(gone)}_" if gone else ""
    for steps in map(first.walk, map(random.Random, range(2))):
        left, right = Model(first), Model(second)
        for step in steps:
            assert told(left, plain) == told(right, plain, prefix)
            left.take(step)
            run = (renamed[plain(step.run[0])], step.run[1]) if step.run is not None else None
            right.take(Step(step.event, step.data, run, step.time, step.sender, step.sent))
            compared += 1
        assert told(left, plain) == told(right, plain, prefix)
    return compared


def told(model: Ours, plain, prefix: str = "") -> object:
    """All states that are active, but for the one in between, and the values of variables."""
    active = {plain(state) for state in Ours.active.fget(model)} - {""}
    return active, repr(model.instance.data).replace(prefix, "")


def comments(text: str) -> Counter[str]:
    return Counter(each.strip() for each in re.findall(r"//+(.*)", text))


def behaviour(before: System, after: System, name: str, gone: str) -> None:
    with suppress(LoopError):  # a machine by chance may not come to rest
        behaviours(before, after, name, gone)


def check_text(text: str, original: str) -> None:
    assert format_source(Source("", text), Diagnostics()) == text
    assert comments(text) == comments(original)
