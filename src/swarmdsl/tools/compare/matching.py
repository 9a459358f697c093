"""Which element of one model is which of another: by name, then by what is said of it.

Something that another name or another place was given is found again as git finds renamed
files: by the share of what it has in common with what has gone.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Hashable, Iterable, Iterator, Sequence

from swarmdsl.base.records import dataclass, field
from swarmdsl.tools.compare.behaviour import TRANSITION, VERTEX
from swarmdsl.tools.compare.elements import DOC, Element, Ref, Value

_ALIKE = 0.6
# Beyond so many pairs only what is alike in all is looked for: it would take too long.
_MANY = 20_000
_PSEUDO = ("final state", "choice", "history", "region")


@dataclass(eq=False)
class Matching:
    """The elements that are in both models, and what names of the older one are now."""

    pairs: dict[Element, Element] = field(default_factory=dict)
    found: set[Element] = field(default_factory=set)
    names: dict[Ref, Ref] = field(default_factory=dict)

    def now(self, value: Value) -> Value:
        """A value of the older model with the names that things have now."""
        return tuple(
            self.names.get(piece, piece) if isinstance(piece, Ref) else piece for piece in value
        )

    def pair(self, old: Element, new: Element) -> None:
        """Take two elements for the same."""
        self.pairs[old] = new
        self.found.add(new)
        if old.ref is not None and new.ref is not None:
            self.names[old.ref] = new.ref


def match(before: Element, after: Element) -> Matching:
    """Find everything of one model in another."""
    made = Matching()
    made.pair(before, after)
    _match_siblings(before.children, after.children, made)
    top = list(made.pairs.items())[1:]
    # Transitions are known by names of events, states and variables: those come first.
    for old, new in top:
        _match_states(old, new, made)
    for old, new in [*top, *list(made.pairs.items())[len(top) + 1 :]]:
        _match_siblings(_others(old, TRANSITION), _others(new, TRANSITION), made)
    for old, new in list(made.pairs.items()):
        _match_siblings(_only(old, TRANSITION), _only(new, TRANSITION), made)
    return made


def text(value: Value) -> str:
    """A value as a person reads it."""
    return "".join(piece.name if isinstance(piece, Ref) else piece for piece in value)


def _only(element: Element, kind: str) -> list[Element]:
    return [child for child in element.children if child.kind == kind]


def _others(element: Element, kind: str) -> list[Element]:
    return [child for child in element.children if child.kind not in (kind, VERTEX)]


def _match_siblings(before: Iterable[Element], after: Iterable[Element], made: Matching) -> None:
    """Pair those of one name, several of one in their order, and those that are renamed."""
    known: dict[tuple[str, Value], list[Element]] = defaultdict(list)
    for new in after:
        known[new.kind, new.name].append(new)
    left = []
    for old in before:
        candidates = known[old.kind, made.now(old.name)]
        if candidates:
            same = _content(old, made)
            equal = (new for new in candidates if _content(new, _SAME) == same)
            new = next(equal, candidates[0]) if len(candidates) > 1 else candidates[0]
            candidates.remove(new)
            made.pair(old, new)
        else:
            left.append(old)
    rest = [new for candidates in known.values() for new in candidates]
    for old, new in _alike(left, rest, made):
        made.pair(old, new)


def _match_states(before: Element, after: Element, made: Matching) -> None:
    """Pair the states of a machine: those in their place, then those elsewhere."""
    _match_inner(before, after, made)
    moved: dict[Hashable, list[list[Element]]] = defaultdict(lambda: [[], []])
    for index, left in enumerate((_left(before, made.pairs), _left(after, made.found))):
        for state in left:
            moved[text(state.name), _pseudo(state)][index].append(state)
    for olds, news in moved.values():
        if len(olds) == len(news) == 1 and olds[0] not in made.pairs and news[0] not in made.found:
            made.pair(olds[0], news[0])
            _match_inner(olds[0], news[0], made)
    for old, new in _alike(_left(before, made.pairs), _left(after, made.found), made):
        if old not in made.pairs and new not in made.found:
            made.pair(old, new)
            _match_inner(old, new, made)


def _match_inner(before: Element, after: Element, made: Matching) -> None:
    """Pair the states in two that are the same by their names, level by level."""
    waiting = [(before, after)]
    for old, new in waiting:
        known = {inner.name: inner for inner in _only(new, VERTEX) if inner not in made.found}
        for inner in _only(old, VERTEX):
            if inner not in made.pairs and inner.name in known:
                made.pair(inner, known[inner.name])
                waiting.append((inner, known[inner.name]))


def _left(owner: Element, matched: Iterable[Element]) -> list[Element]:
    taken = set(matched)
    return [each for each in owner.walk() if each.kind == VERTEX and each not in taken]


def _pseudo(state: Element) -> str:
    """Which of the vertices it is that no other kind becomes."""
    kind = text(dict(state.values).get("kind", ()))
    return kind if kind in _PSEUDO else ""


def _alike(
    before: Sequence[Element], after: Sequence[Element], made: Matching
) -> Iterator[tuple[Element, Element]]:
    """Pairs of elements that say much the same, the most alike first."""
    if not before or not after:
        return
    olds: dict[Hashable, list[Element]] = defaultdict(list)
    news: dict[Hashable, list[Element]] = defaultdict(list)
    for old in before:
        olds[old.kind, _pseudo(old)].append(old)
    for new in after:
        news[new.kind, _pseudo(new)].append(new)
    for kind in olds.keys() & news.keys():
        yield from _alike_of_a_kind(olds[kind], news[kind], made)


def _alike_of_a_kind(
    before: list[Element], after: list[Element], made: Matching
) -> Iterator[tuple[Element, Element]]:
    if len(before) == len(after) == 1 and (before[0].kind != VERTEX or _pseudo(before[0])):
        old, new = before[0], after[0]
        if old.values and _content(old, made) == _content(new, _SAME):
            yield old, new
            return
    if len(before) * len(after) > _MANY:
        return
    contents = [_content(old, made) for old in before]
    scored = []
    for column, new in enumerate(after):
        content = _content(new, _SAME)
        for row, known in enumerate(contents):
            common = (known & content).total()
            share = 2 * common / ((known.total() + content.total()) or 1)
            if common >= 2 and share >= _ALIKE:
                scored.append((-share, row, column))
    rows: set[int] = set()
    columns: set[int] = set()
    for _, row, column in sorted(scored):
        if row not in rows and column not in columns:
            rows.add(row)
            columns.add(column)
            yield before[row], after[column]


def _content(element: Element, made: Matching) -> Counter[tuple[str, ...]]:
    """All that is said of an element and of what is in it, with names as they are now."""
    found: Counter[tuple[str, ...]] = Counter()
    for each in element.walk():
        if each is not element:
            found[each.kind, text(made.now(each.name))] += 1
        for word, value in each.values:
            if word != DOC:
                found[each.kind, word, text(made.now(value))] += 1
    return found


_SAME = Matching()
