"""Convert SCXML states and transitions to tables of the engine."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.suggest import suggest
from swarmdsl.execution.engine import (
    Activity,
    Effect,
    Event,
    InstanceLike,
    Kind,
    Machine,
    State,
    TableError,
    Transition,
)
from swarmdsl.execution.scxml.attributes import nothing
from swarmdsl.execution.scxml.content import Content
from swarmdsl.execution.scxml.document import Document, Node
from swarmdsl.execution.scxml.ecmascript import Value
from swarmdsl.execution.scxml.session import session_of

_KINDS = {"parallel": Kind.PARALLEL, "final": Kind.FINAL}
_VERTICES = ("state", "parallel", "final", "history")
_OUTCOMES = ("succeeded", "aborted", "preempted")
# Values of attributes of <scxml>; the null data model is a part of that of ECMAScript.
_VALUES = {"binding": ("early", "late"), "datamodel": ("ecmascript", "null")}


def machine(document: Document, report: Diagnostics) -> Machine | None:
    """Return the machine of a document; None if it has errors."""
    root = document.root
    reader = _Reader(document, report)
    if not reader.ids:
        fault = "the document has no state"
        report.report("illegal-structure", document.at(root), fault=fault)
        return None
    reader.check_root()
    variables = reader.variables()
    setup = [*reader.first, *reader.scripts()]
    states = [reader.state(each) for each in root.children if each.name in _VERTICES]
    initial = reader.initial(root)
    if report.has_errors:
        return None
    try:
        return Machine(
            root.get("name") or "scxml",
            states,
            initial,
            data=lambda: dict.fromkeys(variables),
            setup=tuple(setup),
        )
    except TableError as error:
        place = reader.ids.get(error.id, root)
        report.report("illegal-structure", document.at(place, "id"), fault=str(error))
        return None


class _Reader:
    """Reader of the states of a document."""

    def __init__(self, document: Document, report: Diagnostics) -> None:
        self.document = document
        self.nodes = list(document.root.walk())
        self.report = report
        self.content = Content(document, report)
        self.ids: dict[str, Node] = {}
        self.names: dict[Node, str] = {}
        self.first: list[Effect] = []
        self.bound: dict[Node, list[Effect]] = {}
        unnamed: list[Node] = []
        for node in self.nodes:
            if node.name not in _VERTICES:
                continue
            id_ = node.get("id")
            if id_ is None:
                unnamed.append(node)
                continue
            self.names[node] = id_
            if id_ in self.ids:
                report.report(
                    "duplicate-id",
                    document.at(node, "id"),
                    name=id_,
                    related=(Label(document.at(self.ids[id_], "id"), "the first one"),),
                )
            else:
                self.ids[id_] = node
        for number, node in enumerate(unnamed, 1):
            # Ids cannot contain spaces, so that this one is unique.
            self.names[node] = f"state {number}"
            self.ids[self.names[node]] = node
        self.servers = {
            each.get("name"): each.get("server", "")
            for each in document.root.ours
            if each.name == "function"
        }

    def variables(self) -> list[str]:
        """Return all data ids; `first` and `bound` get the effects that initialize them."""
        found: dict[str, Node] = {}
        late = self.document.root.get("binding") == "late"
        for node in self.nodes:
            if node.name != "data":
                continue
            name = node.get("id") or ""
            if name in found:
                self.report.report(
                    "duplicate-id",
                    self.document.at(node, "id"),
                    name=name,
                    related=(Label(self.document.at(found[name], "id"), "the first one"),),
                )
            found.setdefault(name, node)
            value = self.content.value(node)
            assert node.parent is not None
            owner = node.parent.parent
            if value is nothing:
                continue
            if late and owner is not None and owner is not self.document.root:
                self.bound.setdefault(owner, []).append(_late_value(name, value))
            else:
                self.first.append(_first_value(name, value))
        return list(found)

    def scripts(self) -> Iterator[Effect]:
        """Yield the scripts of the document itself, which run before it enters a state."""
        for node in self.document.root.children:
            if node.name == "script":
                effect = self.content.script(node)
                if effect is not None:
                    yield effect

    def check_root(self) -> None:
        """Report values of attributes of the root that no document can have."""
        root = self.document.root
        for name, values in _VALUES.items():
            if root.get(name, values[0]) not in values:
                words = " or ".join(f"`{each}`" for each in values)
                self.report.report(
                    "bad-value", self.document.at(root, name), name=name, values=words
                )

    def state(self, node: Node) -> State:
        """Convert a state and its content."""
        id_, name = self.names[node], node.name
        if name == "history":
            depth = node.get("type") or "shallow"
            if depth not in ("shallow", "deep"):
                place = self.document.at(node, "type")
                self.report.report("bad-value", place, name="type", values="`shallow` or `deep`")
            default = self._only_transition(node)
            kind = Kind.DEEP_HISTORY if depth == "deep" else Kind.HISTORY
            return State(id_, kind, transitions=(default,) if default is not None else ())
        states: list[State] = []
        transitions: list[Transition] = []
        entry = list(self.bound.get(node, ()))
        leave: list[Effect] = []
        donedata = None
        leads_inside = "initial" in node.attributes
        for child in node.children:
            tag = child.name
            if tag in _VERTICES:
                states.append(self.state(child))
                leads_inside = True
            elif tag == "transition":
                transitions.append(self.transition(child))
            elif tag in ("onentry", "onexit"):
                effect = self.content.block(child)
                if effect is not None:
                    (entry if tag == "onentry" else leave).append(effect)
            elif tag == "donedata":
                donedata = self.content.data(child)
            elif tag == "initial":
                leads_inside = True
        return State(
            id_,
            _KINDS.get(name, Kind.STATE),
            tuple(states),
            self.initial(node) if leads_inside else (),
            tuple(transitions),
            tuple(entry),
            tuple(leave),
            self._activity(id_, node.ours) if node.ours else None,
            donedata,
            node.line,
            _deferred(node.ours),
        )

    def initial(self, node: Node) -> Transition | tuple[str, ...]:
        """Return the initial transition or states; empty for the first child."""
        inner = next((each for each in node.children if each.name == "initial"), None)
        if inner is None:
            targets = self._targets(node, "initial")
            self._check_inside(node, node, "initial", targets)
            return targets
        if node.get("initial") is not None:
            place = self.document.at(node, "initial")
            fault = "the initial state is given twice"
            self.report.report("illegal-structure", place, fault=fault)
        found = self._only_transition(inner)
        if found is None:
            return ()
        self._check_inside(node, inner.children[0], "target", found.targets)
        return found

    def transition(self, node: Node) -> Transition:
        """Convert a transition."""
        event, condition = node.get("event"), node.get("cond")
        if event is None and condition is None and node.get("target") is None:
            fault = "a transition without event, condition and target is an endless loop"
            self.report.report("illegal-structure", self.document.at(node), fault=fault)
        kind = node.get("type") or "external"
        if kind not in ("external", "internal"):
            place = self.document.at(node, "type")
            self.report.report("bad-value", place, name="type", values="`external` or `internal`")
        return Transition(
            tuple([_pattern(word) for word in event.split()]) if event is not None else (),
            self._targets(node, "target"),
            self.content.guard(node) if condition is not None else None,
            self.content.block(node) if node.children else None,
            kind == "internal",
            node.line,
        )

    def _only_transition(self, node: Node) -> Transition | None:
        """Return the only transition of a history or initial element, which has a target."""
        found = [child for child in node.children if child.name == "transition"]
        if len(found) != 1:
            place = self.document.at(found[1] if found else node)
            fault = f"`<{node.name}>` must have exactly one transition"
            self.report.report("illegal-structure", place, fault=fault)
            return None
        for attribute in ("event", "cond"):
            if found[0].get(attribute) is not None:
                place = self.document.at(found[0], attribute)
                fault = f"the transition of `<{node.name}>` must not have an event or condition"
                self.report.report("illegal-structure", place, fault=fault)
        targets = self._targets(found[0], "target")
        if found[0].get("target") is None:
            place = self.document.at(found[0])
            self.report.report("missing-attribute", place, element="transition", name="target")
        if node.name == "history":
            assert node.parent is not None
            self._check_inside(node.parent, found[0], "target", targets)
        return Transition(targets=targets, effect=self.content.block(found[0]))

    def _targets(self, node: Node, attribute: str) -> tuple[str, ...]:
        written = node.get(attribute)
        if written is None:
            return ()
        targets = tuple(written.split())
        for target in targets:
            if target not in self.ids:
                place = self.document.at(node, attribute, target)
                hints = self.report.wants_hint("unknown-state")
                help_ = suggest(target, self.ids, "states") if hints else None
                self.report.report("unknown-state", place, name=target, help=help_)
        return targets

    def _check_inside(
        self, around: Node, node: Node, attribute: str, targets: tuple[str, ...]
    ) -> None:
        for target in targets:
            if target not in self.ids:
                continue
            above = self.ids[target].parent
            while above is not None and above is not around:
                above = above.parent
            if above is None:
                place = self.document.at(node, attribute, target)
                name = self.names.get(around, around.name)
                self.report.report(
                    "illegal-structure", place, fault=f"`{target}` is not in `{name}`"
                )

    def _activity(self, id_: str, about: Sequence[Node]) -> Activity | None:
        """Return the activity of a state, from the elements of swarmdsl."""
        found = next((each for each in about if each.name == "activity"), None)
        if found is None:
            return None
        fields = [
            (each.get("field", ""), self.content.expression(each, "expr"))
            for each in found.walk()
            if each.name == "argument"
        ]

        def goal(instance: InstanceLike) -> dict[str, Any]:
            nothing = Event("")
            return {key: v(instance, nothing, {}) for key, v in fields if v is not None}

        function = found.get("function", "")
        return Activity(
            function,
            self.servers.get(function, function),
            {outcome: f"do.{id_}.{outcome}" for outcome in _OUTCOMES},
            goal,
        )


def _deferred(about: Sequence[Node]) -> tuple[str, ...]:
    """Return the events that a state defers, from the elements of swarmdsl."""
    found = (each.get("event", "") for each in about if each.name == "defer")
    return tuple(word for events in found for word in events.split())


def _pattern(word: str) -> str:
    """Convert an event descriptor, which matches by prefix, to that of the engine."""
    word = word.removesuffix("*").removesuffix(".")
    return f"{word}.*" if word else "*"


def _late_value(name: str, value: Value) -> Effect:
    """Return the effect that initializes a variable when its state is first entered (5.3.3)."""
    store = _first_value(name, value)

    def store_once(instance: InstanceLike, event: Event) -> None:
        session = session_of(instance)
        if name not in session.bound:
            session.bound.add(name)
            store(instance, event)

    return store_once


def _first_value(name: str, value: Value) -> Effect:
    def store(instance: InstanceLike, event: Event) -> None:
        instance.data[name] = value(instance, event, {})

    return store
