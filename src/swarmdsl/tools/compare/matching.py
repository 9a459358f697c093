"""Match the elements of two models by name, then by content.

Renamed and moved elements are found as git finds renamed files: by their share of common content.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Container, Hashable, Iterable, Iterator, Sequence

from swarmdsl.base.records import dataclass, field
from swarmdsl.tools.compare.behaviour import TRANSITION_KIND, VERTEX_KIND
from swarmdsl.tools.compare.elements import DOC, ROBOT_KIND, Element, Ref, Value

_MIN_SIMILARITY = 0.6
# With more pairs than this, comparing all would take too long.
_MAX_PAIRS = 20_000
_LAST = (TRANSITION_KIND, ROBOT_KIND)
_PSEUDO = ("final state", "choice", "history", "region")


@dataclass(eq=False)
class Matching:
    """Elements that are in both models, and the new names of renamed elements."""

    pairs: dict[Element, Element] = field(default_factory=dict)
    matched: set[Element] = field(default_factory=set)
    new_names: dict[Ref, Ref] = field(default_factory=dict)

    def update_names(self, value: Value) -> Value:
        """Replace old names in a value by the names in the newer model."""
        return tuple(
            self.new_names.get(piece, piece) if isinstance(piece, Ref) else piece for piece in value
        )

    def pair(self, old: Element, new: Element) -> None:
        """Record that two elements are the same."""
        self.pairs[old] = new
        self.matched.add(new)
        if old.ref is not None and new.ref is not None:
            self.new_names[old.ref] = new.ref


def match(before: Element, after: Element) -> Matching:
    """Match all elements of two models."""
    matching = Matching()
    matching.pair(before, after)
    _match_siblings(before.children, after.children, matching)
    top = list(matching.pairs.items())[1:]
    # Transitions are matched last: their names refer to events, states and variables. Robots are
    # matched after the roles that their names refer to.
    for old, new in top:
        _match_states(old, new, matching)
    for old, new in [*top, *list(matching.pairs.items())[len(top) + 1 :]]:
        _match_siblings(_first_children(old), _first_children(new), matching)
    for old, new in list(matching.pairs.items()):
        for kind in _LAST:
            _match_siblings(_children_of_kind(old, kind), _children_of_kind(new, kind), matching)
    return matching


def value_text(value: Value) -> str:
    """Value as plain text."""
    return "".join(piece.name if isinstance(piece, Ref) else piece for piece in value)


def _children_of_kind(element: Element, kind: str) -> list[Element]:
    return [child for child in element.children if child.kind == kind]


def _first_children(element: Element) -> list[Element]:
    return [child for child in element.children if child.kind not in (*_LAST, VERTEX_KIND)]


def _match_siblings(
    before: Iterable[Element], after: Iterable[Element], matching: Matching
) -> None:
    """Pair elements with the same name in order, then renamed ones."""
    known: dict[tuple[str, Value], _Namesakes] = defaultdict(_Namesakes)
    for new in after:
        known[new.kind, new.name].add(new)
    left = []
    for old in before:
        found = known[old.kind, matching.update_names(old.name)].take(old, matching)
        if found is not None:
            matching.pair(old, found)
        else:
            left.append(old)
    rest = [new for candidates in known.values() for new in candidates.left]
    for old, new in _similar_pairs(left, rest, matching):
        matching.pair(old, new)


class _Namesakes:
    """Siblings of one name, in order, that are paired one by one."""

    def __init__(self) -> None:
        self._all: list[Element] = []
        self._taken: set[Element] = set()
        self._first = 0
        # By their content, in reverse; made when two of them are to be told apart.
        self._alike: dict[Hashable, list[Element]] = {}

    @property
    def left(self) -> list[Element]:
        """Those that are not paired."""
        return [each for each in self._all if each not in self._taken]

    def add(self, element: Element) -> None:
        """Add a sibling."""
        self._all.append(element)

    def take(self, old: Element, matching: Matching) -> Element | None:
        """Return the first with the same content as `old`, else the first that is left."""
        while self._first < len(self._all) and self._all[self._first] in self._taken:
            self._first += 1
        if self._first == len(self._all):
            return None
        found = self._all[self._first]
        if len(self._all) - len(self._taken) > 1:
            if not self._alike:
                for each in reversed(self._all):
                    if each not in self._taken:
                        content = frozenset(_features(each, _IDENTITY).items())
                        self._alike.setdefault(content, []).append(each)
            alike = self._alike.get(frozenset(_features(old, matching).items()), [])
            while alike and alike[-1] in self._taken:
                alike.pop()
            found = alike[-1] if alike else found
        self._taken.add(found)
        return found


def _match_states(before: Element, after: Element, matching: Matching) -> None:
    """Pair the states of a machine, those with the same parent first."""
    _match_inner(before, after, matching)
    moved: dict[Hashable, list[list[Element]]] = defaultdict(lambda: [[], []])
    for index, left in enumerate(
        (_unmatched_states(before, matching.pairs), _unmatched_states(after, matching.matched))
    ):
        for state in left:
            moved[value_text(state.name), _pseudo_kind(state)][index].append(state)
    for olds, news in moved.values():
        if (
            len(olds) == len(news) == 1
            and olds[0] not in matching.pairs
            and news[0] not in matching.matched
        ):
            matching.pair(olds[0], news[0])
            _match_inner(olds[0], news[0], matching)
    for old, new in _similar_pairs(
        _unmatched_states(before, matching.pairs),
        _unmatched_states(after, matching.matched),
        matching,
    ):
        if old not in matching.pairs and new not in matching.matched:
            matching.pair(old, new)
            _match_inner(old, new, matching)


def _match_inner(before: Element, after: Element, matching: Matching) -> None:
    """Pair states with the same name, level by level."""
    waiting = [(before, after)]
    for old, new in waiting:
        known = {
            inner.name: inner
            for inner in _children_of_kind(new, VERTEX_KIND)
            if inner not in matching.matched
        }
        for inner in _children_of_kind(old, VERTEX_KIND):
            if inner not in matching.pairs and inner.name in known:
                matching.pair(inner, known[inner.name])
                waiting.append((inner, known[inner.name]))


def _unmatched_states(owner: Element, matched: Container[Element]) -> list[Element]:
    return [each for each in owner.walk() if each.kind == VERTEX_KIND and each not in matched]


def _pseudo_kind(state: Element) -> str:
    """Kind of a vertex that cannot become another kind; empty for ordinary states."""
    kind = value_text(dict(state.values).get("kind", ()))
    return kind if kind in _PSEUDO else ""


def _similar_pairs(
    before: Sequence[Element], after: Sequence[Element], matching: Matching
) -> Iterator[tuple[Element, Element]]:
    """Yield pairs of elements with similar content, most similar first."""
    if not before or not after:
        return
    olds: dict[Hashable, list[Element]] = defaultdict(list)
    news: dict[Hashable, list[Element]] = defaultdict(list)
    for old in before:
        if old.kind == ROBOT_KIND:  # a number is not a name that could be another one
            continue
        olds[old.kind, _pseudo_kind(old)].append(old)
    for new in after:
        news[new.kind, _pseudo_kind(new)].append(new)
    for kind in olds.keys() & news.keys():
        yield from _similar_of_kind(olds[kind], news[kind], matching)


def _similar_of_kind(
    before: list[Element], after: list[Element], matching: Matching
) -> Iterator[tuple[Element, Element]]:
    if len(before) == len(after) == 1 and (
        before[0].kind != VERTEX_KIND or _pseudo_kind(before[0])
    ):
        old, new = before[0], after[0]
        if old.values and _features(old, matching) == _features(new, _IDENTITY):
            yield old, new
            return
    if len(before) * len(after) > _MAX_PAIRS:
        return
    old_features = [_features(old, matching) for old in before]
    old_totals = [features.total() for features in old_features]
    scored = []
    for column, new in enumerate(after):
        new_features = _features(new, _IDENTITY)
        counts, total = new_features.get, new_features.total()
        for row, features in enumerate(old_features):
            common = sum([min(count, counts(each, 0)) for each, count in features.items()])
            share = 2 * common / ((old_totals[row] + total) or 1)
            if common >= 2 and share >= _MIN_SIMILARITY:
                scored.append((-share, row, column))
    rows: set[int] = set()
    columns: set[int] = set()
    for _, row, column in sorted(scored):
        if row not in rows and column not in columns:
            rows.add(row)
            columns.add(column)
            yield before[row], after[column]


def _features(element: Element, matching: Matching) -> Counter[tuple[str, ...]]:
    """Count the properties of an element and its descendants, using new names."""
    found: Counter[tuple[str, ...]] = Counter()
    for each in element.walk():
        if each is not element:
            found[each.kind, value_text(matching.update_names(each.name))] += 1
        for name, value in each.values:
            if name != DOC:
                found[each.kind, name, value_text(matching.update_names(value))] += 1
    return found


_IDENTITY = Matching()
