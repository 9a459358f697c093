"""Bind the events of machines again where an edit changes nothing but events.

Many machines use the same events. A machine that mentions an event only in triggers and sends
keeps its tree: these references alone are bound again. It is checked again if one of them means
another event than before.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from swarmdsl.analysis.resolve.linker import bind_reference
from swarmdsl.analysis.resolve.scopes import Scopes
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Source
from swarmdsl.driver.workspace.fragments import Fragment, with_users
from swarmdsl.driver.workspace.invalidation import Change
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    Component,
    Event,
    Member,
    Node,
    Ref,
    StateMachine,
    Swarm,
    references,
)

# Neither their names nor the checks of one of them depend on the events of machines that they use.
_BLIND = {StateMachine, Component, Member, Swarm}
_ABOUT_NAMES = ("duplicate-name", "unresolved-name", "ambiguous-name", "wrong-kind")


@dataclass
class Rebinding:
    """Fragments that an edit of events affects.

    `machines` keep their trees. `stale` are read and linked again, with all that use them.
    `checked` are only checked again. Facts about those that are `outdated` are gathered again.
    """

    machines: set[Fragment] = field(default_factory=set)
    stale: set[Fragment] = field(default_factory=set)
    checked: set[Fragment] = field(default_factory=set)
    outdated: set[Fragment] = field(default_factory=set)


def rebinding(
    change: Change, fragments: Mapping[Source, Fragment], noted: set[Fragment]
) -> Rebinding | None:
    """Return what an edit affects if it changes only events, else None.

    `noted` are the fragments with reported or suppressed diagnostics: hints of missing names
    depend on the names of all events.
    """
    touched = [*change.removed, *change.new]
    if change.imports_changed or change.unparsed_changed or not all(map(_has_events, touched)):
        return None
    found = Rebinding()
    names = {str(each.name) for fragment in touched for each in fragment.parsed.model.declarations}
    if not names:
        return found
    mention = re.compile(rf"\b(?:{'|'.join(map(re.escape, names))})\b")
    new = set(change.new)
    users = {user for fragment in change.removed for user in fragment.users}
    for fragment in fragments.values():
        if fragment in new:
            continue
        text = fragment.source.text
        mentions = any(name in text for name in names) and mention.search(text) is not None
        if not mentions and fragment not in noted and fragment not in users:
            continue
        if _is_rebindable(fragment, mention if mentions else None):
            found.machines.add(fragment)
        elif mentions or not _is_settled(fragment):
            found.stale.add(fragment)
        elif fragment in users or len(fragment.checked) or len(fragment.eventless):
            found.checked.add(fragment)
    return found


def rebind(
    found: Rebinding,
    change: Change,
    fragments: Mapping[Source, Fragment],
    project: Project,
) -> None:
    """Bind the events of the machines; add those with other events to what is checked again."""
    scopes = Scopes(project)
    removed = set(change.removed)
    changed = {fragment for fragment in found.machines if _rebind(fragment, scopes)}
    for fragment in found.machines:
        nodes = (ref.target for _, ref in event_references(fragment) if ref.target is not None)
        shown = (label.span for each in fragment.outside for label in each.related)
        sources = {node.span.source for node in nodes} | {span.source for span in shown}
        behind = (fragments.get(source) for source in sources)
        fragment.use(
            {
                *(each for each in fragment.uses if each not in removed),
                *(each for each in behind if each is not None),
            }
        )
        if len(fragment.checked):
            found.checked.add(fragment)
    found.checked |= changed
    for fragment in with_users(changed):
        found.outdated.add(fragment)
        kinds = {type(each) for each in fragment.parsed.model.declarations}
        if fragment.parsed.model.optimizations or not kinds <= _BLIND:
            found.stale.add(fragment)


def _rebind(fragment: Fragment, scopes: Scopes) -> bool:
    """Bind the events of a fragment again; return True if one is another one than before."""
    scope, report = scopes[fragment.file], Diagnostics(fragment.levels)
    before = [ref.target for _, ref in event_references(fragment)]
    for node, ref in event_references(fragment):
        ref.target = None
        bind_reference(node, ref, Event, scope, report)
    fragment.outside = report
    after = [ref.target for _, ref in event_references(fragment)]
    return any(one is not other for one, other in zip(before, after, strict=True))


def _has_events(fragment: Fragment) -> bool:
    """Return True if a fragment has nothing but events, or nothing at all."""
    model = fragment.parsed.model
    return (
        not len(fragment.syntax)
        and not model.optimizations
        and not fragment.has_package_or_imports
        and all(isinstance(each, Event) for each in model.declarations)
    )


def _is_rebindable(fragment: Fragment, mention: re.Pattern[str] | None) -> bool:
    """Return True if names of events mean only events of machines in a fragment.

    All that is wrong with its names must be about events, too.
    """
    declarations = fragment.parsed.model.declarations
    if not all(isinstance(each, StateMachine) for each in declarations):
        return False
    if fragment.parsed.model.optimizations or fragment.suppressed or len(fragment.syntax):
        return False
    if not _is_settled(fragment, outside=False):
        return False
    spans = [ref.span for _, ref in event_references(fragment)]
    places = {(span.start, span.end) for span in spans}
    for found in fragment.outside:
        at = found.primary.span if found.primary is not None else None
        if at is None or (at.start, at.end) not in places:
            return False
    if mention is None:
        return True
    inside = sum(len(mention.findall(span.text)) for span in spans)
    return inside == len(mention.findall(fragment.source.text))


def _is_settled(fragment: Fragment, *, outside: bool = True) -> bool:
    """Return True if nothing that was reported of a fragment depends on other names."""
    reports = (fragment.outside, fragment.inside) if outside else (fragment.inside,)
    named = any(each.name in _ABOUT_NAMES for each in (*fragment.checked, *fragment.eventless))
    empty = not any(map(len, reports)) and not len(fragment.syntax)
    return empty and not named and not fragment.suppressed


def event_references(fragment: Fragment) -> Iterator[tuple[Node, Ref[Event]]]:
    """Yield the references to events in a fragment, each with its node."""
    for declaration in fragment.parsed.model.declarations:
        for node, ref in references(declaration):
            if ref.kind == Event.__name__:
                yield node, ref
