"""Variables and params of an imported machine."""

from __future__ import annotations

import re
from collections.abc import Mapping
from itertools import islice

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.scxml.document import Document, Node
from swarmdsl.execution.scxml.grammar import inline_expression
from swarmdsl.importing.expressions import Expressions, UnsupportedError, constant
from swarmdsl.importing.library import Library
from swarmdsl.importing.names import is_plain, value_names
from swarmdsl.importing.partial_states import PartialState
from swarmdsl.importing.portable import PortableDescription
from swarmdsl.importing.scxml_patterns import contents
from swarmdsl.ir import (
    Elapsed,
    Expression,
    InState,
    Literal,
    Message,
    Param,
    ParamRef,
    StateKind,
    Type,
    Variable,
    VariableRef,
)
from swarmdsl.syntax.types import BOOL, FLOAT, INT

_INSIDE = re.compile(r"\bIn\(\s*['\"]?([^'\"()\s]+)['\"]?\s*\)")
_STAYED_IN = (StateKind.SIMPLE, StateKind.COMPOSITE, StateKind.PARALLEL, StateKind.FINAL)


def written_value(node: Node) -> str:
    """Return the value of an element as an expression; empty without one."""
    if "expr" in node.attributes or not node.text.strip():
        return node.get("expr") or ""
    return inline_expression(node.text)


