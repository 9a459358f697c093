"""Support of a construct in each target, as in `swarmc targets`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache

from swarmdsl.codegen import registry
from swarmdsl.codegen.api import Generator, Mapped
from swarmdsl.driver.config import Settings
from swarmdsl.syntax.ast import (
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


def support(node: Node, settings: Settings) -> Iterator[str]:
    """Yield one line for each target of a project: its support of a construct."""
    constructs = set(_constructs(node))
    if not constructs:
        return
    for target in settings.targets or registry.default_names():
        label, rows = _mapping(target, settings.targets.get(target, {}))
        for mapped in rows:
            if mapped.construct in constructs:
                yield f"{label}: {mapped.support.value}, {mapped.means}"


def load_generators() -> None:
    """Import all generators ahead of the first hover."""
    for target in registry.default_names():
        _generator(target)


@cache
def _generator(target: str) -> Generator | None:
    found = registry.load(target)
    return found if isinstance(found, Generator) else None


def _mapping(target: str, options: Mapping[str, str]) -> tuple[str, tuple[Mapped, ...]]:
    """Return the label of a target with these options, and its mapping of constructs."""
    generator = _generator(target)
    if generator is None:
        return f"`{target}`", ()
    given = {f"{name}={value}" for name, value in options.items()}
    for option, rows in generator.mapping_with.items():
        if option in given:
            return f"`{target}` with `{option}`", rows
    return f"`{target}`", generator.mapping


def _constructs(node: Node) -> Iterator[str]:
    """Yield the names of a construct in the mapping tables."""
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
