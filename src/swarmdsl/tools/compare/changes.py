"""What is different between two models, in the words of the one who wrote them."""

from __future__ import annotations

from collections.abc import Iterator
from enum import Enum

from swarmdsl.base.records import dataclass
from swarmdsl.tools.compare.behaviour import TRANSITION, VERTEX
from swarmdsl.tools.compare.elements import Element, Value
from swarmdsl.tools.compare.matching import Matching, match, text


class Action(Enum):
    """What has been done to something."""

    ADDED = "added"
    REMOVED = "removed"
    RENAMED = "renamed"
    MOVED = "moved"
    CHANGED = "changed"
    REORDERED = "reordered"


# In another order these mean something else: messages on the wire, the one that is taken first.
_ORDERED = frozenset(
    (
        *("field", "request field", "response field", "goal field", "result field"),
        *("feedback field", TRANSITION),
    )
)


@dataclass(frozen=True)
class Change:
    """One difference.

    `top` is the declaration in which it is, `before` and `after` are the values of `word`, or
    the names or places that something had. The element is None where there is none on a side.
    """

    action: Action
    top: Element
    owner: Element
    kind: str
    old: Element | None
    new: Element | None
    word: str = ""
    before: str = ""
    after: str = ""

    @property
    def element(self) -> Element:
        """What is different, as it is now where it still is."""
        found = self.new if self.new is not None else self.old
        assert found is not None
        return found

    @property
    def subject(self) -> str:
        """What is different, in words; empty for the declaration itself."""
        if self.element is self.top:
            return ""
        of = "" if self.owner is self.top else f" of {self.owner.kind} `{called(self.owner)}`"
        target = ""
        if self.kind == TRANSITION and self.action in (Action.ADDED, Action.REMOVED):
            # One that stays is told from others by what it is for.
            target = f" -> {text(dict(self.element.values)['target'])}"
        return f"{self.kind} `{called(self.element)}{target}`{of if self.kind != VERTEX else ''}"

    @property
    def said(self) -> str:
        """What has become of it, in words."""
        match self.action:
            case Action.RENAMED if self.kind == TRANSITION:
                return f"was `{self.before}`"
            case Action.RENAMED:
                return f"was called `{self.before}`"
            case Action.MOVED:
                return f"moved from {self.before} to {self.after}"
            case Action.CHANGED if not self.before:
                return f"{self.word} is `{self.after}`, was not said"
            case Action.CHANGED if not self.after:
                return f"{self.word} `{self.before}` is not said any more"
            case Action.CHANGED:
                return f"{self.word} is `{self.after}`, was `{self.before}`"
            case Action.REORDERED:
                return f"{self.word} are in another order"
        return str(self.action.value)


def changes_between(before: Element, after: Element) -> tuple[list[Change], Matching]:
    """All differences, in the order of the newer model; what has gone comes last."""
    matching = match(before, after)
    former = {new: old for old, new in matching.pairs.items()}
    found = list(_said(before, after, after, after, matching))
    for new in after.children:
        old = former.get(new)
        if old is None:
            found.append(Change(Action.ADDED, new, new, new.kind, None, new))
        else:
            found += _declaration(old, new, matching, former)
    found += (
        Change(Action.REMOVED, old, old, old.kind, old, None)
        for old in before.children
        if old not in matching.pairs
    )
    return found, matching


def called(element: Element) -> str:
    """The name of an element; that of a state is its path."""
    if element.kind == VERTEX and element.ref is not None:
        return element.ref.name
    return text(element.name)


def _declaration(
    old: Element, new: Element, matching: Matching, former: dict[Element, Element]
) -> Iterator[Change]:
    """What is different in a declaration: in itself, and in all that is in it."""
    parents = {child: each for each in old.walk() for child in each.children}
    owners = {child: each for each in new.walk() for child in each.children}
    yield from _said(old, new, new, new, matching)
    for each in new.walk():
        was = former.get(each)
        if each is not new and was is not None:
            yield from _said(was, each, new, owners[each], matching)
            yield from _place(was, each, new, parents[was], owners[each], matching)
        elif each is not new and owners[each] in former:
            # What is in something new is part of it.
            yield Change(Action.ADDED, new, owners[each], each.kind, None, each)
        if was is None:
            continue
        yield from _order(was, each, new, owners.get(each, new), matching)
        for child in was.children:
            if child not in matching.pairs:
                yield Change(Action.REMOVED, new, each, child.kind, child, None)


def _said(
    old: Element, new: Element, top: Element, owner: Element, matching: Matching
) -> Iterator[Change]:
    if old.kind != new.kind:
        yield Change(Action.CHANGED, top, owner, new.kind, old, new, "kind", old.kind, new.kind)
    if new is not top or top.ref is not None:
        was, now = matching.now(old.name), new.name
        if was != now:
            yield Change(
                *(Action.RENAMED, top, owner, new.kind, old, new, "name", text(old.name)),
                text(now),
            )
    before, after = dict(old.values), dict(new.values)
    for word in dict.fromkeys((*before, *after)):
        is_now: Value = after.get(word, ())
        was_then = before.get(word, ())
        if matching.now(was_then) != is_now:
            yield Change(
                *(Action.CHANGED, top, owner, new.kind, old, new, word, text(was_then)),
                text(is_now),
            )


def _place(
    old: Element,
    new: Element,
    top: Element,
    parent: Element,
    owner: Element,
    matching: Matching,
) -> Iterator[Change]:
    if matching.pairs.get(parent) is not owner:
        yield Change(
            *(Action.MOVED, top, owner, new.kind, old, new, "place", _place_name(parent)),
            _place_name(owner),
        )


def _place_name(owner: Element) -> str:
    return f"`{called(owner)}`" if owner.kind == VERTEX else "the machine"


def _order(
    old: Element, new: Element, top: Element, owner: Element, matching: Matching
) -> Iterator[Change]:
    places = {child: index for index, child in enumerate(new.children)}
    seen: dict[str, int] = {}
    told: set[str] = set()
    for child in old.children:
        now = places.get(matching.pairs.get(child, child))
        if now is None or child.kind not in _ORDERED or child.kind in told:
            continue
        if now < seen.get(child.kind, -1):
            told.add(child.kind)
            word = f"{child.kind}s"
            yield Change(Action.REORDERED, top, owner, new.kind, old, new, word)
        seen[child.kind] = now
