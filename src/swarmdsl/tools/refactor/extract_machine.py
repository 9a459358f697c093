"""Make a machine of what is in a composite state, which then runs it as its submachine.

Submachines are expanded, so the robot does what it did. Params of the machine that are used inside
are passed on. A transition that leaves the state ends the machine in a final state of its own, and
the state goes on from there. It is refused where a transition leads in, or variables are shared.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from swarmdsl.analysis.resolve.states import vertices
from swarmdsl.base.naming import fresh
from swarmdsl.base.rewriting import Change
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.renaming import RefusedError
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    Activity,
    Branch,
    Defer,
    FinalState,
    Initial,
    NameUse,
    Node,
    Param,
    Ref,
    Send,
    State,
    StateMachine,
    Transition,
    Variable,
    Vertex,
    references,
    walk,
)
from swarmdsl.tools.refactor.changed_texts import applied, statement, tried
from swarmdsl.tools.refactor.selected_states import Selection

_BODY = re.compile(r"\s*\{")


def why_not_extract(selection: Selection) -> str | None:
    """Return the reason why no machine can be made of a state; None if one can."""
    state = selection.composite
    if state is None:
        return "it is no composite state"
    for item in state.items:
        if isinstance(item, Variable):
            return f"`{state.name}` has variables"
        if isinstance(item, Activity):
            return f"`{state.name}` has an activity"
    states = {node for item in vertices(state) for node in walk(item)}
    beginning = (item for item in state.items if isinstance(item, Initial))
    moved = states | {node for item in beginning for node in walk(item)}
    for node, ref in references(selection.machine):
        if not isinstance(ref.target, Node) or not _is_in(ref.target, selection.machine):
            continue
        if node in moved and ref.target not in states:
            if not isinstance(node, (Branch, Transition)):
                return f"`{ref.name}` is named in `{state.name}`, and not inside"
            if any(map(_comes_before_done, states)):
                return f"`{ref.name}` would be entered after events that `{state.name}` raises"
        known = _is_end_of(state, ref.target) or _begins(node, ref, state)
        if node not in moved and ref.target in states and not known:
            return f"`{ref.name}` is inside, and named outside of `{state.name}`"
    for node in moved:
        variable = node.target if isinstance(node, NameUse) else None
        if isinstance(variable, Variable) and not _is_in(variable, state):
            return f"`{variable.name}` is a variable of `{selection.machine.name}`"
    return None


def _comes_before_done(node: Node) -> bool:
    """Return True for what may raise an event before that of a final state."""
    local = isinstance(node, Send) and (node.event.target is None or not node.event.target.swarm)
    return local or isinstance(node, Defer)


def _is_in(inner: Node, outer: Node) -> bool:
    one, other = inner.span.absolute, outer.span.absolute
    return one.source is other.source and other.start <= one.start and one.end <= other.end


def _is_end_of(state: State, final: Node) -> bool:
    """Return True for a final state of a state: `on done.Name` is the same with a machine."""
    return isinstance(final, FinalState) and final in state.items


def _begins(node: Node, ref: Ref[Any], state: State) -> bool:
    """Return True for a path to the initial state of a state: it leads to the state as well."""
    beginning = next((item for item in state.items if isinstance(item, Initial)), None)
    return (
        beginning is not None
        and isinstance(node, (Branch, Initial, Transition))
        and ref.target is beginning.target.target
        and ref.span.text.endswith(f"{state.name}.{beginning.target.name}")
    )


def extract_machine(workspace: Workspace, file: File, selection: Selection) -> dict[Path, str]:
    """Return the texts of files with a new machine; raise RefusedError if it cannot be."""
    reason = why_not_extract(selection)
    if reason is not None:
        raise RefusedError(reason)
    state, machine, text = selection.composite, selection.machine, file.source.text
    assert state is not None  # it has no reason not to be
    path = file.source.path
    assert path is not None  # sources of a workspace are files
    name = fresh(f"{machine.name}{state.name}", re.findall(r"\w+", text), gap="")
    params = list(_params(state, machine))
    kept = [item for item in state.items if not isinstance(item, (Initial, *_vertex_kinds(state)))]
    bounds = [statement(item.span.absolute) for item in kept]
    opening = _BODY.match(text, state.name.span.absolute.end)
    assert opening is not None  # a composite state has a body
    end = state.span.absolute.end - 1
    removed: list[Change] = [(*each, "") for each in bounds]
    leaving, finals = _leaving(state, machine, text)
    body = applied(text, [*removed, *leaving], opening.end(), end)
    ends = bool(finals) or any(isinstance(each, FinalState) for each in state.items)
    head = f"{'' if ends else 'endless '}statemachine {name} {{"
    declared = [text[one.span.absolute.start : one.type.span.absolute.end] for one in params]
    ways = [f"final {each}" for each in finals]
    whole = "\n".join([head, *declared, body.rstrip(), *ways, "}\n\n"])
    given = ", ".join(f"{one.name} = {one.name}" for one in params)
    use = f" = {name}" + (f"({given})" if given else "")
    # They come first: a transition on `done` alone is on any end.
    items = "".join(f"\non done.{each} -> {target}" for each, target in finals.items())
    items += "".join(f"\n{text[start:end]}" for start, end in bounds)
    rest = f" {{{items}\n}}" if items else ""
    at, _ = statement(machine.span.absolute)
    entering = [ref for node, ref in references(machine) if _begins(node, ref, state)]
    changes = [
        *(
            (ref.span.absolute.start + ref.span.text.rindex("."), ref.span.absolute.end, "")
            for ref in entering
        ),
        (at, at, whole),
        (state.name.span.absolute.end, state.span.absolute.end, f"{use}{rest}"),
    ]
    return tried(workspace, {path: applied(text, changes)})


def _leaving(state: State, machine: StateMachine, text: str) -> tuple[list[Change], dict[str, str]]:
    """Return the changes of transitions that leave a state, and their targets by final states."""
    inside = {node for item in vertices(state) for node in walk(item)}
    changes: list[Change] = []
    finals: dict[str, str] = {}
    names = re.findall(r"\w+", text)
    final_of: dict[object, str] = {}
    for node, ref in references(machine):
        is_arrow = node in inside and isinstance(node, (Branch, Transition))
        if not is_arrow or not isinstance(ref.target, Vertex.__args__) or ref.target in inside:
            continue
        if ref.target not in final_of:
            final = fresh(f"To{ref.target.name}", [*names, *finals], gap="")
            final_of[ref.target], finals[final] = final, ref.name
        _, start, end = ref.span.absolute
        changes.append((start, end, final_of[ref.target]))
    return changes, finals


def _vertex_kinds(state: State) -> tuple[type[Node], ...]:
    return tuple({type(each) for each in vertices(state)})


def _params(state: State, machine: StateMachine) -> Iterator[Param]:
    """Yield the params of a machine that are used in a state, in the order of the machine."""
    used = {
        node.target
        for item in vertices(state)
        for node in walk(item)
        if isinstance(node, NameUse) and isinstance(node.target, Param)
    }
    return (item for item in machine.items if isinstance(item, Param) and item in used)
