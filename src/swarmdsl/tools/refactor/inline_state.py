"""Dissolve a composite state: what is in it takes its place.

A transition on events that the composite state has is lifted to the state around it, if it means
the same there: where no state beside would take it. Else each state in it gets a copy after its own
transitions, on the events that it does not always handle itself. It is refused where a step of the
machine would do something else: the composite state may have actions, time, variables or an end of
its own, or be restored or tested as a whole.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
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
    Container,
    Defer,
    Entry,
    EventTrigger,
    Exit,
    FinalState,
    History,
    Initial,
    Parallel,
    State,
    StateMachine,
    Transition,
    Variable,
    walk,
)
from swarmdsl.tools.refactor.changed_texts import (
    COMMENT,
    applied,
    comments_of,
    removal,
    statement,
    tried,
)
from swarmdsl.tools.refactor.common_transitions import (
    always_handled,
    can_be_lifted,
    events_of,
    is_on_events,
    measures_time,
)
from swarmdsl.tools.refactor.reference_targets import targets
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
_BODY = re.compile(r"\s*\{")


def why_not_inline(selection: Selection) -> str | None:
    """Return the reason why a state cannot be dissolved; None if it can."""
    state = selection.composite
    if state is None:
        return "it is no composite state"
    for item in state.items:
        if type(item) in _ITEMS:
            return f"`{state.name}` has {_ITEMS[type(item)]}"
        if isinstance(item, Transition) and not is_on_events(item):
            return f"a transition of `{state.name}` is on more than events"
        if isinstance(item, Transition) and measures_time(item):
            return f"a transition asks how long `{state.name}` has been active"
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
    around = selection.container
    own = [item for item in state.items if isinstance(item, Transition)]
    lifted = [each for each in own if can_be_lifted(each, state, around)]
    copied = [each for each in own if each not in lifted]
    added = list(_copies(state, copied, changes))
    body = _body(state, text, [*changes, *added])
    raised = "\n".join(_raised(each, around, changes) for each in lifted)
    bounds = statement(state.span.absolute)
    above = re.sub(r"(?m)^(\s*)///", r"\1//", text[bounds[0] : state.span.absolute.start])
    rest = text[state.span.absolute.end : bounds[1]].lstrip(" \t;")
    first = next((each for each in around.items if isinstance(each, Transition)), None)
    others = [each for each in changes if each[1] <= bounds[0] or bounds[1] <= each[0]]
    if first is not None and first.span.start < state.span.start and raised:
        # Inner transitions come first.
        at, _ = statement(first.span.absolute)
        others.append((at, at, f"{raised}\n"))
        raised = ""
    head = above.rstrip() + "\n" if above.strip() else ""
    whole = "\n".join(filter(None, (head, body, raised, rest)))
    texts = {
        each: applied(other.source.text, made)
        for each, made in elsewhere.items()
        if (other := workspace.file(each)) is not None
    }
    texts[path] = applied(text, [*others, (*bounds, whole)])
    made = tried(workspace, texts)
    with workspace.overriding(made):
        after = workspace.file(path)
        assert after is not None  # it was there before
        _refuse_other_targets(selection, state, after)
    return made


def _refuse_other_targets(selection: Selection, state: State, file: File) -> None:
    """Refuse if a name would mean another state than before."""
    gone = str(state.name)
    machine = next(
        each
        for each in file.model.declarations
        if isinstance(each, StateMachine) and each.name == selection.machine.name
    )
    before, after = targets(selection.machine, gone), targets(machine, gone)
    around = tuple(str(each.name) for each in selection.around[:-1])[::-1]
    beginning = next(item for item in state.items if isinstance(item, Initial))
    first = (*around, *beginning.target.name.split("."))  # what leads to the state leads there
    for owner, named in after.items():
        known = before.get(owner, set())
        if owner[:-1] == around:
            known = known | before.get(around, set())
        if around in known:
            known = known | {first}
        if not named <= known:
            raise RefusedError(f"`{min(named - known)[-1]}` would be another state than before")


def _raised(transition: Transition, around: Container, changes: list[Change]) -> str:
    """Return the text of a transition in the state around; one that stays in it is internal."""
    source, start, _ = transition.span.absolute
    target = transition.target.target if transition.target is not None else None
    stays = target in set(walk(around)) - {around}
    inner = [*changes, (start, start, "internal ")] if stays else changes
    return applied(source.text, inner, *statement(transition.span.absolute))


def _copies(
    state: State, transitions: Sequence[Transition], changes: list[Change]
) -> Iterator[Change]:
    """Yield the insertions of transitions of a state into the states in it.

    Comments of one that no state gets stay where they are.
    """
    text = state.span.absolute.source.text
    wanted = set(transitions)
    for inner in vertices(state):
        if not isinstance(inner, (State, Parallel)):
            continue
        handled = always_handled(inner)
        copied = [each for each in transitions if not events_of(each) <= handled]
        if not copied:
            continue
        wanted.difference_update(copied)
        lines = [
            applied(
                text,
                [*changes, *_fewer_triggers(each, handled)],
                *statement(each.span.absolute),
            )
            for each in copied
        ]
        span = inner.span.absolute
        added = "\n".join(lines)
        if text[span.end - 1] == "}":
            yield span.end - 1, span.end - 1, f"\n{added}\n"
        else:
            yield span.end, span.end, f" {{\n{added}\n}}"
    for each in transitions:
        if each in wanted:
            start, end, _ = removal(each.span.absolute)
            kept = "\n".join(map(_plain, comments_of(each.span.absolute)))
            yield start, end, f"{kept}\n" if kept else ""


def _fewer_triggers(transition: Transition, handled: set[object]) -> Iterator[Change]:
    """Yield the change of a transition without the events that a state handles itself."""
    triggers = [each for each in transition.triggers if isinstance(each, EventTrigger)]
    kept = [each for each in triggers if each.event.target not in handled]
    start, end = triggers[0].span.absolute.start, triggers[-1].span.absolute.end
    if len(kept) < len(triggers) and not COMMENT.search(
        transition.span.absolute.source.text, start, end
    ):
        yield start, end, ", ".join(each.span.text for each in kept)


def _body(state: State, text: str, changes: list[Change]) -> str:
    """Return what is between the braces of a state, without its own initial and transitions."""
    opening = _BODY.match(text, state.name.span.absolute.end)
    assert opening is not None  # a composite state has a body
    removed = []
    replaced = {(start, end) for start, end, _ in changes}
    for item in state.items:
        if isinstance(item, Transition):
            gone = removal(item.span.absolute)
            if gone[:2] not in replaced:
                removed.append(gone)
        elif isinstance(item, Initial):
            # Its documentation would be that of the next state.
            start, end = statement(item.span.absolute)
            found = map(_plain, COMMENT.findall(text[start:end]))
            removed.append((start, end, "\n".join(found) + "\n"))
    kept = [
        each
        for each in changes
        if not any(start <= each[0] and each[1] <= end for start, end, _ in removed)
    ]
    inside = applied(text, [*kept, *removed], opening.end(), state.span.absolute.end - 1)
    return inside.strip("\n").lstrip(" \t;") if inside.strip() else ""


def _plain(comment: str) -> str:
    """Return a comment that documents nothing."""
    return re.sub(r"^///", "//", comment)


def _is_in(inner: Span, outer: Span) -> bool:
    return outer.start <= inner.start and inner.end <= outer.end
