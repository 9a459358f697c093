"""Move states that are beside each other into a new composite state.

Transitions on events that all of them have at their end become transitions of the new state, which
has nothing else, so each step of the machine does what it did. It is refused where it would not: a
final state would end another state, and a history would restore less.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import takewhile
from pathlib import Path

from swarmdsl.base.naming import fresh
from swarmdsl.base.rewriting import Change
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.references import occurrences_of
from swarmdsl.driver.workspace.renaming import RefusedError
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import FinalState, History, Initial, State, Vertex
from swarmdsl.tools.refactor.changed_texts import (
    applied,
    comments_of,
    removal,
    statement,
    tried,
)
from swarmdsl.tools.refactor.common_transitions import Common, common_transitions
from swarmdsl.tools.refactor.selected_states import Selection

_WORD = re.compile(r"_*(?:[A-Z]+(?![a-z])|[A-Z]?[a-z]+|[0-9]+)")


def why_not_wrap(selection: Selection) -> str | None:
    """Return the reason why states cannot be moved into a composite state; None if they can."""
    for each in selection.states:
        if isinstance(each, FinalState):
            return f"the final state `{each.name}` ends what it is in"
        if isinstance(each, History):
            return f"the history `{each.name}` restores what it is in"
    if not any(isinstance(each, State) for each in selection.states) and len(selection.states) < 2:
        return "it is no state that can be left"
    if selection.shallow_history is not None:
        name = selection.shallow_history.name
        return f"the history `{name}` would restore the new state, but not the states in it"
    return None


def new_name(selection: Selection) -> str:
    """Return a name for the new state, which nothing in the machine has.

    `SearchLeft` and `SearchRight` are wrapped in `Search`, states without a common word in
    `AscendGroup` if `Ascend` is entered first.
    """
    taken = set(re.findall(r"\w+", selection.machine.span.text))
    names = [str(each.name) for each in selection.states]
    words = zip(*map(_WORD.findall, names), strict=False)
    common = (each[0] for each in takewhile(lambda each: len(set(each)) == 1, words))
    name = "".join(common).rstrip("_0123456789")
    if name and name not in taken:
        return name
    initial = (each.target.name for each in selection.container.items if isinstance(each, Initial))
    states = [str(each.name) for each in selection.states if isinstance(each, State)] or names
    stem = name or next((each for each in initial if each in names), states[0])
    return fresh(f"{stem}_group" if stem.islower() else f"{stem}Group", taken, gap="")


def wrap_states(workspace: Workspace, file: File, selection: Selection) -> dict[Path, str]:
    """Return the texts of files with the states in a new one; raise RefusedError if not."""
    reason = why_not_wrap(selection)
    if reason is not None:
        raise RefusedError(reason)
    path = file.source.path
    assert path is not None  # sources of a workspace are files
    name = new_name(selection)
    changes: dict[Path, list[Change]] = {path: []}
    entered: list[Vertex] = []
    inside = [each.span.absolute for each in selection.states]
    beginning = next((i for i in selection.container.items if isinstance(i, Initial)), None)
    first = beginning.target.span.absolute if beginning is not None else None
    begins_here = False
    for state in selection.states:
        for each in occurrences_of(state, workspace):
            source, start, end = each.span
            assert source.path is not None
            if each.declares:
                continue
            if first is not None and source.path == path and start == first.start:
                begins_here = True
                entered.insert(0, state)
                continue
            within = source.path == path and any(s.start <= start and end <= s.end for s in inside)
            if within and not source.text.startswith(".", start - 1):
                continue  # a name is looked up beside the states first
            changes.setdefault(source.path, []).append((start, start, f"{name}."))
            if not within:
                entered.append(state)
    if begins_here and first is not None:
        initial = first.text
        changes[path].append((first.start, first.end, name))
    else:
        states = (each for each in selection.states if isinstance(each, State))
        initial = str((entered or [next(states, selection.states[0])])[0].name)
    texts = {
        each: applied(other.source.text, made)
        for each, made in changes.items()
        if (other := workspace.file(each)) is not None
    }
    texts[path] = _moved(file.source.text, selection, changes[path], name, initial)
    return tried(workspace, texts)


def _moved(text: str, selection: Selection, changes: list[Change], name: str, initial: str) -> str:
    """Return the text of the file with the states in the new one, where the first of them was."""
    lifted = common_transitions(selection.states)
    inner = [*changes, *_without(selection, lifted)]
    bounds = [statement(each.span.absolute) for each in selection.states]
    states = "\n\n".join(applied(text, inner, *each) for each in bounds)
    states += "".join(f"\n\n{_lifted(text, each)}" for each in lifted)
    others = [
        (first, last, new)
        for first, last, new in changes
        if not any(start <= first and last <= end for start, end in bounds)
    ]
    places = [(*bounds[0], f"state {name} {{\ninitial {initial}\n\n{states}\n}}")]
    return applied(text, [*others, *places, *((start, end, "") for start, end in bounds[1:])])


def _without(selection: Selection, lifted: Sequence[Common]) -> Iterator[Change]:
    """Yield the removals of transitions that are lifted; a state that had no more has no body."""
    gone = {each for common in lifted for each in common.transitions}
    for state in selection.states:
        if not isinstance(state, State) or gone.isdisjoint(state.items):
            continue
        removals = [removal(each.span.absolute) for each in state.items if each in gone]
        source, start, end = state.span.absolute
        start = state.name.span.absolute.end
        if gone.issuperset(state.items) and state.machine is None:
            rest = applied(source.text, removals, start, end)
            if not rest.strip(" \t\n;{}"):
                yield start, end, ""
                continue
        yield from removals


def _lifted(text: str, common: Common) -> str:
    """Return the text of a transition that is lifted, with the comments of all of them."""
    start, end = statement(common.kept.span.absolute)
    comments = dict.fromkeys(
        comment.rstrip()
        for each in common.transitions[1:]
        for comment in comments_of(each.span.absolute)
        if comment.rstrip() not in text[start:end]
    )
    return "\n".join([*comments, text[start:end]])
