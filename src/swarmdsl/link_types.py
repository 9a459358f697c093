"""Names of types to types."""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.diagnostics import Diagnostics, Label
from swarmdsl.ir.types import PRIMITIVES, Array, Named, Primitive, Type
from swarmdsl.load import File
from swarmdsl.scopes import FileScope
from swarmdsl.syntax import (
    ActionType,
    AliasType,
    EnumType,
    Interface,
    MessageType,
    ServiceType,
    StructType,
    TypeRef,
)

_TYPES: tuple[type[Interface], ...] = (
    StructType,
    EnumType,
    AliasType,
    MessageType,
    ServiceType,
    ActionType,
)
# What other languages call some types.
_OTHER_NAMES = {
    "int": "int32",
    "integer": "int32",
    "uint": "uint32",
    "float": "float64",
    "double": "float64",
    "number": "float64",
    "boolean": "bool",
    "str": "string",
}

# No message has room for more elements than such a number counts.
_MOST_DIGITS = 9


def interface_name(file: File, name: str) -> Named:
    """The full name of an interface declared in a file."""
    package, _, last = name.rpartition("/")
    return Named(package or file.package.replace(".", "_"), last)


def written_type(ref: TypeRef) -> Type | None:
    """The type that stands there in full, None for a name that must be looked up."""
    element = _written_element(ref)
    return _in_array(element, ref) if element is not None and ref.array else element


def _written_element(ref: TypeRef) -> Type | None:
    if ref.name in PRIMITIVES:
        return Primitive(ref.name, int(ref.bound.strip("<= \t\n")) if ref.bound else None)
    package, slash, name = ref.name.partition("/")
    return Named(package, name) if slash else None


def _in_array(element: Type, ref: TypeRef) -> Array:
    size = _size(ref)
    return Array(element, int(size) if size else None, "<=" in ref.array)


def _size(ref: TypeRef) -> str:
    return ref.array.strip("[<=] \t\n")


class TypeLinker:
    """Sets `TypeRef.type`, following aliases across files."""

    def __init__(self, scopes: Mapping[File, FileScope], report: Diagnostics) -> None:
        self._scopes = scopes
        self._report = report
        # Aliases of which a cycle was reported.
        self._endless: set[AliasType] = set()
        self._homes = {
            declaration: file for file in scopes for declaration in file.model.declarations
        }
        for declaration, file in self._homes.items():
            if isinstance(declaration, EnumType):
                declaration.type = interface_name(file, declaration.name)

    def link(self, ref: TypeRef, file: File) -> None:
        """Resolve a type named in a file, and with it those that its aliases name."""
        waiting: list[TypeRef] = []
        aliases: list[AliasType] = []
        found: Type | AliasType | None = ref.type
        while ref.type is None:
            waiting.append(ref)
            found = self._named(ref, self._scopes[file])
            if not isinstance(found, AliasType):
                break
            if found in aliases:
                self._report_cycle(aliases[aliases.index(found) :])
                self._endless.update(aliases)
            if found in self._endless:
                break
            aliases.append(found)
            ref, file = found.type, self._homes[found]
            found = ref.type
        element = None if isinstance(found, AliasType) else found
        for ref in reversed(waiting):
            element = ref.type = self._in_array(element, ref)

    def _named(self, ref: TypeRef, scope: FileScope) -> Type | AliasType | None:
        """What the name of a type means; None when it means nothing, which is reported."""
        written = _written_element(ref)
        if written is not None:
            return written
        if ref.name in _OTHER_NAMES and not scope.find(ref.name):
            self._report.report(
                "unresolved-name",
                ref.span,
                kind="type",
                name=ref.name,
                help=f"write `{_OTHER_NAMES[ref.name]}`",
            )
            return None
        package, _, name = ref.name.rpartition(".")
        if package and "." not in package and package not in scope.packages and scope.complete:
            self._report.report(
                "unresolved-name",
                ref.span,
                kind="type",
                name=ref.name,
                help=f"write `{package}/{name}` for an interface of ROS",
            )
            return None
        found = scope.resolve(ref.name, ref.span, _TYPES, self._report, built_in=PRIMITIVES)
        if found is None or isinstance(found, AliasType):
            return found
        return interface_name(self._homes[found], found.name)

    def _in_array(self, element: Type | None, ref: TypeRef) -> Type | None:
        """The type of a reference whose name, without the brackets behind it, means `element`."""
        if element is None or not ref.array:
            return element
        if isinstance(element, Array):
            self._report.report("nested-array", ref.span, help="put the inner array into a struct")
            return element
        size = _size(ref)
        if size and (len(size) > _MOST_DIGITS or int(size) == 0):
            self._report.report("impossible-array", ref.span, size=size)
            return None
        return _in_array(element, ref)

    def _report_cycle(self, aliases: list[AliasType]) -> None:
        first, *others = aliases
        self._report.report(
            "type-cycle",
            first.type.span,
            name=first.name,
            related=tuple(Label(alias.type.span, "by way of this") for alias in others),
        )
