"""The states of a document on their way to a machine: they may still be folded and renamed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from swarmdsl.diagnostics import Diagnostics, Label
from swarmdsl.importing.calls import Call, Calls, Monitor
from swarmdsl.ir import StateKind
from swarmdsl.scxml.document import Document, Node

OUTCOMES = ("succeeded", "aborted", "preempted")

_KINDS = {
    "state": StateKind.SIMPLE,
    "parallel": StateKind.PARALLEL,
    "final": StateKind.FINAL,
    "history": StateKind.HISTORY,
}
_KNOWN = {"transition", "onentry", "onexit", "initial", "datamodel", "invoke", *_KINDS}
_OF_CALLS = {"rosaction", "rosservice", "rosmonitor", "name", "action", "srv"}
_OF_CALLS |= {"goal", "result", "request", "response", "topic", "msg", "mappings"}
_THREADS, _BEHAVIOR = "Threads", "Behavior"


@dataclass(frozen=True)
class Edge:
    """A transition: one descriptor of an event (None for none), and where it leads."""

    node: Node
    event: str | None
    target: Draft | None = None


@dataclass(eq=False)
class Draft:
    """A state; `ids` are those of all elements that it was made of."""

    node: Node
    id: str
    kind: StateKind
    parent: Draft | None = None
    ids: list[str] = field(default_factory=list)
    children: list[Draft] = field(default_factory=list)
    monitors: list[Monitor] = field(default_factory=list)
    edges: list[Edge] = field(default_factory=list)
    call: Call | Monitor | None = None
    initial: Draft | None = None
    entry: list[Node] = field(default_factory=list)
    exit: list[Node] = field(default_factory=list)
    name: str = ""

    def walk(self) -> Iterator[Draft]:
        """Yield it and all inside it, in document order."""
        yield self
        for child in self.children:
            yield from child.walk()

    def around(self) -> Iterator[Draft]:
        """Yield the states around it, the inner first."""
        outer = self.parent
        while outer is not None:
            yield outer
            outer = outer.parent


def read_drafts(document: Document, report: Diagnostics) -> Draft:
    """The states of a document, as what is inside of a state that stands for the machine."""
    reader = _Reader(document, report)
    top = reader.draft(document.root, None)
    _fold(top)
    top.kind = StateKind.COMPOSITE
    reader.resolve(top)
    return top


class _Reader:
    def __init__(self, document: Document, report: Diagnostics) -> None:
        self.document = document
        self.report = report
        self.calls = Calls(document, report)
        self.foreign: set[str] = set()

    def draft(self, node: Node, parent: Draft | None) -> Draft:
        kind = _KINDS.get(node.name, StateKind.COMPOSITE)
        identifier = node.get("id", "").strip()
        draft = Draft(node, identifier, kind, parent, [identifier] if identifier else [])
        for child in node.children:
            if child.namespace != self.document.root.namespace:
                if child.namespace not in self.foreign:
                    self.foreign.add(child.namespace)
                    self._left_out(child, f"`<{child.name}>`", "it is no SCXML")
            elif child.name in _KINDS:
                draft.children.append(self.draft(child, draft))
            elif child.name == "transition":
                draft.edges += self._edges(child)
            elif child.name in ("onentry", "onexit"):
                (draft.entry if child.name == "onentry" else draft.exit).extend(child.children)
            elif child.name not in _KNOWN and (child.name not in _OF_CALLS or parent is None):
                self._left_out(child, f"`<{child.name}>`", "there is nothing like it in a model")
        if parent is None or kind in (StateKind.FINAL, StateKind.HISTORY):
            self._drop(draft)
        if kind is StateKind.SIMPLE and draft.children:
            draft.kind = StateKind.COMPOSITE
        if kind is StateKind.PARALLEL and not draft.children:
            draft.kind = StateKind.SIMPLE
        if parent is not None and kind in (StateKind.SIMPLE, StateKind.PARALLEL):
            draft.call = self.calls.read(node)
            if draft.call is not None and draft.children:
                reason = "a state with states inside does nothing itself"
                self._left_out(draft.call.node, "this call", reason)
                draft.call = None
        return draft

    def _drop(self, draft: Draft) -> None:
        """Report and forget what only states that are stayed in can have."""
        reason = f"`<{draft.node.name}>` has none in a model"
        for node in (*draft.entry, *draft.exit):
            self._left_out(node, f"`<{node.name}>`", reason)
        draft.entry, draft.exit = [], []
        if draft.kind is not StateKind.HISTORY:
            for edge in draft.edges:
                self._left_out(edge.node, "this transition", reason)
            draft.edges = []

    def _edges(self, node: Node) -> Iterator[Edge]:
        events: list[str | None] = [*node.get("event", "").split()]
        for event in events or [None]:
            yield Edge(node, event)

    def resolve(self, top: Draft) -> None:
        """Find what transitions lead to, and where states begin."""
        known: dict[str, list[Draft]] = {}
        for draft in top.walk():
            for each in draft.ids:
                known.setdefault(each, []).append(draft)
        for identifier, drafts in known.items():
            for other in drafts[1:]:
                self.report.report(
                    "repaired-dialect",
                    self.document.at(other.node, "id"),
                    related=(Label(self.document.at(drafts[0].node, "id"), "the first"),),
                    fault=f"the id `{identifier}` is given twice: transitions lead to the nearest",
                )
        for draft in top.walk():
            if draft.children and draft.kind is StateKind.COMPOSITE:
                draft.initial = self._initial(draft, known)
            edges = [self._resolved(edge, draft, known) for edge in draft.edges]
            draft.edges = [edge for edge in edges if edge is not None]

    def _initial(self, draft: Draft, known: dict[str, list[Draft]]) -> Draft:
        inside = [each for each in draft.walk() if each is not draft]
        first = next((e for e in draft.children if e.kind is not StateKind.HISTORY), inside[0])
        node, attribute = draft.node, "initial"
        for child in draft.node.children:
            if child.name == "initial" and child.children:
                node, attribute = child.children[0], "target"
        wanted = node.get(attribute, "").split()
        if not wanted:
            return first
        found = [each for each in known.get(wanted[0], ()) if each in inside]
        if len(wanted) > 1 or not found:
            fault = f"no state inside has the id `{wanted[0]}`"
            if len(wanted) > 1:
                fault = "it begins in several states"
            fault += f": `{first.id}` is the first"
            self.report.report("repaired-dialect", self.document.at(node, attribute), fault=fault)
            return first
        return found[0]

    def _resolved(self, edge: Edge, source: Draft, known: dict[str, list[Draft]]) -> Edge | None:
        wanted = edge.node.get("target", "").split()
        if len(wanted) > 1:
            self._left_out(edge.node, "this transition", "it leads to several states", "target")
            return None
        if not wanted:
            if edge.node.children:
                return edge
            self._left_out(edge.node, "this transition", "it leads nowhere and does nothing")
            return None
        name = wanted[0]
        found = known.get(name)
        if found is None:
            close = [id_ for id_ in known if id_.casefold() == name.casefold()]
            close += [id_ for id_ in known if id_ == name + _THREADS]
            if not close:
                place = self.document.at(edge.node, "target")
                self.report.report("unknown-state", place, name=name)
                return None
            found = known[close[0]]
            fault = f"no state has the id `{name}`: `{close[0]}` is meant"
            place = self.document.at(edge.node, "target")
            self.report.report("repaired-dialect", place, fault=fault)
        for level in (source, *source.around()):
            near = [each for each in found if each in level.walk()]
            if near:
                break
        if level is not source and level is not near[0] and level.kind is StateKind.PARALLEL:
            reason = "it leads from one region into another"
            self._left_out(edge.node, "this transition", reason, "target")
            return None
        return replace(edge, target=near[0])

    def _left_out(self, node: Node, what: str, reason: str, attribute: str = "") -> None:
        place = self.document.at(node, attribute)
        self.report.report("left-out", place, what=what, reason=reason)


def _fold(draft: Draft) -> None:
    """Make one state of a state and the monitors beside it; monitors alone are a state too."""
    for child in draft.children:
        _fold(child)
    if draft.kind is not StateKind.PARALLEL:
        return
    others = [each for each in draft.children if not isinstance(each.call, Monitor)]
    for child in draft.children:
        if isinstance(child.call, Monitor):
            draft.monitors.append(child.call)
            draft.ids += child.ids
            # What a monitor itself leads to is as good on what it stands in.
            draft.edges += child.edges
    draft.children = others
    idiom = bool(draft.monitors) or draft.id.endswith(_THREADS)
    if len(others) > 1 or (others and not idiom):
        return
    if not others:
        draft.kind = StateKind.SIMPLE
        draft.id = draft.id.removesuffix(_THREADS)
        return
    (behavior,) = others
    draft.kind = behavior.kind
    draft.ids += behavior.ids
    name = behavior.id.removesuffix(_BEHAVIOR)
    draft.id = name if name else draft.id.removesuffix(_THREADS)
    draft.node = behavior.node if behavior.node.get("initial") else draft.node
    draft.call = behavior.call
    draft.monitors += behavior.monitors
    draft.edges = [*behavior.edges, *draft.edges]
    draft.entry += behavior.entry
    draft.exit = [*behavior.exit, *draft.exit]
    draft.children = behavior.children
    for child in draft.children:
        child.parent = draft