class MachineData:
    """Data of one document; undeclared variables get a type from their use.

    `tested` are the states that expressions test with `In()`, `paths` the ids of all states.
    """

    def __init__(
        self,
        document: Document,
        top: PartialState,
        described: PortableDescription,
        library: Library,
        report: Diagnostics,
        paths: Mapping[PartialState, str],
    ) -> None:
        self.document = document
        self.described = described
        self.library = library
        self.report = report
        self.names = value_names()
        self.types: dict[str, Type] = {}
        self.first: dict[str, Expression] = {}
        self.paths = paths
        self.ignores = False
        self.expressions = Expressions(
            self.types,
            self._refer,
            self._field,
            self._is_active,
            described.identity,
            bool(described),
            self._elapsed,
        )
        self.timed = {
            node.get("location", ""): draft
            for draft in top.walk()
            if (node := draft.payload_node("since")) is not None
        }
        for key, datum in described.data.items():
            self.types[key] = datum.type
            self.names.given[key] = datum.name
            self.names.taken.add(datum.name)
        self._read_first(document.root)
        self.drafts = {id_: draft for draft in top.walk() for id_ in draft.ids}
        if not described:
            self._widen([node for draft in top.walk() for node in contents(draft)])
        self.tested = {
            self.drafts[state]
            for node in document.root.walk()
            for text in node.attributes.values()
            for state in _INSIDE.findall(text)
            if state in self.drafts and self.drafts[state].kind in _STAYED_IN
        }

    def _read_first(self, root: Node) -> None:
        for model in root.children:
            for data in model.children if model.name == "datamodel" else ():
                name, text = data.get("id", ""), written_value(data)
                known = self.described.data.get(name)
                if known is not None and not known.initial:
                    continue
                if name and (name == self.described.identity or name in self.timed):
                    continue
                if not text and data.get("src") is None:
                    continue
                try:
                    if data.get("src") is not None:
                        raise UnsupportedError("`src` is not supported")
                    if known is None and not is_plain(name):
                        raise UnsupportedError("it is not a valid variable name")
                    value = constant(
                        text, known.type if known is not None else None, self.described.identity
                    )
                except UnsupportedError as fault:
                    what = f"data `{name}`"
                    place = self.document.at(data)
                    self.report.report("left-out", place, what=what, reason=fault.reason)
                    continue
                self.first[name] = value
                type_ = getattr(value, "type", None)
                if type_ is not None:
                    self.types.setdefault(name, type_)

    def _widen(self, nodes: list[Node]) -> None:
        """Make integer variables float if a float is assigned to them."""
        assigned = [
            (node.get("location", ""), written_value(node))
            for node in nodes
            if node.name == "assign"
        ]
        known = 0
        while known != len(assigned):
            known = len(assigned)
            for each in list(assigned):
                if self.types.get(each[0]) == INT and self.expressions.type(each[1]) == FLOAT:
                    self.types[each[0]] = FLOAT
                    assigned.remove(each)

    def name(self, text: str) -> str:
        """Name of a variable in the model."""
        return self.names.of(text)

    @property
    def ignored(self) -> str:
        """Variable set by transitions without effects, which the language does not allow."""
        self.ignores = True
        return self.names.of("event ignored")

    def variables(self) -> tuple[Variable, ...]:
        """Variables of the machine, declared ones first."""
        given = self.described.data
        made = [
            Variable(
                self.names.of(key),
                type_,
                self.first.get(key),
                given[key].doc if key in given else "",
            )
            for key, type_ in self.types.items()
            if key not in given or not given[key].param
        ]
        flags = [self.ignored] if self.ignores else []
        return (*made, *(Variable(name, BOOL, Literal(False, BOOL)) for name in flags))

    def params(self) -> tuple[Param, ...]:
        """Params of the machine."""
        return tuple(
            Param(datum.name, datum.type, self.first.get(key), datum.doc)
            for key, datum in self.described.data.items()
            if datum.param
        )

    def condition(self, node: Node, event: Type | None) -> Expression | None:
        """Condition of an element; None if it has none. Raises UnsupportedError."""
        text = node.get("cond")
        return self.read(node, "cond", text, BOOL, event) if text else None

    def read(
        self,
        node: Node,
        attribute: str,
        text: str,
        expected: Type | None,
        event: Type | None = None,
    ) -> Expression:
        """Read an expression and report assumptions. Raises UnsupportedError."""
        known = len(self.types)
        try:
            made = self.expressions.read(text, expected, event)
        except UnsupportedError:
            while len(self.types) > known:
                self.types.popitem()
            raise
        for name in list(islice(reversed(self.types), len(self.types) - known))[::-1]:
            place = self.document.at(node, attribute)
            what, assumed = f"`{name}` is not declared", f"a variable of `{self.types[name]}`"
            self.report.report("assumed", place, what=what, assumed=assumed)
        return made

    def variable(self, location: tuple[str, ...], value: Expression) -> str:
        """Name of the variable in a location. Raises UnsupportedError."""
        name = location[0]
        if not is_plain(name) and name not in self.types:
            raise UnsupportedError(f"`{name}` is not a valid variable name")
        datum = self.described.data.get(name)
        if datum is not None and datum.param:
            raise UnsupportedError(f"`{name}` is a param")
        if len(location) > 1 and name not in self.types:
            raise UnsupportedError(f"`{name}` is not declared")
        self.types.setdefault(name, getattr(value, "type", None) or BOOL)
        return self.names.of(name)

    def type_at(self, location: tuple[str, ...]) -> Type | None:
        """Type of a location; None if it is unknown."""
        type_ = self.types.get(location[0])
        for name in location[1:]:
            type_ = self._field(type_, name)
        return type_

    def _refer(self, name: str, expected: Type) -> VariableRef | ParamRef:
        datum = self.described.data.get(name)
        if datum is not None and datum.param:
            return ParamRef(datum.name, datum.type)
        return VariableRef(self.names.of(name), self.types.setdefault(name, expected))

    def _field(self, type_: Type | None, name: str) -> Type | None:
        message = self.library.message(type_)
        fields = message.fields if isinstance(message, Message) else ()
        return next((field.type for field in fields if field.name == name), None)

    def _is_active(self, state: str) -> Expression:
        draft = self.drafts.get(state)
        if draft is None or draft not in self.tested:
            raise UnsupportedError(f"state `{state}` cannot be tested for being active")
        return InState(self.paths[draft])

    def _elapsed(self, name: str) -> Expression | None:
        """Return the time since the entry of a state, given the data with the time of entry."""
        draft = self.timed.get(name)
        return Elapsed(self.paths[draft]) if draft is not None else None
