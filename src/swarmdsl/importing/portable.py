"""What the portable profile says beside SCXML: the vocabulary of exchange/scxml/payload.py."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.execution.scxml.document import Document, Node
from swarmdsl.importing.expressions import UnsayableError, constant
from swarmdsl.importing.partial_states import Draft
from swarmdsl.importing.types import written_type
from swarmdsl.ir import (
    Action,
    Communication,
    Constant,
    Event,
    Field,
    Function,
    Interface,
    Message,
    Named,
    Service,
    Type,
)
from swarmdsl.ir.docs import Docs


@dataclass(frozen=True)
class Datum:
    """A variable or param, by the `<data>` that holds it."""

    name: str
    type: Type
    param: bool
    initial: bool
    doc: str


class Described:
    """What one document says of the model that it was made of; faults in it are reported.

    All of it is empty for a document of others.
    """

    def __init__(self, document: Document, top: Draft, report: Diagnostics) -> None:
        self.document = document
        self.report = report
        self.about = top.about
        model = top.said("model")
        self.package = model.get("package", "") if model is not None else ""
        self.endless = top.said("endless") is not None
        self.doc = doc_of(top.about)
        self.data: dict[str, Datum] = {}
        for node in self.about:
            if node.name in ("variable", "parameter"):
                self._datum(node)

    def __bool__(self) -> bool:
        return bool(self.about)

    def _datum(self, node: Node) -> None:
        type_ = self._type(node)
        if type_ is not None:
            given = node.get("initial") != "default"
            name = node.get("name", "")
            self.data[node.get("location", name)] = Datum(
                name, type_, node.name == "parameter", given, doc_of(node.children)
            )

    def events(self) -> Iterator[Event]:
        """The events that the machine hears or sends."""
        for node in self._named("event"):
            type_ = self._type(node)
            if isinstance(type_, Named):
                topic, swarm = node.get("topic", ""), node.get("swarm") == "true"
                yield Event(node.attributes["name"], type_, topic, swarm, doc_of(node.children))

    def functions(self) -> Iterator[Function]:
        """The functions that its activities call."""
        for node in self._named("function"):
            type_ = self._type(node)
            if isinstance(type_, Named):
                category: Literal["abstraction", "swarm"] = (
                    "swarm" if node.get("category") == "swarm" else "abstraction"
                )
                paradigm: Literal["action", "service"] = (
                    "service" if node.get("paradigm") == "service" else "action"
                )
                name = node.attributes["name"]
                call = Communication(paradigm, node.get("server", name), type_)
                yield Function(name, category, call, (), (), doc_of(node.children))

    def interfaces(self) -> Iterator[Interface]:
        """The interfaces that all of these are made of."""
        for node in self.about:
            if node.name not in ("message", "service", "action"):
                continue
            type_ = self._type(node)
            if not isinstance(type_, Named):
                continue
            external, doc = node.get("external") == "true", doc_of(node.children)
            parts = {
                each.get("name"): tuple(self._fields(each))
                for each in node.children
                if each.name == "part"
            }
            match node.name:
                case "message":
                    constants = tuple(self._constants(node))
                    fields = tuple(self._fields(node))
                    yield Message(type_, fields, external, constants, doc)
                case "service":
                    request, response = parts.get("request", ()), parts.get("response", ())
                    yield Service(type_, request, response, external, doc)
                case "action":
                    names = ("goal", "result", "feedback")
                    goal, result, feedback = (parts.get(name, ()) for name in names)
                    yield Action(type_, goal, result, feedback, external, doc)

    def _named(self, tag: str) -> Iterator[Node]:
        for node in self.about:
            if node.name == tag and node.get("name"):
                yield node

    def _fields(self, node: Node) -> Iterator[Field]:
        for each in node.children:
            type_ = self._type(each) if each.name == "field" else None
            if type_ is not None:
                yield Field(each.get("name", ""), type_, doc_of(each.children))

    def _constants(self, node: Node) -> Iterator[Constant]:
        for each in node.children:
            type_ = self._type(each) if each.name == "constant" else None
            if type_ is not None:
                try:
                    value = constant(each.get("value", ""), type_)
                except UnsayableError as fault:
                    self._left_out(each, "value", fault.reason)
                    continue
                yield Constant(each.get("name", ""), type_, value, doc_of(each.children))

    def _type(self, node: Node) -> Type | None:
        written = node.get("type", "")
        made = written_type(written)
        if made is None:
            self._left_out(node, "type", f"`{written}` is no type")
        return made

    def _left_out(self, node: Node, attribute: str, reason: str) -> None:
        what = f"{node.name} `{node.get('name', '')}`"
        place = self.document.at(node, attribute)
        self.report.report("left-out", place, what=what, reason=reason)


def doc_of(nodes: list[Node]) -> str:
    """The documentation among some elements."""
    return next((node.text for node in nodes if node.name == "doc"), "")


def docs_of(draft: Draft) -> Docs:
    """What is said of lines of a state, in the order of their names."""
    first = draft.said("first")
    said = [(word, comment_of(nodes[0].parent)) for word, nodes in _blocks(draft)]
    said.append(("initial", doc_of(first.children) if first is not None else ""))
    return tuple((word, text) for word, text in said if text)


def _blocks(draft: Draft) -> Iterator[tuple[str, list[Node]]]:
    yield from ((w, nodes) for w, nodes in (("entry", draft.entry), ("exit", draft.exit)) if nodes)


def comment_of(node: Node | None) -> str:
    """What a person says of an element; XML that was taken out is no documentation."""
    comment = node.comment if node is not None else ""
    # XML has no `--` in comments.
    return "" if "<" in comment else comment.replace("- -", "--")
