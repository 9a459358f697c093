"""Calls of the dialect as activities, with the functions and interfaces that they need."""

from __future__ import annotations

import ast
from collections.abc import Iterable

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.importing.calls import Call
from swarmdsl.importing.names import Names, type_names, value_names
from swarmdsl.importing.types import data_type
from swarmdsl.ir import (
    Action,
    Activity,
    Communication,
    Component,
    Expression,
    Field,
    Function,
    Interface,
    Literal,
    Named,
    Policy,
    Primitive,
    ResultMapping,
    Service,
    Type,
    VariableRef,
)
from swarmdsl.ir.types import BOOL, FLOAT, FLOATS, INT, INTEGERS, STRING
from swarmdsl.ros.interface_file import Kind
from swarmdsl.ros.standard import lookup
from swarmdsl.scxml.document import Document
from swarmdsl.syntax import ActionType, ServiceType
from swarmdsl.syntax import Field as Described

_ZEROS: dict[str, Literal] = {
    **{name: Literal(0, Primitive(name)) for name in INTEGERS},
    **{name: Literal(0.0, Primitive(name)) for name in FLOATS},
    "bool": Literal(False, BOOL),
    "string": Literal("", STRING),
}


class Library:
    """The functions, devices and interfaces of all that is read together."""

    def __init__(self) -> None:
        self.names: Names = value_names()
        self.functions: dict[tuple[str, str, Named], Function] = {}
        self.interfaces: dict[Named, Interface] = {}
        self.devices: Names = type_names()
        self.components: list[Component] = []

    def describe(self, interface: Interface) -> None:
        """Take what is said of an interface, unless ROS comes with it or it is known already."""
        if lookup(interface.type) is None:
            self.interfaces.setdefault(interface.type, interface)

    def interface(self, call: Call) -> Interface | None:
        """What is known of the interface that a call goes by."""
        known = self.interfaces.get(call.type)
        kind: Kind = "srv" if call.paradigm == "service" else "action"
        standard = lookup(call.type, kind) if known is None else None
        match standard:
            case ActionType(goal=goal, result=result):
                fields = _standard_fields(goal), _standard_fields(result)
                return Action(call.type, *fields, (), external=True)
            case ServiceType(request=goal, response=result):
                fields = _standard_fields(goal), _standard_fields(result)
                return Service(call.type, *fields, external=True)
        return known

    def add(self, function: Function) -> None:
        """Take a function that an ADF file describes."""
        call = function.communication
        self.functions[call.paradigm, call.name, call.type] = function

    def function(self, call: Call) -> Function:
        """The function that a call asks for, made where nothing is known of it."""
        known = self.functions.get((call.paradigm, call.name, call.type))
        if known is None:
            name = self.names.new(call.function or call.name.rpartition("/")[2])
            known = Function(
                name,
                "abstraction" if call.name.startswith("cmd/") else "swarm",
                Communication(call.paradigm, call.name, call.type),
                (),
                (),
            )
            self.add(known)
        return known

    def learn(self, calls: list[Call]) -> None:
        """Name the fields of goals that are only ever given as values in their order."""
        by_type: dict[tuple[str, Named], list[Call]] = {}
        for call in calls:
            by_type.setdefault((call.paradigm, call.type), []).append(call)
        for (paradigm, type_), same in by_type.items():
            counts = {len(c.goal_items) if c.goal is Policy.FIXED else 0 for c in same}
            values = [_literal(item) for item in same[0].goal_items]
            literals = [value for value in values if value is not None]
            if self.interface(same[0]) is not None or len(counts) > 1 or counts == {0}:
                continue
            if len(literals) < len(values):
                continue
            fields = tuple(Field(f"value{i}", v.type) for i, v in enumerate(literals, 1))
            results = dict.fromkeys(item for call in same for item in call.result_items)
            stored = tuple(Field(name, STRING) for name in results)
            self.interfaces[type_] = (
                Action(type_, fields, stored, (), external=True)
                if paradigm == "action"
                else Service(type_, fields, stored, external=True)
            )


