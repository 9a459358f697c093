"""Make a machine of states, which a state then runs as its submachine.

They are those in a composite state, or some beside each other, which a new state then replaces.
Submachines are expanded, so the robot does what it did. Params of the machine and variables around
that are read inside are passed on. A transition that leaves the state ends the machine in a final
state of its own, and the state goes on from there. It is refused where a transition leads in, or a
variable around is set inside.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from swarmdsl.analysis.resolve.states import vertices
from swarmdsl.base.naming import fresh
from swarmdsl.base.records import dataclass
from swarmdsl.base.rewriting import Change
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.renaming import RefusedError
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    Activity,
    Branch,
    Defer,
    Exit,
    FinalState,
    History,
    Initial,
    Node,
    Parallel,
    Ref,
    Region,
    Send,
    State,
    StateMachine,
    Transition,
    Vertex,
    nodes_of,
    references,
    walk,
)
from swarmdsl.tools.refactor.changed_texts import applied, statement, tried
from swarmdsl.tools.refactor.common_transitions import common_transitions
from swarmdsl.tools.refactor.selected_states import Selection, selected_states
from swarmdsl.tools.refactor.shared_variables import (
    as_param,
    own_variables,
    passed_values,
    why_not_shared,
)
from swarmdsl.tools.refactor.wrap_states import new_name, why_not_wrap, wrap_states

_ITEMS = {Activity: "an activity", History: "a history"}
_BODY = re.compile(r"\s*\{")


def why_not_extract(selection: Selection) -> str | None:
    """Return the reason why no machine can be made of a state or of states; None if one can."""
    state = selection.composite
    if state is None:
        reason = why_not_wrap(selection)
        if reason is not None:
            return reason
    for item in state.items if state is not None else ():
        if type(item) in _ITEMS:
            return f"{selection.subject} has {_ITEMS[type(item)]}"
    part = _part_of(selection)
    return _crossing(part) or why_not_shared(
        selection.machine, state, part.moved, selection.subject
    )


@dataclass(frozen=True)
class _Part:
    """States that a machine is made of, and what moves with them; `entry` is entered first."""

    selection: Selection
    states: frozenset[Node]
    moved: frozenset[Node]
    entry: Node | None

    @property
    def leaving(self) -> list[tuple[Node, Ref[Any]]]:
        """The transitions that leave the states, with their targets outside."""
        return [
            (node, ref)
            for node, ref in references(self.selection.machine)
            if node in self.moved
            and isinstance(node, (Branch, Transition))
            and isinstance(ref.target, Vertex.__args__)
            and ref.target not in self.states
        ]


def _part_of(selection: Selection) -> _Part:
    """Return what moves into the machine."""
    state = selection.composite
    inside = selection.states if state is None else vertices(state)
    states = {node for item in inside for node in walk(item)}
    container = selection.container if state is None else state
    initial = next((item for item in container.items if isinstance(item, Initial)), None)
    entry = initial.target.target if initial is not None else None
    if state is not None:
        moved = {node for each in own_variables(state) for node in walk(each)}
        return _Part(selection, frozenset(states), _with(states | moved, initial), entry)
    if entry not in states:
        arrows = (Branch, History, Initial, Transition)
        entered = (
            ref.target
            for node, ref in references(selection.machine)
            if node not in states and isinstance(node, arrows) and ref.target in inside
        )
        entry = next(entered, None)
    lifted = {
        node
        for each in common_transitions(selection.states)
        for transition in each.transitions
        for node in walk(transition)
    }
    return _Part(selection, frozenset(states), frozenset(states - lifted), entry)


def _with(nodes: set[Node], more: Node | None) -> frozenset[Node]:
    return frozenset(nodes | ({*walk(more)} if more is not None else set()))


def _crossing(part: _Part) -> str | None:
    """Return the reason if something but a first entry or a last exit crosses the border."""
    selection = part.selection
    for node, ref in references(selection.machine):
        if not isinstance(ref.target, Node) or not _is_in(ref.target, selection.machine):
            continue
        if node in part.moved and ref.target not in part.states:
            if not isinstance(node, (Branch, Transition)):
                return f"`{ref.name}` is named in {selection.subject}, and not inside"
            reason = _why_not_leave(part, node)
            if reason is not None:
                return f"`{ref.name}` would be entered after {reason}"
        if node not in part.states | part.moved and ref.target in part.states:
            arrow = isinstance(node, (Branch, History, Initial, Transition))
            if arrow and ref.target is part.entry:
                continue
            if not _is_end_of(selection.composite, ref.target):
                return f"`{ref.name}` is inside, and named outside of {selection.subject}"
    return None


def _why_not_leave(part: _Part, leaving: Branch | Transition) -> str | None:
    """Return what may come between the end of the machine and the entry of the next state."""
    selection = part.selection
    if any(map(_comes_before_done, walk(selection.machine))):
        return f"events that `{selection.machine.name}` raises"
    if any(isinstance(each, Defer) for each in part.states):
        return f"events that {selection.subject} defers"
    if any(isinstance(each, (Parallel, Region)) for each in selection.around):
        return "steps of other regions"
    own = [selection.composite] if selection.composite is not None else []
    for each in (*own, *selection.around):
        items = each.items if isinstance(each, State) else ()
        if any(isinstance(item, Transition) and not item.triggers for item in items):
            return f"a transition of `{each.name}` on a guard alone"
    items = own[0].items if own else []
    if leaving.effects and any(isinstance(item, Exit) for item in items):
        return f"effects at the exit of {selection.subject}, and these after its own"
    return None


def _comes_before_done(node: Node) -> bool:
    """Return True for what may raise an event before that of a final state."""
    local = isinstance(node, Send) and (node.event.target is None or not node.event.target.swarm)
    return local and isinstance(node, Send) and node.delay is None


def _is_in(inner: Node, outer: Node) -> bool:
    one, other = inner.span.absolute, outer.span.absolute
    return one.source is other.source and other.start <= one.start and one.end <= other.end


def _is_end_of(state: State | None, final: Node) -> bool:
    """Return True for a final state of a state: `on done.Name` is the same with a machine."""
    return state is not None and isinstance(final, FinalState) and final in state.items


def extract_machine(workspace: Workspace, file: File, selection: Selection) -> dict[Path, str]:
    """Return the texts of files with a new machine; raise RefusedError if it cannot be.

    States beside each other are wrapped first, and the new state runs the machine.
    """
    reason = why_not_extract(selection)
    if reason is not None:
        raise RefusedError(reason)
    if _part_of(selection).leaving:
        _refuse_reused(workspace, selection.machine)
    if selection.composite is not None:
        return _extracted(workspace, file, selection)
    name = new_name(selection)
    wrapped = wrap_states(workspace, file, selection)
    with workspace.overriding(wrapped):
        path = file.source.path
        here = workspace.file(path) if path is not None else None
        assert here is not None  # it was there before
        machine = next(
            each
            for each in here.model.declarations
            if isinstance(each, StateMachine) and each.name == selection.machine.name
        )
        state = next(each for each in nodes_of(machine, State) if each.name == name)
        found = selected_states(here, state.name.span.absolute)
        assert found is not None  # the name of a state selects it
        return {**wrapped, **_extracted(workspace, here, found)}


def _refuse_reused(workspace: Workspace, machine: StateMachine) -> None:
    """Refuse if another machine runs this one: what is around it there may come in between."""
    for _, owner in workspace.project.declarations():
        for state in nodes_of(owner, State) if isinstance(owner, StateMachine) else ():
            if state.machine is not None and state.machine.target is machine:
                raise RefusedError(
                    f"a transition leaves, and state `{state.name}` of `{owner.name}` runs"
                    f" `{machine.name}`: its transitions may come first"
                )


def _extracted(workspace: Workspace, file: File, selection: Selection) -> dict[Path, str]:
    state, machine, text = selection.composite, selection.machine, file.source.text
    assert state is not None  # it has states
    path = file.source.path
    assert path is not None  # sources of a workspace are files
    part = _part_of(selection)
    name = fresh(f"{machine.name}{state.name}", re.findall(r"\w+", text), gap="")
    passed = passed_values(machine, part.moved)
    kept = [item for item in state.items if item not in part.moved]
    bounds = [statement(item.span.absolute) for item in kept]
    opening = _BODY.match(text, state.name.span.absolute.end)
    assert opening is not None  # a composite state has a body
    end = state.span.absolute.end - 1
    removed: list[Change] = [(*each, "") for each in bounds]
    leaving, finals = _leaving(part, text)
    body = applied(text, [*removed, *leaving], opening.end(), end)
    ends = bool(finals) or any(isinstance(each, FinalState) for each in state.items)
    head = f"{'' if ends else 'endless '}statemachine {name} {{"
    declared = [as_param(each, text) for each in passed]
    ways = [f"final {each}" for each in finals]
    whole = "\n".join([head, *declared, body.rstrip(), *ways, "}\n\n"])
    given = ", ".join(f"{one.name} = {one.name}" for one in passed)
    use = f" = {name}" + (f"({given})" if given else "")
    # They come first: a transition on `done` alone is on any end.
    items = "".join(f"\non done.{each} -> {target}" for each, target in finals.items())
    items += "".join(f"\n{text[start:end]}" for start, end in bounds)
    rest = f" {{{items}\n}}" if items else ""
    at, _ = statement(machine.span.absolute)
    changes = [
        *_entering(part, text),
        (at, at, whole),
        (state.name.span.absolute.end, state.span.absolute.end, f"{use}{rest}"),
    ]
    return tried(workspace, {path: applied(text, changes)})


def _entering(part: _Part, text: str) -> Iterator[Change]:
    """Yield the changes of paths to the first state: they end at the state around it."""
    for node, ref in references(part.selection.machine):
        if ref.target is part.entry and node not in part.states | part.moved:
            _, start, end = ref.span.absolute
            yield start + text[start:end].rindex("."), end, ""


def _leaving(part: _Part, text: str) -> tuple[list[Change], dict[str, str]]:
    """Return the changes of transitions that leave, and their targets by final states."""
    changes: list[Change] = []
    finals: dict[str, str] = {}
    names = re.findall(r"\w+", text)
    final_of: dict[object, str] = {}
    for _, ref in part.leaving:
        if ref.target is not None and ref.target not in final_of:
            final = fresh(f"To{ref.target.name}", [*names, *finals], gap="")
            final_of[ref.target], finals[final] = final, ref.name
        _, start, end = ref.span.absolute
        changes.append((start, end, final_of[ref.target]))
    return changes, finals
