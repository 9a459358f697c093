"""The states of a document on their way to a machine: they may still be folded and renamed."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass, field
from swarmdsl.execution.scxml.document import Document, Node
from swarmdsl.execution.scxml.vocabulary import OURS
from swarmdsl.importing.calls import Call, Calls, Monitor
from swarmdsl.ir import StateKind

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
THREADS, _BEHAVIOR = "Threads", "Behavior"


@dataclass(frozen=True)
class Edge:
    """A transition: one descriptor of an event (None for none), and where it leads.

    `content` is the element that holds what it does, where that is another one.
    """

    node: Node
    event: str | None
    target: Draft | None = None
    content: Node | None = None

    @property
    def does(self) -> list[Node]:
        """The elements of what it does."""
        return (self.content or self.node).children


@dataclass(eq=False)
class Draft:
    """A state; `ids` are those of all elements that it was made of.

    `about` is what the portable profile says of it. `timers` are the delayed events that it sends
    itself when it is entered, by their names.
    """

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
    about: list[Node] = field(default_factory=list)
    timers: dict[str, Node] = field(default_factory=dict)
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

    def said(self, name: str) -> Node | None:
        """What the portable profile says of it under a name."""
        return next((node for node in self.about if node.name == name), None)


def read_drafts(document: Document, report: Diagnostics) -> Draft:
    """The states of a document, as what is inside of a state that stands for the machine."""
    top = _Reader(document, report).draft(document.root, None)
    if not top.about:
        _fold(top)
    top.kind = StateKind.COMPOSITE
    return top


def drop_rest(top: Draft, document: Document, report: Diagnostics) -> None:
    """Report and forget what only states that are stayed in can have."""
    for draft in top.walk():
        if draft is not top and draft.kind not in (StateKind.FINAL, StateKind.HISTORY):
            continue
        reason = f"`<{draft.node.name}>` has none in a model"
        for node in (*draft.entry, *draft.exit):
            report.report("left-out", document.at(node), what=f"`<{node.name}>`", reason=reason)
        draft.entry, draft.exit = [], []
        if draft.kind is StateKind.HISTORY:
            continue
        for node in dict.fromkeys(edge.node for edge in draft.edges):
            report.report("left-out", document.at(node), what="this transition", reason=reason)
        draft.edges = []


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
            if child.namespace == OURS:
                draft.about.append(child)
            elif child.namespace != self.document.root.namespace:
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
        if kind is StateKind.SIMPLE and draft.children:
            draft.kind = StateKind.COMPOSITE
        if kind is StateKind.PARALLEL and not draft.children:
            draft.kind = StateKind.SIMPLE
        vertex = draft.said("vertex")
        if vertex is not None and vertex.get("kind") == "choice":
            draft.kind = StateKind.CHOICE
        if parent is not None and kind in (StateKind.SIMPLE, StateKind.PARALLEL):
            draft.call = self.calls.read(node)
            if draft.call is not None and draft.children:
                reason = "a state with states inside does nothing itself"
                self._left_out(draft.call.node, "this call", reason)
                draft.call = None
        return draft

    def _edges(self, node: Node) -> Iterator[Edge]:
        events: list[str | None] = [*node.get("event", "").split()]
        for event in events or [None]:
            yield Edge(node, event)

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
    idiom = bool(draft.monitors) or draft.id.endswith(THREADS)
    if len(others) > 1 or (others and not idiom):
        return
    if not others:
        draft.kind = StateKind.SIMPLE
        draft.id = draft.id.removesuffix(THREADS)
        return
    (behavior,) = others
    draft.kind = behavior.kind
    draft.ids += behavior.ids
    name = behavior.id.removesuffix(_BEHAVIOR)
    draft.id = name if name else draft.id.removesuffix(THREADS)
    draft.node = behavior.node if behavior.node.get("initial") else draft.node
    draft.call = behavior.call
    draft.monitors += behavior.monitors
    draft.edges = [*behavior.edges, *draft.edges]
    draft.entry += behavior.entry
    draft.exit = [*behavior.exit, *draft.exit]
    draft.children = behavior.children
    for child in draft.children:
        child.parent = draft
