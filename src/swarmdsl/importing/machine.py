"""One document as a state machine."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.scxml.document import Document, Node
from swarmdsl.importing.activities import Activities
from swarmdsl.importing.calls import Call
from swarmdsl.importing.content import Content, all_of
from swarmdsl.importing.data import MachineData
from swarmdsl.importing.events import Events
from swarmdsl.importing.expressions import UnsayableError
from swarmdsl.importing.names import is_plain, type_names
from swarmdsl.importing.partial_states import Draft, Edge
from swarmdsl.importing.portable import Described, comment_of, doc_of, docs_of
from swarmdsl.importing.scxml_patterns import Ends
from swarmdsl.importing.triggers import Triggers
from swarmdsl.ir import (
    Activity,
    Assignment,
    Expression,
    Literal,
    State,
    StateKind,
    StateMachine,
    Transition,
    Trigger,
)
from swarmdsl.syntax.types import BOOL


class MachineMaker:
    """Makes the machine of one document."""

    def __init__(
        self,
        document: Document,
        top: Draft,
        described: Described,
        events: Events,
        ends: Ends,
        activities: Activities,
        report: Diagnostics,
    ) -> None:
        self.document = document
        self.top = top
        self.events = events
        self.described = described
        self.activities = activities
        self.report = report
        self.data = MachineData(document, top, described, activities.library, report)
        self.content = Content(document, events, self.data, report)
        self.paths: dict[Draft, str] = {}
        self.wrapped: set[Draft] = set()
        self.targets = {
            target
            for draft in top.walk()
            for target in (draft.initial, *(edge.target for edge in draft.edges))
        }
        self.triggers = Triggers(events, ends, self.paths, self.wrapped, self.data)
        # What is left on the way may change before anything else is done.
        left = [node for draft in top.walk() for node in draft.exit]
        self.changed_on_exit = self.content.changed(left)

    def machine(self, name: str) -> StateMachine:
        """The machine; all that is not taken over is reported."""
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
        given: set[tuple[Draft | None, str]] = set()
        for draft in self.top.walk():
            if draft is self.top:
                continue
            vertex = draft.said("vertex")
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

    def _place(self, outer: Draft, path: str) -> None:
        for draft in outer.children:
            inside = path
            if outer.kind is StateKind.PARALLEL and self._needs_region(draft):
                self.wrapped.add(draft)
                inside = f"{path}{draft.name}Region."
            self.paths[draft] = f"{inside}{draft.name}"
            self._place(draft, f"{inside}{draft.name}.")

    def _needs_region(self, draft: Draft) -> bool:
        """Whether it is more than a region can be, which nothing leads to."""
        plain = draft.kind is StateKind.COMPOSITE and draft not in self.targets
        does = draft.edges or draft.entry or draft.exit or draft in self.data.active
        return not plain or bool(does)

    def _states(self, outer: Draft, path: str) -> tuple[State, ...]:
        parallel = outer.kind is StateKind.PARALLEL
        return tuple(
            self._region(each) if parallel else self._state(each) for each in outer.children
        )

    def _region(self, draft: Draft) -> State:
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

    def _state(self, draft: Draft) -> State:
        path = self.paths[draft]
        transitions = self._transitions(draft)
        if draft.kind is StateKind.HISTORY:
            transitions = self._default(draft)
        submachine = draft.said("submachine")
        active = self.data.active.get(draft)
        entry, exit_ = self.content.effects(draft.entry), self.content.effects(draft.exit)
        if active is not None:
            entry = (Assignment(active, (), Literal(True, BOOL)), *entry)
            exit_ = (*exit_, Assignment(active, (), Literal(False, BOOL)))
        return State(
            path,
            draft.name,
            draft.kind,
            initial=self.paths[draft.initial] if draft.initial is not None else None,
            states=self._states(draft, path),
            transitions=transitions,
            activity=self._activity(draft),
            entry=entry,
            exit=exit_,
            submachine=submachine.get("name") if submachine is not None else None,
            deep=draft.node.get("type") == "deep",
            doc=doc_of(draft.about) or comment_of(draft.node),
            docs=docs_of(draft),
        )

    def _activity(self, draft: Draft) -> Activity | None:
        if isinstance(draft.call, Call):
            return self.activities.activity(draft.call, self.data.names)
        said = draft.said("activity")
        return self.activities.said(said, self.data) if said is not None else None

    def _default(self, draft: Draft) -> tuple[Transition, ...]:
        """The transition of a history: where it leads the first time."""
        assert draft.parent is not None
        target = draft.parent.initial or draft.parent.children[0]
        for edge in draft.edges[:1]:
            target = edge.target or target
            for node in edge.does:
                reason = "nothing is done on the way in a model"
                self.content.left_out(node, f"`<{node.name}>`", reason)
        return (Transition((), None, (), self.paths[target]),)

    def _transitions(self, draft: Draft) -> tuple[Transition, ...]:
        if draft.kind is StateKind.HISTORY:
            return ()
        together: dict[tuple[Node, Draft | None], list[Edge]] = {}
        for edge in draft.edges:
            together.setdefault((edge.node, edge.target), []).append(edge)
        made: list[Transition] = []
        for edges in together.values():
            try:
                made += self._of_element(edges, draft)
            except UnsayableError as fault:
                self.content.left_out(edges[0].node, "this transition", fault.reason)
        return tuple(made)

    def _of_element(self, edges: list[Edge], draft: Draft) -> Iterator[Transition]:
        """The transitions that an element is; each of its events is an edge."""
        edge = edges[0]
        triggers = self.triggers.of(edges, draft)
        copied = edge.node.name != "transition"
        event = self.triggers.message(triggers)
        guard = self.data.condition(edge.node, event) if not copied else None
        target = self.paths[edge.target] if edge.target is not None else None
        inside = edge.target is not None and draft in edge.target.around()
        internal = inside and (
            edge.node.get("type") == "internal"
            if draft.kind is StateKind.COMPOSITE
            else draft.kind is StateKind.PARALLEL and edge.content is not None
        )
        does = edge.does if not copied else []
        ways = list(self.content.ways(does, event, self.changed_on_exit if target else set()))
        for conditions, nodes in ways:
            effects = self.content.effects(nodes, event)
            if target is None and not effects:
                if not self._holds_back(edges, draft):
                    if len(ways) > 1:
                        continue
                    raise UnsayableError("it leads nowhere and does nothing")
                effects = (Assignment(self.data.ignored, (), Literal(True, BOOL)),)
                fault = "it does nothing but keep other transitions from being taken: it assigns"
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

    def _holds_back(self, edges: list[Edge], draft: Draft) -> bool:
        """Whether another transition would be taken, were there none of these."""
        others = [e.event for e in draft.edges if e.node is not edges[0].node]
        others += [e.event for outer in draft.around() for e in outer.edges]
        heard = {name for event in others if event for name in self.events.meant_by(event)}
        own = {name for edge in edges if edge.event for name in self.events.meant_by(edge.event)}
        return bool(heard & own)

    def _guard(
        self,
        guards: list[Expression],
        triggers: tuple[Trigger, ...],
        target: str | None,
        draft: Draft,
    ) -> Expression | None:
        """What must hold; one without events says so, unless the state is left at once."""
        if guards or triggers or draft.kind is StateKind.CHOICE:
            return all_of(guards)
        at_once = draft.kind is StateKind.SIMPLE and draft.call is None
        at_once = at_once and draft.said("activity") is None
        return None if at_once and target is not None else Literal(True, BOOL)
