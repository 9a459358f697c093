"""States and transitions of SCXML as a table of the engine."""

from __future__ import annotations

from typing import Any

from swarmdsl.diagnostics import Diagnostics, Label
from swarmdsl.runtime import (
    Activity,
    Effect,
    Event,
    Instance,
    Kind,
    Machine,
    State,
    TableError,
    Transition,
)
from swarmdsl.scxml.content import Content, get, nothing
from swarmdsl.scxml.document import SCXML, Document, Element, children
from swarmdsl.scxml.ecmascript import Value
from swarmdsl.scxml.vocabulary import OURS
from swarmdsl.suggest import suggest

_KINDS = {"parallel": Kind.PARALLEL, "final": Kind.FINAL}
_VERTICES = ("state", "parallel", "final", "history")
_OUTCOMES = ("succeeded", "aborted", "preempted")


def machine(document: Document, report: Diagnostics) -> Machine | None:
    """The machine of a document of known elements; None when something is wrong with it."""
    reader = _Reader(document, report)
    root = document.root
    if not reader.ids:
        report.report("illegal-structure", document.at(root), fault="the document has no state")
        return None
    variables = reader.variables()
    states = [reader.state(n, e) for n, e in children(root) if n in _VERTICES]
    initial = reader.initial(root)
    if report.has_errors:
        return None
    try:
        return Machine(
            get(root, "name") or "scxml",
            states,
            initial,
            data=lambda: dict.fromkeys(variables),
            setup=tuple(_first_value(name, v) for name, v in variables.items() if v is not nothing),
        )
    except TableError as error:
        place = reader.ids.get(error.id, root)
        report.report("illegal-structure", document.at(place, "id"), fault=str(error))
        return None


