"""Find the changes between two models."""

from __future__ import annotations

from collections.abc import Iterator
from enum import Enum

from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.tools.compare.behaviour import TRANSITION_KIND, VERTEX_KIND
from swarmdsl.tools.compare.elements import Element, Value
from swarmdsl.tools.compare.matching import Matching, match, value_text
from swarmdsl.tools.compare.strength import Strength


class Action(Enum):
    """Kind of a change."""

    ADDED = "added"
    REMOVED = "removed"
    RENAMED = "renamed"
    MOVED = "moved"
    CHANGED = "changed"
    REORDERED = "reordered"


# The order matters: fields on the wire, priority of transitions.
_ORDERED = frozenset(
    (
        *("field", "request field", "response field", "goal field", "result field"),
        *("feedback field", TRANSITION_KIND),
    )
)


@dataclass(frozen=True)
class Change:
    """One difference between two models.

    `top` is the declaration that contains it, and `owner` the parent element. `before` and `after`
    are the values of the property `word`, or the old and new name or place. `old` or `new` is None
    if the element exists on one side only. `strength` is how the sentence of a property changed,
    if that is certain.
    """

    action: Action
    top: Element
    owner: Element
    kind: str
    old: Element | None
    new: Element | None
    property_name: str = ""
    before: str = ""
    after: str = ""
    strength: Strength | None = None

    @property
    def element(self) -> Element:
        """The changed element: the newer version if there is one."""
        found = self.new if self.new is not None else self.old
        assert found is not None
        return found

    @property
    def origin(self) -> Span | None:
        """Place of the change in the newer model, or of what was removed in the older one."""
        return self.element.place(self.property_name)

    @property
    def subject(self) -> str:
        """Description of the changed element; empty for the declaration itself."""
        if self.element is self.top:
            return ""
        of = "" if self.owner is self.top else f" of {self.owner.kind} `{display_name(self.owner)}`"
        target = ""
        if self.kind == TRANSITION_KIND and self.action in (Action.ADDED, Action.REMOVED):
            # A transition that stays is identified by its triggers alone.
            target = f" -> {value_text(dict(self.element.values)['target'])}"
        suffix = of if self.kind != VERTEX_KIND else ""
        return f"{self.kind} `{display_name(self.element)}{target}`{suffix}"

    @property
    def description(self) -> str:
        """Description of the change."""
        match self.action:
            case Action.RENAMED if self.kind == TRANSITION_KIND:
                return f"was `{self.before}`"
            case Action.RENAMED:
                return f"renamed from `{self.before}`"
            case Action.MOVED:
                return f"moved from {self.before} to {self.after}"
            case Action.CHANGED if not self.before:
                return f"{self.property_name} `{self.after}` added"
            case Action.CHANGED if not self.after:
                return f"{self.property_name} `{self.before}` removed"
            case Action.CHANGED:
                how = f", {self.strength}" if self.strength is not None else ""
                return f"{self.property_name} is `{self.after}`, was `{self.before}`{how}"
            case Action.REORDERED:
                return f"{self.property_name} reordered"
        return str(self.action.value)


def changes_between(before: Element, after: Element) -> tuple[list[Change], Matching]:
    """List all changes in the order of the newer model, removed declarations last."""
    matching = match(before, after)
    former = {new: old for old, new in matching.pairs.items()}
    found = list(_property_changes(before, after, after, after, matching))
    for new in after.children:
        old = former.get(new)
        if old is None:
            found.append(Change(Action.ADDED, new, new, new.kind, None, new))
        else:
            found += _declaration_changes(old, new, matching, former)
    found += (
        Change(Action.REMOVED, old, old, old.kind, old, None)
        for old in before.children
        if old not in matching.pairs
    )
    return found, matching


def display_name(element: Element) -> str:
    """Display name of an element: the path for a state, otherwise the name."""
    if element.kind == VERTEX_KIND and element.ref is not None:
        return element.ref.name
    return value_text(element.name)


def _declaration_changes(
    old: Element, new: Element, matching: Matching, former: dict[Element, Element]
) -> Iterator[Change]:
    """Yield the changes of a declaration and of all elements in it."""
    parents = {child: each for each in old.walk() for child in each.children}
    owners = {child: each for each in new.walk() for child in each.children}
    yield from _property_changes(old, new, new, new, matching)
    for each in new.walk():
        was = former.get(each)
        if each is not new and was is not None:
            yield from _property_changes(was, each, new, owners[each], matching)
            yield from _moves(was, each, new, parents[was], owners[each], matching)
        elif each is not new and owners[each] in former:
            # The content of an added element is not reported on its own.
            yield Change(Action.ADDED, new, owners[each], each.kind, None, each)
        if was is None:
            continue
        yield from _reorderings(was, each, new, owners.get(each, new), matching)
        for child in was.children:
            if child not in matching.pairs:
                yield Change(Action.REMOVED, new, each, child.kind, child, None)


def _property_changes(
    old: Element, new: Element, top: Element, owner: Element, matching: Matching
) -> Iterator[Change]:
    if old.kind != new.kind:
        yield Change(Action.CHANGED, top, owner, new.kind, old, new, "kind", old.kind, new.kind)
    if new is not top or top.ref is not None:
        was, now = matching.update_names(old.name), new.name
        if was != now:
            yield Change(
                *(Action.RENAMED, top, owner, new.kind, old, new, "name", value_text(old.name)),
                value_text(now),
            )
    before, after = dict(old.values), dict(new.values)
    for name in dict.fromkeys((*before, *after)):
        is_now: Value = after.get(name, ())
        was_then = before.get(name, ())
        if matching.update_names(was_then) != is_now:
            yield Change(
                *(Action.CHANGED, top, owner, new.kind, old, new, name, value_text(was_then)),
                value_text(is_now),
            )


def _moves(
    old: Element,
    new: Element,
    top: Element,
    parent: Element,
    owner: Element,
    matching: Matching,
) -> Iterator[Change]:
    if matching.pairs.get(parent) is not owner:
        yield Change(
            *(Action.MOVED, top, owner, new.kind, old, new, "place", _parent_name(parent)),
            _parent_name(owner),
        )


def _parent_name(owner: Element) -> str:
    return f"`{display_name(owner)}`" if owner.kind == VERTEX_KIND else "the top level"


def _reorderings(
    old: Element, new: Element, top: Element, owner: Element, matching: Matching
) -> Iterator[Change]:
    indices = {child: index for index, child in enumerate(new.children)}
    last_index: dict[str, int] = {}
    reported: set[str] = set()
    for child in old.children:
        index = indices.get(matching.pairs.get(child, child))
        if index is None or child.kind not in _ORDERED or child.kind in reported:
            continue
        if index < last_index.get(child.kind, -1):
            reported.add(child.kind)
            name = f"{child.kind}s"
            yield Change(Action.REORDERED, top, owner, new.kind, old, new, name)
        last_index[child.kind] = index
