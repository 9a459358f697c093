"""Resolve targets of transitions and initial states."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.records import replace
from swarmdsl.execution.scxml.document import Document, Node
from swarmdsl.importing.partial_states import THREADS, Edge, PartialState
from swarmdsl.ir import StateKind


def resolve_targets(top: PartialState, document: Document, report: Diagnostics) -> None:
    """Resolve the targets of all transitions and initial states and report errors."""
    resolver = _Resolver(document, report, top)
    # Inner states first: the initial states of outer ones depend on them.
    for draft in reversed(list(top.walk())):
        if draft.children and draft.kind is StateKind.COMPOSITE:
            draft.initial = resolver.initial(draft)
    for draft in top.walk():
        edges = [resolver.resolved(edge, draft) for edge in draft.edges]
        draft.edges = [edge for edge in edges if edge is not None]


class _Resolver:
    def __init__(self, document: Document, report: Diagnostics, top: PartialState) -> None:
        self.document = document
        self.report = report
        self.known: dict[str, list[PartialState]] = {}
        self.left_out: set[Node] = set()
        # For a duplicate id, the first state with it below each ancestor.
        self.first_in: dict[str, dict[PartialState, PartialState]] = {}
        for draft in top.walk():
            self._leave_histories(draft)
            for each in draft.ids:
                self.known.setdefault(each, []).append(draft)
        for identifier, drafts in self.known.items():
            for other in drafts[1:]:
                report.report(
                    "repaired-dialect",
                    document.at(other.node, "id"),
                    related=(Label(document.at(drafts[0].node, "id"), "first state with this id"),),
                    fault=f"duplicate id `{identifier}`: transitions lead to the nearest state",
                )

    def _leave_histories(self, draft: PartialState) -> None:
        """Remove histories beside regions; a model has none for a whole parallel state."""
        if draft.kind is not StateKind.PARALLEL:
            return
        for child in draft.children:
            if child.kind is StateKind.HISTORY:
                reason = "in a model, only regions have a history"
                self._leave_out(child.node, "this history", reason)
        draft.children = [each for each in draft.children if each.kind is not StateKind.HISTORY]

    def initial(self, draft: PartialState) -> PartialState:
        """Return the initial state of a composite state."""
        first = next((e for e in draft.children if e.kind is not StateKind.HISTORY), None)
        first = first or draft.children[0]
        node, attribute = draft.node, "initial"
        for child in draft.node.children:
            if child.name == "initial" and child.children:
                node, attribute = child.children[0], "target"
                for effect in node.children:
                    reason = "an initial transition has no effects in a model"
                    self._leave_out(effect, f"`<{effect.name}>`", reason)
        ids = node.get(attribute, "").split()
        if not ids:
            return first
        found = [self._inside(name, draft) for name in ids]
        fault = ""
        if None in found:
            fault = f"no inner state has the id `{ids[found.index(None)]}`"
        else:
            one = _common_entry([each for each in found if each is not None])
            if one is not None:
                return one
            fault = "it has several initial states"
        fault += f": `{first.id}` is used"
        self.report.report("repaired-dialect", self.document.at(node, attribute), fault=fault)
        return first

    def _inside(self, name: str, draft: PartialState) -> PartialState | None:
        return next((e for e in self.known.get(name, ()) if draft in e.ancestors()), None)

    def resolved(self, edge: Edge, source: PartialState) -> Edge | None:
        """Return the edge with its target; None if it cannot be imported."""
        ids = edge.node.get("target", "").split()
        if not ids:
            return edge
        found = [self._nearest(name, edge, source) for name in ids]
        targets = [each for each in found if each is not None]
        if len(targets) < len(ids):
            return None
        target = _common_entry(targets)
        if target is None or (len(targets) > 1 and not _exits_same_states(source, target, targets)):
            self._leave_out(edge.node, "this transition", "it has several targets", "target")
            return None
        level = next(each for each in (source, *source.ancestors()) if _is_in(target, each))
        if level is not source and level is not target and level.kind is StateKind.PARALLEL:
            reason = "it leads from one region into another"
            self._leave_out(edge.node, "this transition", reason, "target")
            return None
        return replace(edge, target=target)

    def _nearest(self, name: str, edge: Edge, source: PartialState) -> PartialState | None:
        """State with an id that has the closest common ancestor with the source."""
        found = self.known.get(name)
        if found is None:
            close = [id_ for id_ in self.known if id_.casefold() == name.casefold()]
            close += [id_ for id_ in self.known if id_ == name + THREADS]
            place = self.document.at(edge.node, "target", name)
            if not close:
                if edge.node not in self.left_out:
                    self.left_out.add(edge.node)
                    self.report.report("unknown-state", place, name=name)
                return None
            fault = f"no state has the id `{name}`: `{close[0]}` is used"
            self.report.report("repaired-dialect", place, fault=fault)
            name = close[0]
            found = self.known[name]
        if len(found) == 1:
            return found[0]
        first_in = self.first_in.get(name)
        if first_in is None:
            first_in = self.first_in[name] = {}
            for each in found:
                for level in (each, *each.ancestors()):
                    first_in.setdefault(level, each)
        return next(first_in[e] for e in (source, *source.ancestors()) if e in first_in)

    def _leave_out(self, node: Node, what: str, reason: str, attribute: str = "") -> None:
        """Report an element once; a transition with several events has several edges."""
        if node not in self.left_out:
            self.left_out.add(node)
            place = self.document.at(node, attribute)
            self.report.report("left-out", place, what=what, reason=reason)


def _common_entry(targets: list[PartialState]) -> PartialState | None:
    """Single state whose entry enters all targets; None if there is none.

    This is one of the targets if the others are initial states of their regions, or the parallel
    state.
    """
    if len(targets) == 1:
        return targets[0]
    around = [each for each in targets[0].ancestors() if all(_is_in(t, each) for t in targets)]
    if not around or around[0].kind is not StateKind.PARALLEL:
        return None
    parallel = around[0]
    for candidate in (parallel, *targets):
        if set(targets) <= set(_entered(candidate, parallel)):
            return candidate
    return None


def _entered(target: PartialState, parallel: PartialState) -> Iterable[PartialState]:
    """Yield the states that are entered with a target inside a parallel state."""
    path = [target]
    while path[-1] is not parallel:
        outer = path[-1].parent
        assert outer is not None
        path.append(outer)
    for inner, outer in zip([None, *path], path, strict=False):
        yield outer
        if inner is None:
            yield from _entered_below(outer)
        elif outer.kind is StateKind.PARALLEL:
            for region in outer.children:
                if region is not inner:
                    yield region
                    yield from _entered_below(region)


def _entered_below(draft: PartialState) -> Iterable[PartialState]:
    """Yield the states that are entered by default below a state."""
    if draft.kind is StateKind.PARALLEL:
        inside = draft.children
    else:
        inside = [draft.initial] if draft.initial is not None else []
    for each in inside:
        between = each.parent
        while between is not None and between is not draft:
            yield between
            between = between.parent
        yield each
        yield from _entered_below(each)


def _exits_same_states(
    source: PartialState, target: PartialState, targets: list[PartialState]
) -> bool:
    """Return True if `target` exits the same states as all targets together."""
    around = next(e for e in targets[0].ancestors() if all(_is_in(t, e) for t in targets))
    return target is around or source is around or not _is_in(source, around)


def _is_in(draft: PartialState, level: PartialState) -> bool:
    return draft is level or level in draft.ancestors()