class _Reader:
    """Reads the states of one document."""

    def __init__(self, document: Document, report: Diagnostics) -> None:
        self.document = document
        self.report = report
        self.content = Content(document, report)
        self.ids: dict[str, Element] = {}
        self.names: dict[Element, str] = {}
        unnamed: list[Element] = []
        for element in document.root.iter(*(f"{{{SCXML}}}{tag}" for tag in _VERTICES)):
            id_ = get(element, "id")
            if id_ is None:
                unnamed.append(element)
                continue
            self.names[element] = id_
            if id_ in self.ids:
                report.report(
                    "duplicate-id",
                    document.at(element, "id"),
                    name=id_,
                    related=(Label(document.at(self.ids[id_], "id"), "the first one"),),
                )
            else:
                self.ids[id_] = element
        for number, element in enumerate(unnamed, 1):
            # No id has a space in it.
            self.names[element] = f"state {number}"
            self.ids[self.names[element]] = element
        self.servers = {
            element.get("name"): element.get("server", "")
            for element in document.root.iterchildren(f"{{{OURS}}}function")
        }

    def variables(self) -> dict[str, Value]:
        """The ids of all data, and how each gets its first value."""
        found: dict[str, Element] = {}
        values: dict[str, Value] = {}
        if get(self.document.root, "binding") == "late":
            place = self.document.at(self.document.root, "binding")
            self.report.report("bad-value", place, name="binding", values="`early`")
        for element in self.document.root.iter(f"{{{SCXML}}}data"):
            name = get(element, "id") or ""
            if name in found:
                self.report.report(
                    "duplicate-id",
                    self.document.at(element, "id"),
                    name=name,
                    related=(Label(self.document.at(found[name], "id"), "the first one"),),
                )
            elif get(element, "src") is not None:
                place = self.document.at(element, "src")
                reason = "other files are not read"
                self.report.report("not-understood", place, name="src", reason=reason)
            found.setdefault(name, element)
            values[name] = self.content.value(element)
        return values

    def state(self, name: str, element: Element) -> State:
        """A state and what is in it."""
        id_ = self.names[element]
        if name == "history":
            depth = get(element, "type") or "shallow"
            if depth not in ("shallow", "deep"):
                place = self.document.at(element, "type")
                self.report.report("bad-value", place, name="type", values="`shallow` or `deep`")
            default = self._only_transition(element)
            kind = Kind.DEEP_HISTORY if depth == "deep" else Kind.HISTORY
            return State(id_, kind, transitions=(default,) if default is not None else ())
        states: list[State] = []
        transitions: list[Transition] = []
        entry: list[Effect] = []
        leave: list[Effect] = []
        donedata = None
        for tag, child in children(element):
            if tag in _VERTICES:
                states.append(self.state(tag, child))
            elif tag == "transition":
                transitions.append(self.transition(child))
            elif tag in ("onentry", "onexit"):
                effect = self.content.block(child)
                if effect is not None:
                    (entry if tag == "onentry" else leave).append(effect)
            elif tag == "donedata":
                donedata = self.content.data(child)
        return State(
            id_,
            _KINDS.get(name, Kind.STATE),
            tuple(states),
            self.initial(element) if name == "state" else (),
            tuple(transitions),
            tuple(entry),
            tuple(leave),
            self._activity(id_, element),
            donedata,
            element.sourceline,
        )

    def initial(self, element: Element) -> Transition | tuple[str, ...]:
        """What is entered with a state: what it says, or nothing for its first child."""
        inner = element.find(f"{{{SCXML}}}initial")
        if inner is None:
            targets = self._targets(element, "initial")
            self._check_inside(element, element, "initial", targets)
            return targets
        if get(element, "initial") is not None:
            place = self.document.at(element, "initial")
            fault = "what is entered first is said twice"
            self.report.report("illegal-structure", place, fault=fault)
        found = self._only_transition(inner)
        if found is None:
            return ()
        self._check_inside(element, inner[0], "target", found.targets)
        return found

    def transition(self, element: Element) -> Transition:
        """A transition of a state."""
        event = get(element, "event")
        if event is None and get(element, "cond") is None and get(element, "target") is None:
            fault = "a transition without event, condition and target is always taken again"
            self.report.report("illegal-structure", self.document.at(element), fault=fault)
        kind = get(element, "type") or "external"
        if kind not in ("external", "internal"):
            place = self.document.at(element, "type")
            self.report.report("bad-value", place, name="type", values="`external` or `internal`")
        return Transition(
            tuple([_pattern(word) for word in event.split()]) if event is not None else (),
            self._targets(element, "target"),
            self.content.guard(element),
            self.content.block(element),
            kind == "internal",
            element.sourceline,
        )

    def _only_transition(self, element: Element) -> Transition | None:
        """The transition of a history or an initial element: it has a target, and no more."""
        found = [child for name, child in children(element) if name == "transition"]
        if len(found) != 1:
            place = self.document.at(found[1] if found else element)
            fault = f"`<{_tag(element)}>` has one transition"
            self.report.report("illegal-structure", place, fault=fault)
            return None
        for attribute in ("event", "cond"):
            if get(found[0], attribute) is not None:
                place = self.document.at(found[0], attribute)
                fault = f"the transition of `<{_tag(element)}>` is always taken"
                self.report.report("illegal-structure", place, fault=fault)
        targets = self._targets(found[0], "target")
        if get(found[0], "target") is None:
            place = self.document.at(found[0])
            self.report.report("missing-attribute", place, element="transition", name="target")
        if _tag(element) == "history":
            around = element.getparent()
            assert around is not None
            self._check_inside(around, found[0], "target", targets)
        return Transition(targets=targets, effect=self.content.block(found[0]))

    def _targets(self, element: Element, attribute: str) -> tuple[str, ...]:
        written = get(element, attribute)
        if written is None:
            return ()
        targets = tuple(written.split())
        for target in targets:
            if target not in self.ids:
                self.report.report(
                    "unknown-state",
                    self.document.at(element, attribute, target),
                    name=target,
                    help=suggest(target, self.ids, "states"),
                )
        return targets

    def _check_inside(
        self, around: Element, element: Element, attribute: str, targets: tuple[str, ...]
    ) -> None:
        for target in targets:
            found = self.ids.get(target)
            if found is not None and all(above is not around for above in found.iterancestors()):
                place = self.document.at(element, attribute, target)
                name = self.names.get(around, _tag(around))
                self.report.report(
                    "illegal-structure", place, fault=f"`{target}` is not in `{name}`"
                )

    def _activity(self, id_: str, element: Element) -> Activity | None:
        """What swarmdsl wrote about the activity of a state."""
        found = element.find(f"{{{OURS}}}activity")
        if found is None:
            return None
        fields = [
            (each.get("field", ""), self.content.expression(each, "expr"))
            for each in found.iterfind(f"{{{OURS}}}goal/{{{OURS}}}argument")
        ]

        def goal(instance: Instance) -> dict[str, Any]:
            nothing = Event("")
            return {key: v(instance, nothing, {}) for key, v in fields if v is not None}

        function = found.get("function", "")
        return Activity(
            function,
            self.servers.get(function, function),
            {outcome: f"do.{id_}.{outcome}" for outcome in _OUTCOMES},
            goal,
        )


def _pattern(word: str) -> str:
    """An event descriptor, which fits all names it is the beginning of, as the engine has it."""
    word = word.removesuffix("*").removesuffix(".")
    return f"{word}.*" if word else "*"


def _first_value(name: str, value: Value) -> Effect:
    def store(instance: Instance, event: Event) -> None:
        instance.data[name] = value(instance, event, {})

    return store


def _tag(element: Element) -> str:
    return str(element.tag).rpartition("}")[2]
