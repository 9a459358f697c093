"""Convert a document to a state machine."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.scxml.document import Document, Node
from swarmdsl.importing.activities import Activities
from swarmdsl.importing.calls import Call
from swarmdsl.importing.content import ExecutableContent, all_of
from swarmdsl.importing.data import MachineData
from swarmdsl.importing.events import Events
from swarmdsl.importing.expressions import UnsupportedError
from swarmdsl.importing.names import is_plain, type_names
from swarmdsl.importing.partial_states import Edge, PartialState
from swarmdsl.importing.portable import PortableDescription, comment_of, doc_of, docs_of
from swarmdsl.importing.scxml_patterns import FinalEvents
from swarmdsl.importing.triggers import Triggers
from swarmdsl.ir import (
    Activity,
    Assignment,
    EventTrigger,
    Expression,
    Literal,
    OutcomeTrigger,
    State,
    StateKind,
    StateMachine,
    Transition,
    Trigger,
)
from swarmdsl.syntax.types import BOOL


class MachineBuilder:
    """Converts one document to a state machine."""

    def __init__(
        self,
        document: Document,
        top: PartialState,
        described: PortableDescription,
        events: Events,
        ends: FinalEvents,
        activities: Activities,
        report: Diagnostics,
    ) -> None:
        self.document = document
        self.top = top
        self.events = events
        self.described = described
        self.activities = activities
        self.report = report
        self.paths: dict[PartialState, str] = {}
        self.data = MachineData(document, top, described, activities.library, report, self.paths)
        self.content = ExecutableContent(document, events, self.data, report)
        self.wrapped: set[PartialState] = set()
        self.targets = {
            target
            for draft in top.walk()
            for target in (draft.initial, *(edge.target for edge in draft.edges))
        }
        self.triggers = Triggers(events, ends, self.paths, self.wrapped, self.data)
        # Exit effects run before those of the transition.
        left = [node for draft in top.walk() for node in draft.exit]
        self.changed_on_exit = self.content.changed(left)
        self._known_heard: dict[PartialState, Mapping[str, set[Node]]] = {}

    def machine(self, name: str) -> StateMachine:
        """State machine of the document; unsupported content is reported."""
        top = self.top
        self._name()
        states = self._states(top, "")
        assert top.initial is not None
        for key, type_ in self.activities.keys.items():
            self.data.types.setdefault(key, type_)
        endless = not any(child.kind is StateKind.FINAL for child in top.children)
        return StateMachine(
            name,
            self.paths[top.initial],
            states,
            self.data.variables(),
            self.data.params(),
            endless=self.described.endless if self.described else endless,
            doc=self.described.doc,
            docs=docs_of(top),
        )

    def _name(self) -> None:
        names = type_names()
        given: set[tuple[PartialState | None, str]] = set()
        for draft in self.top.walk():
            if draft is self.top:
                continue
            vertex = draft.payload_node("vertex")
            exact = vertex.get("name", draft.id) if vertex is not None else draft.id
            if self.described and is_plain(exact) and (draft.parent, exact) not in given:
                given.add((draft.parent, exact))
                draft.name = exact
                continue
            draft.name = names.new(draft.id or draft.kind.value)
            if draft.id and not is_plain(draft.id):
                place = self.document.at(draft.node, "id")
                self.report.report("renamed", place, name=draft.id, new=draft.name)
        self._place(self.top, "")

    def _place(self, outer: PartialState, path: str) -> None:
        for draft in outer.children:
            inside = path
            if outer.kind is StateKind.PARALLEL and self._needs_region(draft):
                self.wrapped.add(draft)
                inside = f"{path}{draft.name}Region."
            self.paths[draft] = f"{inside}{draft.name}"
            self._place(draft, f"{inside}{draft.name}.")

    def _needs_region(self, draft: PartialState) -> bool:
        """Return True if a state has more than a region can have."""
        plain = draft.kind is StateKind.COMPOSITE and draft not in self.targets
        does = draft.edges or draft.entry or draft.exit or draft in self.data.tested
        does = does or draft.payload_node("defer") is not None
        return not plain or bool(does)

    def _states(self, outer: PartialState, path: str) -> tuple[State, ...]:
        parallel = outer.kind is StateKind.PARALLEL
        return tuple(
            self._region(each) if parallel else self._state(each) for each in outer.children
        )

    def _region(self, draft: PartialState) -> State:
        state = self._state(draft)
        if draft not in self.wrapped:
            return State(
                *(state.id, state.name, StateKind.REGION),
                initial=state.initial,
                states=state.states,
                doc=state.doc,
                docs=state.docs,
            )
        return State(
            state.id.removesuffix(f".{state.name}"),
            f"{state.name}Region",
            StateKind.REGION,
            initial=state.id,
            states=(state,),
        )

    def _state(self, draft: PartialState) -> State:
        path = self.paths[draft]
        transitions = self._transitions(draft)
        if draft.kind is StateKind.HISTORY:
            transitions = self._default(draft)
        submachine = draft.payload_node("submachine")
        return State(
            path,
            draft.name,
            draft.kind,
            initial=self.paths[draft.initial] if draft.initial is not None else None,
            states=self._states(draft, path),
            transitions=transitions,
            activity=self._activity(draft),
            entry=self.content.effects(draft.entry),
            exit=self.content.effects(draft.exit),
            deferred=self._deferred(draft),
            submachine=submachine.get("name") if submachine is not None else None,
            deep=draft.node.get("type") == "deep",
            doc=doc_of(draft.payload) or comment_of(draft.node),
            docs=docs_of(draft),
        )

    def _deferred(self, draft: PartialState) -> tuple[EventTrigger, ...]:
        """Return the events that a state defers, as the portable profile describes."""
        found = []
        for node in draft.payload:
            for name in node.get("event", "").split() if node.name == "defer" else ():
                if name in self.events.known:
                    found.append(EventTrigger(self.events.known[name].name))
                else:
                    self.content.left_out(node, f"deferred event `{name}`", "it is unknown")
        return tuple(found)

    def _activity(self, draft: PartialState) -> Activity | None:
        if isinstance(draft.call, Call):
            return self.activities.activity(draft.call, self.data.names)
        description = draft.payload_node("activity")
        return (
            self.activities.portable_activity(description, self.data)
            if description is not None
            else None
        )

    def _default(self, draft: PartialState) -> tuple[Transition, ...]:
        """Default transition of a history."""
        assert draft.parent is not None
        target = draft.parent.initial or draft.parent.children[0]
        for edge in draft.edges[:1]:
            target = edge.target or target
            for node in edge.actions:
                reason = "the default transition of a history has no effects in a model"
                self.content.left_out(node, f"`<{node.name}>`", reason)
        return (Transition((), None, (), self.paths[target]),)

    def _transitions(self, draft: PartialState) -> tuple[Transition, ...]:
        if draft.kind is StateKind.HISTORY:
            return ()
        together: dict[tuple[Node, PartialState | None], list[Edge]] = {}
        for edge in draft.edges:
            together.setdefault((edge.node, edge.target), []).append(edge)
        made: list[Transition] = []
        for edges in together.values():
            try:
                made += self._of_element(edges, draft)
            except UnsupportedError as fault:
                self.content.left_out(edges[0].node, "this transition", fault.reason)
        return tuple(made)

    def _of_element(self, edges: list[Edge], draft: PartialState) -> Iterator[Transition]:
        """Yield the transitions of an element, which has an edge for each of its events."""
        edge = edges[0]
        triggers = self.triggers.of(edges, draft)
        copied = edge.node.name != "transition"
        event = self.triggers.message(triggers)
        guard = self.data.condition(edge.node, event) if not copied else None
        target = self.paths[edge.target] if edge.target is not None else None
        inside = edge.target is not None and draft in edge.target.ancestors()
        internal = inside and (
            edge.node.get("type") == "internal"
            if draft.kind is StateKind.COMPOSITE
            else draft.kind is StateKind.PARALLEL and edge.content is not None
        )
        actions = edge.actions if not copied else []
        paths = list(
            self.content.paths_through(actions, event, self.changed_on_exit if target else set())
        )
        for conditions, nodes in paths:
            effects = self.content.effects(nodes, event)
            stays = all(isinstance(trigger, OutcomeTrigger) for trigger in triggers)
            if target is None and not effects and (guard or conditions or not stays):
                if not self._blocks_others(edges, draft):
                    if len(paths) > 1:
                        continue
                    raise UnsupportedError("it has neither target nor effects")
                effects = (Assignment(self.data.ignored, (), Literal(True, BOOL)),)
                fault = "it only blocks other transitions: an assignment is added"
                place = self.document.at(edge.node)
                self.report.report("repaired-dialect", place, fault=fault)
            yield Transition(
                triggers,
                self._guard([*([guard] if guard else []), *conditions], triggers, target, draft),
                effects,
                target,
                internal,
                comment_of(edge.node),
            )

    def _blocks_others(self, edges: list[Edge], draft: PartialState) -> bool:
        """Return True if the edges prevent another transition."""
        own = {name for edge in edges if edge.event for name in self.events.matching(edge.event)}
        inner = self._heard(draft)
        return any(
            inner.get(name, set()) - {edges[0].node}
            or any(name in self._heard(outer) for outer in draft.ancestors())
            for name in own
        )

    def _heard(self, draft: PartialState) -> Mapping[str, set[Node]]:
        """Return the elements of a state that handle an event, by its name."""
        if draft not in self._known_heard:
            found: dict[str, set[Node]] = {}
            for edge in draft.edges:
                for name in self.events.matching(edge.event) if edge.event else ():
                    found.setdefault(name, set()).add(edge.node)
            self._known_heard[draft] = found
        return self._known_heard[draft]

    def _guard(
        self,
        guards: list[Expression],
        triggers: tuple[Trigger, ...],
        target: str | None,
        draft: PartialState,
    ) -> Expression | None:
        """Guard of a transition.

        Without triggers and conditions, it is `true` unless the state is left immediately.
        """
        if guards or triggers or draft.kind is StateKind.CHOICE:
            return all_of(guards)
        at_once = draft.kind is StateKind.SIMPLE and draft.call is None
        at_once = at_once and draft.payload_node("activity") is None
        return None if at_once and target is not None else Literal(True, BOOL)
