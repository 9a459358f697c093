"""Tree of the declarations and statements of a file that covers all of its text."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence

from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Source
from swarmdsl.syntax.ast import (
    Activity,
    BehaviorUse,
    Branch,
    Connector,
    Documented,
    Entry,
    EnvironmentUse,
    Equipment,
    Exit,
    FitnessUse,
    Heartbeat,
    ImportFile,
    ImportLibrary,
    ImportRos,
    Initial,
    Model,
    ModelUse,
    Node,
    Package,
    RobotValues,
    Sight,
    Transition,
    children,
)

Key = tuple[str, ...]
"""Identifies an item across versions by kind and name, or by kind and text."""

_COMMENT = re.compile(r"//[^\n]*|/\*(?:[^*]|\*(?!/))*\*/")
_REST_OF_LINE = re.compile(r"[ \t]*(?:/\*(?:[^*\n]|\*(?!/))*\*/[ \t]*)*(?://[^\n]*)?\n?")


@dataclass(frozen=True)
class Item:
    """Declaration or statement with the text before it that belongs to no other item.

    `lead` is the comments and blank lines above. `head` is the rest; for a block, the text before
    its `inner` items, and `tail` the text after them.
    """

    key: Key
    lead: str
    head: str
    inner: tuple[Item, ...] = ()
    tail: str = ""

    @property
    def text(self) -> str:
        """Text of the item."""
        return "".join((self.lead, self.head, *(each.text for each in self.inner), self.tail))


def outline(source: Source, model: Model) -> Item:
    """Outline of a file without syntax errors."""
    text = source.text
    split = _split(text, model, 0)
    inner, end = split if split is not None else ((), 0)
    return Item((), "", "", inner, text[end:])


def _split(text: str, node: Node, start: int) -> tuple[tuple[Item, ...], int] | None:
    """Items of a block that begins at `start`, and the end of the last one.

    None if the text cannot be split between them: several share a line, or other text is in
    between.
    """
    nodes = sorted(
        (child for child in children(node) if isinstance(child, Documented)),
        key=lambda child: child.span.start,
    )
    if not nodes:
        return None
    items: list[Item] = []
    seen: Counter[Key] = Counter()
    at = start
    for child in nodes:
        if child.span.start < at or not _is_blank(text[at : child.span.start]):
            return None
        rest = _REST_OF_LINE.match(text, child.span.end)
        assert rest is not None  # the pattern matches the empty string
        end = rest.end()
        if end < len(text) and text[end - 1] != "\n":
            return None
        key = _key(child)
        seen[key] += 1
        items.append(_item(text, child, (*key, str(seen[key])), at, end))
        at = end
    return tuple(items), at


def _item(text: str, node: Documented, key: Key, start: int, end: int) -> Item:
    line = text.rfind("\n", 0, node.span.start) + 1
    lead, own = text[start:line], max(start, line)
    opening = text.find("{", node.span.start, node.span.end)
    if opening >= 0:
        rest = _REST_OF_LINE.match(text, opening + 1)
        assert rest is not None
        found = _split(text, node, rest.end()) if text[rest.end() - 1] == "\n" else None
        if found is not None and _is_blank(text[found[1] : node.span.end - 1]):
            inner, at = found
            return Item(key, lead, text[own : rest.end()], inner, text[at:end])
    return Item(key, lead, text[own:end])


def _is_blank(text: str) -> bool:
    return not _COMMENT.sub("", text).strip()


def _key(node: Documented) -> Key:
    kind = type(node).__name__
    match node:
        case Package() | Initial() | Entry() | Exit() | Activity() | BehaviorUse():
            return (kind,)
        case EnvironmentUse() | FitnessUse() | Heartbeat():
            return (kind,)
        case Equipment(kind=equipment):
            return kind, equipment
        case Sight(target=target):
            return kind, target.name
        case ModelUse():
            return (kind,)
        case RobotValues(role=role, index=index):
            return kind, role.name, index
        case Transition(triggers=triggers):
            return kind, *(_normalized(each) for each in triggers)
        case Branch(guard=guard):
            return kind, _normalized(guard) if guard is not None else ""
        case Connector() | ImportFile() | ImportLibrary() | ImportRos():
            return kind, _normalized(node)
    name = getattr(node, "name", None)
    return (kind, str(name)) if name else (kind, _normalized(node))


def _normalized(node: Node) -> str:
    return " ".join(node.span.text.split())


def keys(items: Sequence[Item]) -> list[Key]:
    """Keys of items in order."""
    return [item.key for item in items]
