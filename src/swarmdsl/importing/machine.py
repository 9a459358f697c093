"""One document as a state machine."""

from __future__ import annotations

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.importing.activities import Activities
from swarmdsl.importing.calls import Call
from swarmdsl.importing.conditions import expression, tree_of
from swarmdsl.importing.drafts import OUTCOMES, Draft, Edge
from swarmdsl.importing.events import Events
from swarmdsl.importing.names import is_plain, type_names, value_names
from swarmdsl.ir import (
    Assignment,
    DoneTrigger,
    Effect,
    EventTrigger,
    Expression,
    Literal,
    OutcomeTrigger,
    Send,
    State,
    StateKind,
    StateMachine,
    Transition,
    Trigger,
    Type,
    Variable,
)
from swarmdsl.ir.types import BOOL
from swarmdsl.scxml.document import Document, Node


class _LeftOutError(Exception):
    """Something has no place in a model; `reason` says why."""

    def __init__(self, reason: str) -> None:
        self.reason = reason


class MachineMaker:
    """Makes the machine of one document."""

    def __init__(
        self,
        document: Document,
        events: Events,
        activities: Activities,
        report: Diagnostics,
    ) -> None:
        self.document = document
        self.events = events
        self.activities = activities
        self.report = report
        self.types: dict[str, Type] = {}
        self.first: dict[str, Expression] = {}
        self.variables = value_names()
        self.paths: dict[Draft, str] = {}
        self.wrapped: set[Draft] = set()
        self.targets: set[Draft | None] = set()

    def machine(self, top: Draft, name: str) -> StateMachine:
        """The machine; all that is not taken over is reported."""
        self._read_data(top.node)
        for draft in top.walk():
            self.targets |= {draft.initial, *(edge.target for edge in draft.edges)}
        self._name(top)
        states = self._states(top, "")
        assert top.initial is not None
        for key, type_ in self.activities.keys.items():
            self.types.setdefault(key, type_)
        return StateMachine(
            name,
            self.paths[top.initial],
            states,
            tuple(
                Variable(self.variables.of(each), type_, self.first.get(each))
                for each, type_ in self.types.items()
            ),
            endless=not any(child.kind is StateKind.FINAL for child in top.children),
        )

    def _read_data(self, root: Node) -> None:
        for model in root.children:
            for data in model.children if model.name == "datamodel" else ():
                name, value = data.get("id", ""), data.get("expr", data.text.strip())
                tree = tree_of(value)
                known = expression(tree, {}, str) if tree is not None else None
                if not is_plain(name) or not isinstance(known, Literal):
                    reason = f"`{value}` is no number, text or truth value"
                    self._left_out(data, f"data `{name}`", reason)
                    continue
                self.first[name] = known
                self.types[name] = known.type

    def _name(self, top: Draft) -> None:
        names = type_names()
        for draft in top.walk():
            if draft is top:
                continue
            draft.name = names.new(draft.id or draft.kind.value)
            if draft.id and not is_plain(draft.id):
                place = self.document.at(draft.node, "id")
                self.report.report("renamed", place, name=draft.id, new=draft.name)
        self._place(top, "")

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
        return not plain or bool(draft.edges or draft.entry or draft.exit)

    def _states(self, outer: Draft, path: str) -> tuple[State, ...]:
        parallel = outer.kind is StateKind.PARALLEL
        return tuple(
            self._region(each) if parallel else self._state(each) for each in outer.children
        )

    def _region(self, draft: Draft) -> State:
        state = self._state(draft)
        if draft not in self.wrapped:
            return State(
                state.id, state.name, StateKind.REGION, initial=state.initial, states=state.states
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
        activity = None
        if isinstance(draft.call, Call):
            activity = self.activities.activity(draft.call, self.variables)
        transitions = self._transitions(draft)
        if draft.kind is StateKind.HISTORY:
            transitions = transitions[:1] or self._to_first(draft)
        return State(
            path,
            draft.name,
            draft.kind,
            initial=self.paths[draft.initial] if draft.initial is not None else None,
            states=self._states(draft, path),
            transitions=transitions,
            activity=activity,
            entry=self._effects(draft.entry),
            exit=self._effects(draft.exit),
            deep=draft.node.get("type") == "deep",
        )

    def _to_first(self, draft: Draft) -> tuple[Transition, ...]:
        assert draft.parent is not None
        target = draft.parent.initial or draft.parent.children[0]
        return (Transition((), None, (), self.paths[target]),)

    def _transitions(self, draft: Draft) -> tuple[Transition, ...]:
        together: dict[tuple[Node, Draft | None], list[Edge]] = {}
        for edge in draft.edges:
            together.setdefault((edge.node, edge.target), []).append(edge)
        made = []
        for edges in together.values():
            try:
                made.append(self._transition(edges, draft))
            except _LeftOutError as fault:
                self._left_out(edges[0].node, "this transition", fault.reason)
        return tuple(made)

    def _transition(self, edges: list[Edge], draft: Draft) -> Transition:
        """The transition that an element is; each of its events is an edge."""
        edge = edges[0]
        triggers = tuple(dict.fromkeys(t for each in edges for t in self._triggers(each, draft)))
        copied = edge.node.name != "transition"
        cond = edge.node.get("cond") if not copied else None
        guard = self._expression(cond, edge.node, "cond") if cond else None
        effects = self._effects(edge.node.children) if not copied else ()
        target = self.paths[edge.target] if edge.target is not None else None
        if target is None and not effects:
            raise _LeftOutError("it leads nowhere and does nothing")
        at_once = draft.kind is StateKind.SIMPLE and draft.call is None
        waits = bool(triggers) or guard is not None or draft.kind is StateKind.HISTORY
        if not waits and (target is None or not at_once):
            guard = Literal(True, BOOL)
        internal = edge.node.get("type") == "internal" and draft.kind is StateKind.COMPOSITE
        internal = internal and edge.target in list(draft.walk())[1:]
        return Transition(triggers, guard, effects, target, internal)

    def _triggers(self, edge: Edge, draft: Draft) -> tuple[Trigger, ...]:
        event = edge.event
        path = self.paths[draft]
        if event is None:
            return ()
        if event in OUTCOMES:
            return (OutcomeTrigger(path, event),) if isinstance(draft.call, Call) else ()
        if event.startswith("done.state."):
            return (self._done(event.removeprefix("done.state."), draft),)
        if event.startswith(("done.", "error.")):
            raise _LeftOutError(f"a model has no event `{event}`")
        names = self.events.meant_by(event)
        if not names:
            raise _LeftOutError(f"no event is called `{event}`")
        return tuple(map(EventTrigger, names))

    def _done(self, identifier: str, draft: Draft) -> Trigger:
        if identifier in draft.ids and draft.children:
            return DoneTrigger(self.paths[draft], None)
        for child in draft.children if draft.kind is StateKind.PARALLEL else ():
            if identifier in child.ids and child not in self.wrapped:
                return DoneTrigger(self.paths[child], None)
        raise _LeftOutError(f"the end of `{identifier}` is known there only")

    def _expression(self, text: str, node: Node, attribute: str) -> Expression:
        tree = tree_of(text)
        if tree is None:
            raise _LeftOutError(f"`{text}` has no meaning in a model")
        known = set(self.types)
        made = expression(tree, self.types, self.variables.of)
        for name, type_ in self.types.items():
            if name not in known:
                place = self.document.at(node, attribute)
                what = f"nothing is said of `{name}`"
                self.report.report("assumed", place, what=what, assumed=f"a variable of `{type_}`")
        return made

    def _effects(self, nodes: list[Node]) -> tuple[Effect, ...]:
        made: list[Effect] = []
        for node in nodes:
            try:
                made.append(self._effect(node))
            except _LeftOutError as fault:
                self._left_out(node, f"`<{node.name}>`", fault.reason)
        return tuple(made)

    def _effect(self, node: Node) -> Effect:
        if node.name == "assign" and is_plain(node.get("location", "")):
            value = self._expression(node.get("expr", node.text.strip()), node, "expr")
            name = node.attributes["location"]
            self.types.setdefault(name, getattr(value, "type", None) or BOOL)
            return Assignment(self.variables.of(name), (), value)
        event = self.events.known.get(node.get("event", ""))
        others = set(node.attributes) - {"event", "id"}
        if node.name in ("send", "raise") and event is not None and not others:
            if node.children:
                raise _LeftOutError("it carries data")
            return Send(event.name, ())
        raise _LeftOutError("a model has no such effect")

    def _left_out(self, node: Node, what: str, reason: str) -> None:
        self.report.report("left-out", self.document.at(node), what=what, reason=reason)
