"""The variables and params of a machine, as its document holds and uses them."""

from __future__ import annotations

import re

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.scxml.document import Document, Node
from swarmdsl.importing.expressions import Expressions, UnsayableError, constant
from swarmdsl.importing.library import Library
from swarmdsl.importing.names import is_plain, value_names
from swarmdsl.importing.partial_states import Draft
from swarmdsl.importing.portable import Described
from swarmdsl.importing.scxml_patterns import contents
from swarmdsl.ir import (
    Expression,
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
_STAYED_IN = (StateKind.SIMPLE, StateKind.COMPOSITE, StateKind.PARALLEL)


class MachineData:
    """The data of one document; what is only used gets a type by its use.

    `active` is the variable that tells whether a state is active, of each state that a condition
    asks about: the language has no such question.
    """

    def __init__(
        self,
        document: Document,
        top: Draft,
        described: Described,
        library: Library,
        report: Diagnostics,
    ) -> None:
        self.document = document
        self.described = described
        self.library = library
        self.report = report
        self.names = value_names()
        self.types: dict[str, Type] = {}
        self.first: dict[str, Expression] = {}
        self.active: dict[Draft, str] = {}
        self.ignores = False
        self.expressions = Expressions(self.types, self._refer, self._field, self._is_active)
        for key, datum in described.data.items():
            self.types[key] = datum.type
            self.names.given[key] = datum.name
            self.names.taken.add(datum.name)
        self._read_first(document.root)
        self.drafts = {id_: draft for draft in top.walk() for id_ in draft.ids}
        if not described:
            self._widen([node for draft in top.walk() for node in contents(draft)])
        for draft in top.walk():
            for edge in draft.edges:
                for state in _INSIDE.findall(edge.node.get("cond", "")):
                    asked = self.drafts.get(state)
                    if asked is not None and asked.kind in _STAYED_IN:
                        self.active.setdefault(asked, self.names.of(f"in {state}"))

    def _read_first(self, root: Node) -> None:
        for model in root.children:
            for data in model.children if model.name == "datamodel" else ():
                name, text = data.get("id", ""), data.get("expr", data.text.strip())
                known = self.described.data.get(name)
                if known is not None and not known.initial:
                    continue
                if not text and data.get("src") is None:
                    continue
                try:
                    if data.get("src") is not None:
                        raise UnsayableError("other files are not read")
                    if known is None and not is_plain(name):
                        raise UnsayableError("no variable can be called so")
                    value = constant(text, known.type if known is not None else None)
                except UnsayableError as fault:
                    what = f"data `{name}`"
                    place = self.document.at(data)
                    self.report.report("left-out", place, what=what, reason=fault.reason)
                    continue
                self.first[name] = value
                type_ = getattr(value, "type", None)
                if type_ is not None:
                    self.types.setdefault(name, type_)

    def _widen(self, nodes: list[Node]) -> None:
        """Make a whole number any number, where one is assigned that is not whole."""
        assigned = [
            (node.get("location", ""), node.get("expr", node.text.strip()))
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
        """What a variable is called in the model."""
        return self.names.of(text)

    @property
    def ignored(self) -> str:
        """The variable that a transition sets which does nothing: those of a model do something."""
        self.ignores = True
        return self.names.of("event ignored")

    def variables(self) -> tuple[Variable, ...]:
        """Those of the machine, the given ones first."""
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
        flags = [*self.active.values(), *([self.ignored] if self.ignores else [])]
        return (*made, *(Variable(name, BOOL, Literal(False, BOOL)) for name in flags))

    def params(self) -> tuple[Param, ...]:
        """The params of the machine."""
        return tuple(
            Param(datum.name, datum.type, self.first.get(key), datum.doc)
            for key, datum in self.described.data.items()
            if datum.param
        )

    def condition(self, node: Node, event: Type | None) -> Expression | None:
        """The condition of an element; None where it has none. Raises UnsayableError."""
        text = node.get("cond")
        return self.read(node, "cond", text, BOOL, event) if text else None

    def read(
        self, node: Node, attribute: str, text: str, wanted: Type | None, event: Type | None = None
    ) -> Expression:
        """An expression; what has to be assumed for it is reported. Raises UnsayableError."""
        known = set(self.types)
        try:
            made = self.expressions.read(text, wanted, event)
        except UnsayableError:
            for name in self.types.keys() - known:
                del self.types[name]
            raise
        for name in self.types.keys() - known:
            place = self.document.at(node, attribute)
            what, assumed = f"nothing is said of `{name}`", f"a variable of `{self.types[name]}`"
            self.report.report("assumed", place, what=what, assumed=assumed)
        return made

    def variable(self, location: tuple[str, ...], value: Expression) -> str:
        """What the variable is called that a location begins with. Raises UnsayableError."""
        name = location[0]
        if not is_plain(name) and name not in self.types:
            raise UnsayableError(f"no variable can be called `{name}`")
        datum = self.described.data.get(name)
        if datum is not None and datum.param:
            raise UnsayableError(f"`{name}` is a param")
        if len(location) > 1 and name not in self.types:
            raise UnsayableError(f"nothing is said of `{name}`")
        self.types.setdefault(name, getattr(value, "type", None) or BOOL)
        return self.names.of(name)

    def type_at(self, location: tuple[str, ...]) -> Type | None:
        """The type of what is there, None where it is not known."""
        type_ = self.types.get(location[0])
        for name in location[1:]:
            type_ = self._field(type_, name)
        return type_

    def _refer(self, name: str, wanted: Type) -> VariableRef | ParamRef:
        datum = self.described.data.get(name)
        if datum is not None and datum.param:
            return ParamRef(datum.name, datum.type)
        return VariableRef(self.names.of(name), self.types.setdefault(name, wanted))

    def _field(self, type_: Type | None, name: str) -> Type | None:
        message = self.library.message(type_)
        fields = message.fields if isinstance(message, Message) else ()
        return next((field.type for field in fields if field.name == name), None)

    def _is_active(self, state: str) -> Expression:
        draft = self.drafts.get(state)
        if draft is None or draft not in self.active:
            raise UnsayableError(f"whether `{state}` is active cannot be asked")
        return VariableRef(self.active[draft], BOOL)
