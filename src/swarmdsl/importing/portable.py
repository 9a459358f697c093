"""Read the vocabulary of the portable profile.

See `codegen.exchange.scxml.payload`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Literal

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.numerals import integer
from swarmdsl.base.records import dataclass
from swarmdsl.execution.scxml.document import Document, Node
from swarmdsl.importing.expressions import UnsupportedError, constant
from swarmdsl.importing.partial_states import PartialState
from swarmdsl.importing.types import written_type
from swarmdsl.ir import (
    Action,
    Communication,
    Constant,
    Delivery,
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
from swarmdsl.syntax.parser.literals import nanoseconds
from swarmdsl.syntax.types import MEMBER, unit_of, with_unit
from swarmdsl.syntax.units import UNITS

_RELIABLE = {"reliable": True, "best-effort": False}
_MEANS = {"keep": "number", "lifespan": "duration", "deadline": "duration"}
_COUNT = re.compile(r"0*[1-9][0-9]*")
_TIME = re.compile(r"(?=[0-9.]*[1-9])([0-9]+(?:\.[0-9]{1,3})?) (us|ms|s|min|h)")


@dataclass(frozen=True)
class DataItem:
    """A variable or param of a `<data>` element."""

    name: str
    type: Type
    param: bool
    initial: bool
    doc: str


class PortableDescription:
    """Description of the exported model in a document; errors in it are reported.

    Empty for documents of other tools.
    """

    def __init__(self, document: Document, top: PartialState, report: Diagnostics) -> None:
        self.document = document
        self.report = report
        self.payload = top.payload
        model = top.payload_node("model")
        self.package = model.get("package", "") if model is not None else ""
        identity = top.payload_node("identity")
        self.identity = identity.get("location", "") if identity is not None else ""
        self.endless = top.payload_node("endless") is not None
        self.doc = doc_of(top.payload)
        self.data: dict[str, DataItem] = {}
        for node in self.payload:
            if node.name in ("variable", "parameter"):
                self._datum(node)

    def __bool__(self) -> bool:
        return bool(self.payload)

    def _datum(self, node: Node) -> None:
        type_ = self._type(node)
        if type_ is not None:
            given = node.get("initial") != "default"
            name = node.get("name", "")
            self.data[node.get("location", name)] = DataItem(
                name, type_, node.name == "parameter", given, doc_of(node.children)
            )

    def events(self) -> Iterator[Event]:
        """Yield the events that the machine handles or sends."""
        for node in self._named("event"):
            type_ = self._type(node)
            if isinstance(type_, Named):
                swarm = node.get("swarm") == "true"
                yield Event(
                    node.attributes["name"],
                    type_,
                    node.get("topic", ""),
                    swarm,
                    doc_of(node.children),
                    delivery=self._delivery(node) if swarm else None,
                    predefined=type_ == MEMBER and not swarm,
                    operator=swarm and node.get("operator") == "true",
                )

    def _delivery(self, node: Node) -> Delivery | None:
        """Return the settings of a swarm event; None if it has none."""
        values: dict[str, int] = {}
        for name in ("keep", "lifespan", "deadline"):
            text = node.get(name, "")
            found = (_COUNT if name == "keep" else _TIME).fullmatch(text)
            if found is not None:
                values[name] = nanoseconds(text, found[2]) if name != "keep" else integer(text)
            elif text:
                self._left_out(node, name, f"`{text}` is not a positive {_MEANS[name]}")
        given = node.get("reliability", "")
        if given not in ("", *_RELIABLE):
            self._left_out(node, "reliability", f"`{given}` is neither {' nor '.join(_RELIABLE)}")
        delivery = Delivery(
            reliable=_RELIABLE.get(given),
            latest=node.get("latest") == "true",
            keep=values.get("keep"),
            lifespan=values.get("lifespan"),
            deadline=values.get("deadline"),
        )
        return delivery if delivery != Delivery() else None

    def functions(self) -> Iterator[Function]:
        """Yield the functions that its activities call."""
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
        """Yield the interfaces of events and functions."""
        for node in self.payload:
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
        for node in self.payload:
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
                except UnsupportedError as fault:
                    self._left_out(each, "value", fault.reason)
                    continue
                yield Constant(each.get("name", ""), type_, value, doc_of(each.children))

    def _type(self, node: Node) -> Type | None:
        written = node.get("type", "")
        made = written_type(written)
        if made is None:
            self._left_out(node, "type", f"`{written}` is not a type")
            return None
        name = node.get("unit")
        if name is None:
            return made
        unit = UNITS.get(name)
        if unit is None or unit_of(with_unit(made, unit)) is None:
            self._left_out(node, "unit", f"`{written}` has no unit `{name}`")
            return made
        return with_unit(made, unit)

    def _left_out(self, node: Node, attribute: str, reason: str) -> None:
        what = f"{node.name} `{node.get('name', '')}`"
        place = self.document.at(node, attribute)
        self.report.report("left-out", place, what=what, reason=reason)


def doc_of(nodes: list[Node]) -> str:
    """Documentation among elements."""
    return next((node.text for node in nodes if node.name == "doc"), "")


def docs_of(draft: PartialState) -> Docs:
    """Documentation of blocks in a state, by the keyword of the block."""
    first = draft.payload_node("first")
    docs = [(word, comment_of(nodes[0].parent)) for word, nodes in _blocks(draft)]
    deferred = [doc_of(node.children) for node in draft.payload if node.name == "defer"]
    docs.append(("defer", "\n".join(filter(None, deferred))))
    docs.append(("initial", doc_of(first.children) if first is not None else ""))
    return tuple(sorted((word, text) for word, text in docs if text))


def _blocks(draft: PartialState) -> Iterator[tuple[str, list[Node]]]:
    yield from ((w, nodes) for w, nodes in (("entry", draft.entry), ("exit", draft.exit)) if nodes)


def comment_of(node: Node | None) -> str:
    """XML comment of an element; commented-out XML is no documentation."""
    comment = node.comment if node is not None else ""
    # `--` is not allowed in XML comments; the exporter writes `- -`.
    return "" if "<" in comment else comment.replace("- -", "--")
