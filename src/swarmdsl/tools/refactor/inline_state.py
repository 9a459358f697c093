"""Dissolve a composite state: what is in it takes its place.

Transitions on events that the composite state has go to each state in it, after its own. It is
refused where a step of the machine would do something else: the composite state may have actions,
time, variables or an end of its own, or be restored or tested as a whole.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from swarmdsl.analysis.resolve.states import vertices
from swarmdsl.base.rewriting import Change
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.references import occurrences_of
from swarmdsl.driver.workspace.renaming import RefusedError
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    Activity,
    Branch,
    Defer,
    Entry,
    EventTrigger,
    Exit,
    FinalState,
    History,
    Initial,
    Parallel,
    State,
    Transition,
    Variable,
    walk,
)
from swarmdsl.tools.refactor.changed_texts import applied, statement, tried
from swarmdsl.tools.refactor.selected_states import Selection, references_to

_ITEMS = {
    Activity: "an activity",
    Defer: "deferred events",
    Entry: "effects at its entry",
    Exit: "effects at its exit",
    FinalState: "a final state",
    History: "a history",
    Variable: "variables",
}
_ARROWS = (Transition, Branch, Initial, History)
_COMMENT = re.compile(r"(?m)//+(?!/)(.*)$")
_BODY = re.compile(r"\s*\{")


def why_not_inline(selection: Selection) -> str | None:
    """Return the reason why a state cannot be dissolved; None if it can."""
    state = selection.composite
    if state is None:
        return "it is no composite state"
    for item in state.items:
        if type(item) in _ITEMS:
            return f"`{state.name}` has {_ITEMS[type(item)]}"
        if isinstance(item, Transition) and not _is_plain(item):
            return f"a transition of `{state.name}` is on more than events"
    if sum(isinstance(item, Initial) for item in state.items) != 1:
        return f"`{state.name}` has no initial state"
    if selection.shallow_history is not None:
        return f"the history `{selection.shallow_history.name}` would restore less"
    outer = {str(each.name) for level in selection.around for each in vertices(level)}
    clash = next((str(each.name) for each in vertices(state) if str(each.name) in outer), None)
    if clash is not None:
        return f"there is another state `{clash}` around `{state.name}`"
    if any(not isinstance(node, _ARROWS) for node, _ in references_to(selection.machine, state)):
        return f"an expression is about `{state.name}`"
    transitions = any(isinstance(item, Transition) for item in state.items)
    if transitions and any(isinstance(each, Defer) for each in walk(state)):
        return f"states in `{state.name}` defer events"
    return None


def _is_plain(transition: Transition) -> bool:
    events = all(isinstance(each, EventTrigger) for each in transition.triggers)
    return events and bool(transition.triggers) and not transition.internal


def inline_state(workspace: Workspace, file: File, selection: Selection) -> dict[Path, str]:
    """Return the texts of files without the state; raise RefusedError if not possible."""
    reason = why_not_inline(selection)
    if reason is not None:
        raise RefusedError(reason)
    state, path, text = selection.composite, file.source.path, file.source.text
    assert state is not None  # it has no reason not to be
    assert path is not None  # sources of a workspace are files
    beginning = next(item for item in state.items if isinstance(item, Initial))
    elsewhere: dict[Path, list[Change]] = {path: []}
    changes = elsewhere[path]
    in_machine = {ref.span.absolute.start for _, ref in references_to(selection.machine, state)}
    for each in occurrences_of(state, workspace):
        source, start, end = each.span
        if each.declares:
            continue
        assert source.path is not None
        if source.text.startswith(".", end):
            elsewhere.setdefault(source.path, []).append((start, end + 1, ""))
        elif source.path != path or not _is_in(each.span, selection.machine.span.absolute):
            raise RefusedError(f"`{state.name}` is named outside of its machine")
        elif start in in_machine or text.startswith(".", start - 1):
            changes.append((start, end, beginning.target.name))
    added = list(_transitions(state, text, changes))
    body = _body(state, text, [*changes, *added])
    bounds = statement(state.span.absolute)
    above = re.sub(r"(?m)^(\s*)///", r"\1//", text[bounds[0] : state.span.absolute.start])
    rest = text[state.span.absolute.end : bounds[1]].lstrip(" \t;")
    whole = "\n".join(filter(None, (above.rstrip() + "\n" if above.strip() else "", body, rest)))
    others = [each for each in changes if each[1] <= bounds[0] or bounds[1] <= each[0]]
    texts = {
        each: applied(other.source.text, made)
        for each, made in elsewhere.items()
        if (other := workspace.file(each)) is not None
    }
    texts[path] = applied(text, [*others, (*bounds, whole)])
    return tried(workspace, texts)


def _transitions(state: State, text: str, changes: list[Change]) -> Iterator[Change]:
    """Yield the insertions of the transitions of a state into the states in it."""
    transitions = [item for item in state.items if isinstance(item, Transition)]
    for inner in vertices(state):
        if not isinstance(inner, (State, Parallel)):
            continue
        lines = [
            applied(text, changes, *statement(each.span.absolute))
            for each in transitions
            if not _is_shadowed(each, inner)
        ]
        if not lines:
            continue
        span = inner.span.absolute
        added = "\n".join(lines)
        if text[span.end - 1] == "}":
            yield span.end - 1, span.end - 1, f"\n{added}\n"
        else:
            yield span.end, span.end, f" {{\n{added}\n}}"


def _is_shadowed(transition: Transition, inner: State | Parallel) -> bool:
    """Return True if a state always takes its own transition on the same events."""
    own = [each for each in inner.items if isinstance(each, Transition) and each.guard is None]
    names = {
        trigger.event.target
        for each in own
        for trigger in each.triggers
        if isinstance(trigger, EventTrigger)
    }
    triggers = (each for each in transition.triggers if isinstance(each, EventTrigger))
    return all(each.event.target in names for each in triggers)


def _body(state: State, text: str, changes: list[Change]) -> str:
    """Return what is between the braces of a state, without its own initial and transitions."""
    opening = _BODY.match(text, state.name.span.absolute.end)
    assert opening is not None  # a composite state has a body
    removed = []
    for item in state.items:
        if isinstance(item, Transition):
            removed.append((*statement(item.span.absolute), ""))
        elif isinstance(item, Initial):
            # Its documentation would be that of the next state.
            start, end = statement(item.span.absolute)
            found = _COMMENT.findall(text[start:end])
            removed.append((start, end, "\n".join(f"//{each}" for each in found) + "\n"))
    kept = [
        each
        for each in changes
        if not any(start <= each[0] and each[1] <= end for start, end, _ in removed)
    ]
    inside = applied(text, [*kept, *removed], opening.end(), state.span.absolute.end - 1)
    return inside.strip("\n").lstrip(" \t;") if inside.strip() else ""


def _is_in(inner: Span, outer: Span) -> bool:
    return outer.start <= inner.start and inner.end <= outer.end
