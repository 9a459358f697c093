"""Functions, devices and interfaces of all files that are imported together."""

from __future__ import annotations

import ast
from collections.abc import Iterable

from swarmdsl.base.records import replace
from swarmdsl.importing.calls import Call
from swarmdsl.importing.names import NamePool, type_names, value_names
from swarmdsl.importing.types import data_type
from swarmdsl.ir import (
    Action,
    Communication,
    Component,
    Field,
    Function,
    Interface,
    Literal,
    Message,
    Named,
    Policy,
    Service,
    System,
    Type,
)
from swarmdsl.project.rosidl.interface_file import Kind
from swarmdsl.project.rosidl.standard import lookup
from swarmdsl.syntax.ast import ActionType, MessageType, ServiceType
from swarmdsl.syntax.ast import Field as Described
from swarmdsl.syntax.parser.literals import forbidden_character
from swarmdsl.syntax.types import BOOL, FLOAT, INT, STRING


class Library:
    """Functions, devices and interfaces of all imported files."""

    def __init__(self) -> None:
        self.names: NamePool = value_names()
        self.functions: dict[tuple[str, str, Named], Function] = {}
        self.by_name: dict[str, tuple[str, str, Named]] = {}
        self.interfaces: dict[Named, Interface] = {}
        self.devices: NamePool = type_names()
        self.components: list[Component] = []
        # Assumed properties: name of the declaration and name of the property.
        self.guesses: set[tuple[str, str]] = set()
        self._known = System("")

    def add_existing(self, system: System) -> None:
        """Add the declarations of an existing model, to which calls can refer."""
        others = {name for each in system.components for name in each.operations}
        others |= {n for m in system.members for part in m.parts for n in part.operations}
        others |= {function.name for function in self.functions.values()}
        functions = tuple(each for each in system.functions if each.name not in others)
        self._known = replace(system, functions=functions)
        for function in functions:
            call = function.communication
            self.functions.setdefault((call.paradigm, call.name, call.type), function)
            self.names.taken.add(function.name)
        for interface in system.interfaces:
            self.interfaces.setdefault(interface.type, interface)

    def new_functions(self) -> tuple[Function, ...]:
        """Functions that the existing model does not have."""
        return tuple(each for each in self.functions.values() if each not in self._known.functions)

    def new_interfaces(self) -> tuple[Interface, ...]:
        """Interfaces that the existing model does not have."""
        known = self._known.interfaces
        return tuple(each for each in self.interfaces.values() if each not in known)

    def describe(self, interface: Interface) -> bool:
        """Add an interface; return False if ROS defines it with other fields.

        Services and actions of ROS are not added.
        """
        standard = lookup(interface.type)
        if standard is None:
            self.interfaces.setdefault(interface.type, interface)
        elif isinstance(interface, Message) and isinstance(standard, MessageType):
            if [each.name for each in interface.fields] != [str(e.name) for e in standard.fields]:
                return False
            self.interfaces.setdefault(interface.type, interface)
        return True

    def interface(self, call: Call) -> Interface | None:
        """Known interface of a call."""
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

    def message(self, type_: Type | None) -> Message | None:
        """Known description of a message."""
        known = self.interfaces.get(type_) if isinstance(type_, Named) else None
        if isinstance(known, Message) or not isinstance(type_, Named):
            return known if isinstance(known, Message) else None
        match lookup(type_, "msg"):
            case MessageType(fields=fields):
                return Message(type_, _standard_fields(fields), external=True)
        return None

    def add(self, function: Function) -> None:
        """Add a function that an ADF file or a document describes."""
        call = function.communication
        self.functions[call.paradigm, call.name, call.type] = function

    def add_portable(self, function: Function) -> None:
        """Add a function of the portable profile, unless an ADF file describes it."""
        call = function.communication
        key = (call.paradigm, call.name, call.type)
        if key not in self.functions:
            self.names.taken.add(function.name)
            self.functions[key] = function
        self.by_name[function.name] = key

    def function_named(self, name: str) -> Function | None:
        """Return the function by its name in the portable profile."""
        return self.functions.get(self.by_name[name]) if name in self.by_name else None

    def function(self, call: Call) -> Function:
        """Return the function of a call, created if it is unknown."""
        known = self.functions.get((call.paradigm, call.name, call.type))
        if known is None:
            name = call.function
            if all(each.name != name for each in self._known.functions):
                name = self.names.new(call.function or call.name.rpartition("/")[2])
            self.guesses.add((name, "category"))
            known = Function(
                name,
                "abstraction" if call.name.startswith("cmd/") else "swarm",
                Communication(call.paradigm, call.name, call.type),
                (),
                (),
            )
            self.add(known)
        return known

    def infer_goal_fields(self, calls: list[Call]) -> None:
        """Name the fields of goals whose values are only given in order."""
        by_type: dict[tuple[str, Named], list[Call]] = {}
        for call in calls:
            by_type.setdefault((call.paradigm, call.type), []).append(call)
        for (paradigm, type_), same in by_type.items():
            counts = {len(c.goal_items) if c.goal is Policy.FIXED else 0 for c in same}
            values = [literal(item) for item in same[0].goal_items]
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


def _standard_fields(fields: Iterable[Described]) -> tuple[Field, ...]:
    return tuple(
        Field(str(field.name), data_type(f"{field.type.name}{field.type.array}"))
        for field in fields
    )


def literal(text: str) -> Literal | None:
    """Parse a Python literal; None for other expressions."""
    try:
        value = ast.literal_eval(text)
    except (ValueError, SyntaxError, MemoryError, RecursionError):
        return None
    types = {bool: BOOL, int: INT, float: FLOAT, str: STRING}
    if isinstance(value, str) and forbidden_character(value):
        return None
    return Literal(value, types[type(value)]) if type(value) in types else None
