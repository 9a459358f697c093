"""Recognize SCXML patterns for delays and for final states with their own events.

A delay is a `<send>` to the machine itself on entry and a `<cancel>` on exit. A final state can
raise an event that identifies it to the enclosing state.
"""

from __future__ import annotations

from collections import Counter

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.scxml.document import Document, Node
from swarmdsl.importing.partial_states import PartialState
from swarmdsl.ir import StateKind

FinalEvents = dict[str, list[PartialState]]
"""Final states by the event that they raise."""

_DELAYED = {"event", "id", "delay", "delayexpr"}


def fold_patterns(top: PartialState, document: Document, report: Diagnostics) -> FinalEvents:
    """Remove delayed events and events of final states from executable content."""
    sent = Counter(
        node.get("event")
        for draft in top.walk()
        for node in contents(draft)
        if node.name in ("send", "raise")
    )
    heard: dict[str, list[PartialState]] = {}
    for draft in top.walk():
        for edge in draft.edges:
            heard.setdefault(edge.event or "", []).append(draft)
    ends: FinalEvents = {}
    for draft in top.walk():
        _fold_timers(draft, sent, heard, document, report)
        if draft.kind is StateKind.FINAL:
            for node in draft.entry:
                if node.name == "raise":
                    ends.setdefault(node.get("event", ""), []).append(draft)
    for event, finals in list(ends.items()):
        unheard = top.payload and event not in heard and event == f"final.{finals[0].id}"
        if not unheard and (
            sent[event] > len(finals) or not _only_parent_handles(finals, heard.get(event, []))
        ):
            del ends[event]
            continue
        for final in finals:
            final.entry = [e for e in final.entry if (e.name, e.get("event")) != ("raise", event)]
    return ends


def contents(draft: PartialState) -> list[Node]:
    """All elements of executable content of a state and its transitions."""
    inside = [*draft.entry, *draft.exit]
    seen: dict[Node, None] = dict.fromkeys(edge.content or edge.node for edge in draft.edges)
    inside += [child for node in seen for child in node.children]
    return [node for each in inside for node in each.walk()]


def _fold_timers(
    draft: PartialState,
    sent: Counter[str | None],
    heard: dict[str, list[PartialState]],
    document: Document,
    report: Diagnostics,
) -> None:
    for node in list(draft.entry):
        event = node.get("event", "")
        if node.name != "send" or not event or sent[event] > 1:
            continue
        if not set(node.attributes) & {"delay", "delayexpr"}:
            continue
        alone = set(heard.get(event, ())) == {draft}
        hidden = any(
            _matches(each, event) for inner in draft.walk() for each in _events(inner, draft)
        )
        if not alone or hidden or set(node.attributes) - _DELAYED or node.children:
            continue
        cancels = [
            each
            for each in draft.exit
            if each.name == "cancel" and each.get("sendid") == node.get("id", "")
        ]
        if not cancels:
            what = f"nothing cancels the delayed event `{event}`"
            assumed = "cancellation on exit"
            report.report("assumed", document.at(node), what=what, assumed=assumed)
        draft.exit = [each for each in draft.exit if each not in cancels]
        draft.entry.remove(node)
        draft.timers[event] = node


def _events(inner: PartialState, draft: PartialState) -> list[str]:
    return [edge.event or "" for edge in inner.edges] if inner is not draft else []


def _matches(descriptor: str, event: str) -> bool:
    beginning = descriptor.removesuffix("*").removesuffix(".")
    return bool(descriptor) and (not beginning or f"{event}.".startswith(f"{beginning}."))


def _only_parent_handles(finals: list[PartialState], hearers: list[PartialState]) -> bool:
    """Return True if only the parent, or its parallel state, handles the event."""
    owners = {final.parent for final in finals}
    if len(owners) > 1 or not hearers:
        return False
    (owner,) = owners
    assert owner is not None
    heard_by = {owner}
    if owner.parent is not None and owner.parent.kind is StateKind.PARALLEL:
        heard_by = {owner.parent}
    return set(hearers) <= heard_by