class Activities:
    """Makes the activities of one document; `keys` are the variables that they need."""

    def __init__(self, document: Document, library: Library, report: Diagnostics) -> None:
        self.document = document
        self.library = library
        self.report = report
        self.keys: dict[str, Type] = {}

    def activity(self, call: Call, variables: Names) -> Activity:
        """What a state does that makes this call."""
        function = self.library.function(call)
        described = self._described(call)
        goal = _part(described, ("goal", "request"))
        result = _part(described, ("result", "response"))
        mapped = dict(call.mappings)
        arguments: dict[str, Expression] = {}
        callback = call.goal is Policy.CALLBACK
        if call.goal is Policy.FIXED:
            callback = not self._fixed(call, goal, arguments)
        elif call.goal is Policy.USERDATA:
            for name in call.goal_items:
                if goal is not None and name not in goal:
                    self._left_out(call, f"`{name}`", f"`{call.type}` has no such field")
                    continue
                key = mapped.get(name, name)
                type_ = self._key(call, key, goal.get(name) if goal is not None else None)
                arguments[name] = VariableRef(variables.of(key), type_)
        if not callback:
            self._complete(call, goal, arguments)
        results = []
        for name in call.result_items:
            if result is not None and name not in result:
                self._left_out(call, f"`{name}`", f"`{call.type}` has no such field")
                continue
            key = mapped.get(name, name)
            self._key(call, key, result.get(name) if result is not None else None)
            results.append(ResultMapping(name, variables.of(key), ()))
        words = ("goal", "result") if call.paradigm == "action" else ("request", "response")
        reads = call.result is Policy.CALLBACK
        return Activity(
            function.name,
            tuple(arguments.items()) if not callback else (),
            f"{function.name}_{words[0]}" if callback else None,
            tuple(results),
            f"{function.name}_{words[1]}" if reads else None,
        )

    def _described(self, call: Call) -> Interface | None:
        """What is known of the interface of a call; nothing, where it is known as another kind."""
        known = self.library.interface(call)
        if known is None or isinstance(known, Action) == (call.paradigm == "action"):
            return known
        self.library.interfaces.pop(call.type, None)
        reason = f"here it is that of {'an action' if call.paradigm == 'action' else 'a service'}"
        self._left_out(call, f"what is known of `{call.type}`", reason)
        return None

    def _fixed(
        self, call: Call, goal: dict[str, Type] | None, arguments: dict[str, Expression]
    ) -> bool:
        """Fill in values in the order of the fields; False where they are no plain values."""
        values = [_literal(item) for item in call.goal_items]
        names = list(goal) if goal is not None else []
        if goal is None:
            names = [f"value{number}" for number in range(1, len(values) + 1)]
        if goal is None or any(name.startswith("value") for name in names):
            what = f"the names of the fields of `{call.type}` are not known"
            self._assumed(call, what, ", ".join(f"`{name}`" for name in names))
        if None in values:
            what = ", ".join(call.goal_items)
            self._left_out(call, f"`{what}`", "it is code; a callback has to fill the goal")
            return False
        for name, value in zip(names, values, strict=False):
            assert value is not None
            arguments[name] = value
        for item in call.goal_items[len(names) :]:
            self._left_out(call, f"`{item}`", f"`{call.type}` has no field for it")
        return True

    def _complete(
        self, call: Call, goal: dict[str, Type] | None, arguments: dict[str, Expression]
    ) -> None:
        """Say what ROS does: a field that is not given is zero."""
        missing = {name: type_ for name, type_ in (goal or {}).items() if name not in arguments}
        if not missing:
            return
        zeros = {name: _ZEROS.get(str(type_)) for name, type_ in missing.items()}
        if None in zeros.values():
            # Its fields would have to be given: then it is better not described at all.
            self.library.interfaces.pop(call.type, None)
            reason = f"a call of it leaves {', '.join(f'`{name}`' for name in missing)} open"
            self._left_out(call, f"what is known of `{call.type}`", reason)
            return
        for name, zero in zeros.items():
            assert zero is not None
            arguments[name] = zero
            self._assumed(call, f"`{name}` has no value", "zero, as ROS has it,")

    def _key(self, call: Call, key: str, type_: Type | None) -> Type:
        known = self.keys.get(key)
        if known is None:
            if type_ is None:
                self._assumed(call, f"the type of `{key}` is not known", "`string`")
            known = self.keys[key] = type_ or STRING
        return known

    def _left_out(self, call: Call, what: str, reason: str) -> None:
        self.report.report("left-out", self.document.at(call.node), what=what, reason=reason)

    def _assumed(self, call: Call, what: str, assumed: str) -> None:
        self.report.report("assumed", self.document.at(call.node), what=what, assumed=assumed)


def _standard_fields(fields: Iterable[Described]) -> tuple[Field, ...]:
    return tuple(
        Field(str(field.name), data_type(f"{field.type.name}{field.type.array}"))
        for field in fields
    )


def _part(described: Interface | None, names: tuple[str, str]) -> dict[str, Type] | None:
    """The fields of one part of an interface; None where nothing is known."""
    for name in names:
        fields = getattr(described, name, None)
        if fields is not None:
            return {field.name: field.type for field in fields}
    return None


def _literal(text: str) -> Literal | None:
    """A value as Python writes it; None for anything that would have to be computed."""
    try:
        value = ast.literal_eval(text)
    except (ValueError, SyntaxError, MemoryError, RecursionError):
        return None
    types = {bool: BOOL, int: INT, float: FLOAT, str: STRING}
    return Literal(value, types[type(value)]) if type(value) in types else None
