"""Three-way merge of outlines.

A change on one side is taken; different changes on both sides are a conflict.
"""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.base.records import dataclass
from swarmdsl.tools.merge.outline import Item, Key, keys

OURS, THEIRS = "<<<<<<< ours\n", ">>>>>>> theirs\n"
SEPARATOR = "=======\n"


@dataclass(frozen=True)
class Merged:
    """Merged text and the number of conflicts."""

    text: str
    conflicts: int


def merge(base: Item, ours: Item, theirs: Item) -> Merged:
    """Merge the outlines of three files."""
    return _merge_block(base, ours, theirs)


def _merge_block(base: Item, ours: Item, theirs: Item) -> Merged:
    """Merge the items of a block and the text around them."""
    parts = [
        _merge_text(base.lead, ours.lead, theirs.lead),
        _merge_text(base.head, ours.head, theirs.head),
        *_merge_items(base.inner, ours.inner, theirs.inner),
        _merge_text(base.tail, ours.tail, theirs.tail),
    ]
    text: list[str] = []
    for part in filter(lambda part: part.text, parts):
        # The last line of a file can lack a line end.
        if text and not text[-1].endswith("\n"):
            text.append("\n")
        text.append(part.text)
    return Merged("".join(text), sum(part.conflicts for part in parts))


def _merge_items(
    base: Sequence[Item], ours: Sequence[Item], theirs: Sequence[Item]
) -> list[Merged]:
    before, our_items, their_items = (
        {item.key: item for item in items} for items in (base, ours, theirs)
    )
    merged = (
        _merge_item(before.get(key), our_items.get(key), their_items.get(key))
        for key in _merged_order(keys(base), keys(ours), keys(theirs))
    )
    return [each for each in merged if each is not None]


def _merge_item(base: Item | None, ours: Item | None, theirs: Item | None) -> Merged | None:
    """Merge one item; None if it is removed."""
    if ours is None or theirs is None:
        remaining = ours or theirs
        if remaining is None:
            return None
        if base is None:
            return Merged(remaining.text, 0)
        if base.text == remaining.text:
            return None
        return _conflict(ours.text if ours else "", theirs.text if theirs else "")
    if ours.text == theirs.text:
        return Merged(ours.text, 0)
    if base is not None and base.text in (ours.text, theirs.text):
        return Merged(theirs.text if base.text == ours.text else ours.text, 0)
    if ours.inner and theirs.inner:
        return _merge_block(base if base is not None else Item(ours.key, "", ""), ours, theirs)
    if base is None or base.inner or ours.inner or theirs.inner:
        return _conflict(ours.text, theirs.text)
    return _merge_block(base, ours, theirs)


def _merge_text(base: str, ours: str, theirs: str) -> Merged:
    if ours in (base, theirs):
        return Merged(theirs, 0)
    if theirs == base:
        return Merged(ours, 0)
    return _conflict(ours, theirs)


def _conflict(ours: str, theirs: str) -> Merged:
    return Merged("".join((OURS, _terminated(ours), SEPARATOR, _terminated(theirs), THEIRS)), 1)


def _terminated(text: str) -> str:
    return text if text.endswith("\n") or not text else f"{text}\n"


def _merged_order(base: list[Key], ours: list[Key], theirs: list[Key]) -> list[Key]:
    """All keys in the order of the side that changed it.

    Keys of the other side only follow the key that precedes them there.
    """
    common = set(base) & set(ours) & set(theirs)
    was, now = ([key for key in side if key in common] for side in (base, ours))
    first, second = (theirs, ours) if was == now else (ours, theirs)
    known = set(first)
    # By key of the first side, None for the beginning: what follows it on the other side only.
    following: dict[Key | None, list[Key]] = {}
    before: Key | None = None
    for key in second:
        if key in known:
            before = key
        else:
            following.setdefault(before, []).append(key)
    merged = following.get(None, [])
    for key in first:
        merged += (key, *following.get(key, ()))
    return merged
