"""What becomes of a construct in the targets, as `swarmc targets` says it."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

from swarmdsl import plugins
from swarmdsl.generator import Generator, Mapped
from swarmdsl.syntax import (
    Activity,
    Choice,
    Communication,
    FinalState,
    Function,
    History,
    Initial,
    Node,
    Parallel,
    State,
    Variable,
)


def support(node: Node) -> Iterator[str]:
    """A line for each target that says what it makes of a construct."""
    wanted = set(_constructs(node))
    for target in plugins.default_names() if wanted else ():
        for mapped in _mapping(target):
            if mapped.construct in wanted:
                yield f"`{target}`: {mapped.support.value}, {mapped.means}"


def prepare() -> None:
    """Import the targets, for which whoever asks first would have to wait."""
    for target in plugins.default_names():
        _mapping(target)


@cache
def _mapping(target: str) -> tuple[Mapped, ...]:
    generator = plugins.load(target)
    return generator.mapping if isinstance(generator, Generator) else ()


def _constructs(node: Node) -> Iterator[str]:
    """What a construct is called there."""
    match node:
        case State(machine=machine, items=items):
            activity = next((item for item in items if isinstance(item, Activity)), None)
            inside = any(isinstance(item, (Initial, State, Parallel)) for item in items)
            if machine is not None or inside:
                yield "composite state, submachine"
            elif activity is None:
                yield "state without activity"
            else:
                yield f"state with {_call(activity)}"
        case Parallel():
            yield "parallel state"
        case FinalState():
            yield "final state"
        case Choice():
            yield "choice"
        case History(deep=deep):
            yield "deep history" if deep else "history"
        case Variable():
            yield "variable"


def _call(activity: Activity) -> str:
    function = activity.function.target
    items = function.items if isinstance(function, Function) else ()
    call = next((item for item in items if isinstance(item, Communication)), None)
    return "an action" if call is not None and call.paradigm == "action" else "a service"
