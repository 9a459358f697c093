"""What transitions lead to, and where states begin."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.records import replace
from swarmdsl.execution.scxml.document import Document, Node
from swarmdsl.importing.partial_states import THREADS, Draft, Edge
from swarmdsl.ir import StateKind


def resolve(top: Draft, document: Document, report: Diagnostics) -> None:
    """Find the targets of all transitions and the first states; report what cannot be found."""
    resolver = _Resolver(document, report, top)
    # What is entered first in a state decides about those around it.
    for draft in reversed(list(top.walk())):
        if draft.children and draft.kind is StateKind.COMPOSITE:
            draft.initial = resolver.initial(draft)
    for draft in top.walk():
        edges = [resolver.resolved(edge, draft) for edge in draft.edges]
        draft.edges = [edge for edge in edges if edge is not None]


class _Resolver:
    def __init__(self, document: Document, report: Diagnostics, top: Draft) -> None:
        self.document = document
        self.report = report
        self.known: dict[str, list[Draft]] = {}
        self.left_out: set[Node] = set()
        # Of an id that is given twice, the first state that has it in each other.
        self.first_in: dict[str, dict[Draft, Draft]] = {}
        for draft in top.walk():
            self._leave_histories(draft)
            for each in draft.ids:
                self.known.setdefault(each, []).append(draft)
        for identifier, drafts in self.known.items():
            for other in drafts[1:]:
                report.report(
                    "repaired-dialect",
                    document.at(other.node, "id"),
                    related=(Label(document.at(drafts[0].node, "id"), "the first"),),
                    fault=f"the id `{identifier}` is given twice: transitions lead to the nearest",
                )

    def _leave_histories(self, draft: Draft) -> None:
        """Leave out those beside regions, whose states remember nothing together in a model."""
        if draft.kind is not StateKind.PARALLEL:
            return
        for child in draft.children:
            if child.kind is StateKind.HISTORY:
                reason = "a parallel state has none in a model, only its regions do"
                self._leave_out(child.node, "this history", reason)
        draft.children = [each for each in draft.children if each.kind is not StateKind.HISTORY]

    def initial(self, draft: Draft) -> Draft:
        """What is entered first in a state."""
        first = next((e for e in draft.children if e.kind is not StateKind.HISTORY), None)
        first = first or draft.children[0]
        node, attribute = draft.node, "initial"
        for child in draft.node.children:
            if child.name == "initial" and child.children:
                node, attribute = child.children[0], "target"
                for effect in node.children:
                    reason = "what is entered first does nothing on the way in a model"
                    self._leave_out(effect, f"`<{effect.name}>`", reason)
        wanted = node.get(attribute, "").split()
        if not wanted:
            return first
        found = [self._inside(name, draft) for name in wanted]
        fault = ""
        if None in found:
            fault = f"no state inside has the id `{wanted[found.index(None)]}`"
        else:
            one = _one([each for each in found if each is not None])
            if one is not None:
                return one
            fault = "it begins in several states"
        fault += f": `{first.id}` is the first"
        self.report.report("repaired-dialect", self.document.at(node, attribute), fault=fault)
        return first

    def _inside(self, name: str, draft: Draft) -> Draft | None:
        return next((e for e in self.known.get(name, ()) if draft in e.around()), None)

    def resolved(self, edge: Edge, source: Draft) -> Edge | None:
        """The edge with what it leads to; None where it cannot be one."""
        wanted = edge.node.get("target", "").split()
        if not wanted:
            return edge
        found = [self._nearest(name, edge, source) for name in wanted]
        targets = [each for each in found if each is not None]
        if len(targets) < len(wanted):
            return None
        target = _one(targets)
        if target is None or (len(targets) > 1 and not _leaves(source, target, targets)):
            self._leave_out(edge.node, "this transition", "it leads to several states", "target")
            return None
        level = next(each for each in (source, *source.around()) if _is_in(target, each))
        if level is not source and level is not target and level.kind is StateKind.PARALLEL:
            reason = "it leads from one region into another"
            self._leave_out(edge.node, "this transition", reason, "target")
            return None
        return replace(edge, target=target)

    def _nearest(self, name: str, edge: Edge, source: Draft) -> Draft | None:
        """The state of that name that has the least around it and the source."""
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
            fault = f"no state has the id `{name}`: `{close[0]}` is meant"
            self.report.report("repaired-dialect", place, fault=fault)
            name = close[0]
            found = self.known[name]
        if len(found) == 1:
            return found[0]
        first_in = self.first_in.get(name)
        if first_in is None:
            first_in = self.first_in[name] = {}
            for each in found:
                for level in (each, *each.around()):
                    first_in.setdefault(level, each)
        return next(first_in[e] for e in (source, *source.around()) if e in first_in)

    def _leave_out(self, node: Node, what: str, reason: str, attribute: str = "") -> None:
        """Report it, once for each element: a transition is an edge for each of its events."""
        if node not in self.left_out:
            self.left_out.add(node)
            place = self.document.at(node, attribute)
            self.report.report("left-out", place, what=what, reason=reason)


def _one(targets: list[Draft]) -> Draft | None:
    """The one state that is entered together with all of these; None where there is none.

    That is one of them, if the others are where their regions begin, or the parallel state.
    """
    if len(targets) == 1:
        return targets[0]
    around = [each for each in targets[0].around() if all(_is_in(t, each) for t in targets)]
    if not around or around[0].kind is not StateKind.PARALLEL:
        return None
    parallel = around[0]
    for candidate in (parallel, *targets):
        if set(targets) <= set(_entered(candidate, parallel)):
            return candidate
    return None


def _entered(target: Draft, parallel: Draft) -> Iterable[Draft]:
    """All that is entered with a target in a parallel state, or with that itself."""
    path = [target]
    while path[-1] is not parallel:
        outer = path[-1].parent
        assert outer is not None
        path.append(outer)
    for inner, outer in zip([None, *path], path, strict=False):
        yield outer
        if inner is None:
            yield from _below(outer)
        elif outer.kind is StateKind.PARALLEL:
            for region in outer.children:
                if region is not inner:
                    yield region
                    yield from _below(region)


def _below(draft: Draft) -> Iterable[Draft]:
    """All that is entered in a state that is a target itself."""
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
        yield from _below(each)


def _leaves(source: Draft, target: Draft, targets: list[Draft]) -> bool:
    """Whether a transition to the one leaves what that to all of these leaves."""
    around = next(e for e in targets[0].around() if all(_is_in(t, e) for t in targets))
    return target is around or source is around or not _is_in(source, around)


def _is_in(draft: Draft, level: Draft) -> bool:
    return draft is level or level in draft.around()
