"""Import folders of ROS packages: interfaces and parameters of nodes.

A node is a function if a function has the name of its package, as in the CPSwarm libraries,
otherwise a component.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from swarmdsl.analysis.resolve.type_names import written_type
from swarmdsl.base import resources
from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.read_files import MOST_DATA, exists, is_folder
from swarmdsl.base.records import replace
from swarmdsl.base.source import Source, Span
from swarmdsl.driver import pipeline
from swarmdsl.importing.names import type_names
from swarmdsl.importing.params import NodeParams, read_params
from swarmdsl.ir import (
    Action,
    Component,
    Constant,
    Field,
    Function,
    Interface,
    Literal,
    Message,
    Named,
    Primitive,
    Service,
    System,
)
from swarmdsl.project.read_source import read_source
from swarmdsl.project.rosidl.installed import installed_package
from swarmdsl.project.rosidl.interface_file import InterfaceFile, parse_interface
from swarmdsl.project.rosidl.package_folder import find_interfaces, find_parameters
from swarmdsl.project.rosidl.standard import lookup
from swarmdsl.project.rosidl.values import Values
from swarmdsl.syntax.ast import ActionType, MessageType, ServiceType, Value
from swarmdsl.syntax.ast import Constant as WrittenConstant
from swarmdsl.syntax.ast import Field as WrittenField
from swarmdsl.syntax.parser.literals import forbidden_character
from swarmdsl.syntax.types import BOOL, FLOAT, INT, STRING

_TYPES: dict[type, Primitive] = {bool: BOOL, int: INT, float: FLOAT, str: STRING}


def import_ros(
    folders: Sequence[Path], name: str, functions: Mapping[str, Function], report: Diagnostics
) -> tuple[System, int]:
    """Import the packages in the folders; return the system and the number of files.

    A folder that does not exist may be the name of an installed package. `functions` are the
    functions whose nodes may be among the packages.
    """
    interfaces: dict[Named, Interface] = {}
    owners: dict[str, NodeParams] = {}
    files = 0
    for named in folders:
        folder = named if exists(named) else installed_package(str(named)) or named
        parameters = find_parameters(folder) if is_folder(folder) else []
        found = find_interfaces(folder, None, report, required=not parameters, named=str(named))
        files += len(found) + len(parameters)
        for each in found:
            source = read_source(each.path, None, report, "a file", MOST_DATA)
            if source is not None and lookup(Named(each.package, each.name), each.kind) is None:
                read = parse_interface(source, each.package, each.name, each.kind, report)
                _add(_interface(read, report), interfaces, source, report)
        for file in parameters:
            source = read_source(file.path, None, report, "a file", MOST_DATA)
            if source is not None:
                read_params(source, file.package, owners, report)
    system = System(
        name,
        tuple(interfaces.values()),
        functions=tuple(
            replace(known, params=tuple(owner.params.values()), doc=known.doc or owner.doc)
            for known, owner in ((functions.get(name), owner) for name, owner in owners.items())
            if known is not None
        ),
        components=tuple(_components(owners, functions)),
    )
    return system, files


def why_empty(folders: Sequence[Path]) -> str | None:
    """Return the reason for which nothing is imported from packages of ROS itself."""
    known: set[str] = set()
    for named in folders:
        folder = named if exists(named) else installed_package(str(named)) or named
        found = find_interfaces(folder, None, Diagnostics(), required=False)
        known.update(each.package for each in found)
    names = listed(sorted(known), "and")
    return f"the interfaces of {names} come with swarmdsl, and need no import" if known else None


def _add(
    new: Interface, interfaces: dict[Named, Interface], source: Source, report: Diagnostics
) -> None:
    known = interfaces.setdefault(new.type, new)
    if known != new:
        what, reason = f"`{new.type}`", "another interface has this name"
        report.report("left-out", Span(source, 0, 0), what=what, reason=reason)


def _interface(read: InterfaceFile, report: Diagnostics) -> Interface:
    declared = read.declaration
    package, _, name = str(declared.name).partition("/")
    type_ = Named(package, name)

    def fields(written: Iterable[WrittenField]) -> tuple[Field, ...]:
        return tuple(_field(field, read.defaults) for field in written)

    if not isinstance(declared, MessageType):
        for constant in (each for part in read.constants.values() for each in part):
            what, reason = f"constant `{constant.name}`", "in a model, only messages have constants"
            report.report("left-out", constant.name.span, what=what, reason=reason)
    match declared:
        case MessageType(fields=written):
            constants = tuple(
                made
                for each in read.constants["fields"]
                if (made := _constant(each, report)) is not None
            )
            return Message(type_, fields(written), True, constants, declared.doc)
        case ServiceType(request=request, response=response):
            return Service(type_, fields(request), fields(response), True, declared.doc)
        case ActionType(goal=goal, result=result, feedback=feedback):
            parts = fields(goal), fields(result), fields(feedback)
            return Action(type_, *parts, True, declared.doc)


def _field(field: WrittenField, defaults: Mapping[WrittenField, Values]) -> Field:
    type_ = written_type(field.type)
    assert type_ is not None  # types in ROS files are qualified
    doc = field.doc
    if field in defaults:
        # Only ROS 2 has default values, and a model has none for fields.
        doc = "\n".join(filter(None, (doc, f"Default: {_text(defaults[field])}")))
    return Field(str(field.name), type_, doc)


def _text(values: Values) -> str:
    if isinstance(values, tuple):
        return f"[{', '.join(map(_text, values))}]"
    return str(values.value).lower() if isinstance(values.value, bool) else str(values.value)


def _constant(constant: WrittenConstant, report: Diagnostics) -> Constant | None:
    type_, value = written_type(constant.type), constant.value.tree
    assert isinstance(type_, Primitive)
    assert isinstance(value, Value)
    forbidden = forbidden_character(value.value) if isinstance(value.value, str) else None
    if forbidden is not None:
        what = f"constant `{constant.name}`"
        reason = f"a string of a model cannot contain {forbidden}"
        report.report("left-out", constant.name.span, what=what, reason=reason)
        return None
    literal = Literal(value.value, _TYPES[type(value.value)])
    return Constant(str(constant.name), type_, literal, constant.doc)


def _components(
    owners: Mapping[str, NodeParams], functions: Mapping[str, Function]
) -> Iterator[Component]:
    """Yield the nodes that are not functions."""
    names = type_names()
    for package, owner in owners.items():
        if package not in functions and owner.params:
            params = tuple(owner.params.values())
            yield Component(names.new(package), "virtual", (), params, doc=owner.doc)


def library_functions() -> dict[str, Function]:
    """Functions of the bundled library by name."""
    system = pipeline.check([resources.library() / "cpswarm"]).system
    assert system is not None
    return {function.name: function for function in system.functions}
