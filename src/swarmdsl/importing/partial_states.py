"""States of a document during import, which can still be merged and renamed."""

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
    """A transition with one event descriptor, None without event, and its target.

    `content` is the element with its executable content if that is not `node`.
    """

    node: Node
    event: str | None
    target: PartialState | None = None
    content: Node | None = None

    @property
    def actions(self) -> list[Node]:
        """Elements of the executable content."""
        return (self.content or self.node).children


@dataclass(eq=False)
class PartialState:
    """A state; `ids` are those of all elements that were merged into it.

    `about` is its description in the portable profile. `timers` are the delayed events that it
    sends to itself on entry, by name.
    """

    node: Node
    id: str
    kind: StateKind
    parent: PartialState | None = None
    ids: list[str] = field(default_factory=list)
    children: list[PartialState] = field(default_factory=list)
    monitors: list[Monitor] = field(default_factory=list)
    edges: list[Edge] = field(default_factory=list)
    call: Call | Monitor | None = None
    initial: PartialState | None = None
    entry: list[Node] = field(default_factory=list)
    exit: list[Node] = field(default_factory=list)
    payload: list[Node] = field(default_factory=list)
    timers: dict[str, Node] = field(default_factory=dict)
    name: str = ""

    def walk(self) -> Iterator[PartialState]:
        """Yield the state and its descendants in document order."""
        yield self
        for child in self.children:
            yield from child.walk()

    def ancestors(self) -> Iterator[PartialState]:
        """Yield the ancestors, innermost first."""
        outer = self.parent
        while outer is not None:
            yield outer
            outer = outer.parent

    def payload_node(self, name: str) -> Node | None:
        """Element of the portable profile with the given name."""
        return next((node for node in self.payload if node.name == name), None)


def read_partial_states(document: Document, report: Diagnostics) -> PartialState:
    """Read the states of a document, inside a state for the whole machine."""
    top = _Reader(document, report).draft(document.root, None)
    if not top.payload:
        _fold(top)
    top.kind = StateKind.COMPOSITE
    return top


def drop_unsupported(top: PartialState, document: Document, report: Diagnostics) -> None:
    """Report and remove content that final and history states cannot have."""
    for draft in top.walk():
        if draft is not top and draft.kind not in (StateKind.FINAL, StateKind.HISTORY):
            continue
        reason = f"`<{draft.node.name}>` cannot have it in a model"
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

    def draft(self, node: Node, parent: PartialState | None) -> PartialState:
        kind = _KINDS.get(node.name, StateKind.COMPOSITE)
        identifier = node.get("id", "").strip()
        draft = PartialState(node, identifier, kind, parent, [identifier] if identifier else [])
        for child in node.children:
            if child.namespace == OURS:
                draft.payload.append(child)
            elif child.namespace != self.document.root.namespace:
                if child.namespace not in self.foreign:
                    self.foreign.add(child.namespace)
                    self._left_out(child, f"`<{child.name}>`", "it is not SCXML")
            elif child.name in _KINDS:
                draft.children.append(self.draft(child, draft))
            elif child.name == "transition":
                draft.edges += self._edges(child)
            elif child.name in ("onentry", "onexit"):
                (draft.entry if child.name == "onentry" else draft.exit).extend(child.children)
            elif child.name not in _KNOWN and (child.name not in _OF_CALLS or parent is None):
                self._left_out(child, f"`<{child.name}>`", "it has no equivalent in a model")
        since = draft.payload_node("since")
        if since is not None:
            noted = since.get("location")
            draft.entry = [each for each in draft.entry if each.get("location") != noted]
        if kind is StateKind.SIMPLE and draft.children:
            draft.kind = StateKind.COMPOSITE
        if kind is StateKind.PARALLEL and not draft.children:
            draft.kind = StateKind.SIMPLE
        vertex = draft.payload_node("vertex")
        if vertex is not None and vertex.get("kind") == "choice":
            draft.kind = StateKind.CHOICE
        if parent is not None and kind in (StateKind.SIMPLE, StateKind.PARALLEL):
            draft.call = self.calls.read(node)
            if draft.call is not None and draft.children:
                reason = "a composite state has no activity"
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


def _fold(draft: PartialState) -> None:
    """Merge a parallel state with its monitors; monitors alone become a simple state."""
    for child in draft.children:
        _fold(child)
    if draft.kind is not StateKind.PARALLEL:
        return
    others = [each for each in draft.children if not isinstance(each.call, Monitor)]
    for child in draft.children:
        if isinstance(child.call, Monitor):
            draft.monitors.append(child.call)
            draft.ids += child.ids
            # Transitions of a monitor also work on the state that contains it.
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
