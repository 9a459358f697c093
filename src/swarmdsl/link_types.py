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


def interface_name(file: File, name: str) -> Named:
    """The full name of an interface declared in a file."""
    package, _, last = name.rpartition("/")
    return Named(package or file.package.replace(".", "_"), last)


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

    def link(self, ref: TypeRef, file: File, seen: tuple[AliasType, ...] = ()) -> None:
        """Resolve a type named in a file; `seen` are the aliases on the way to it."""
        if ref.type is not None:
            return
        scope = self._scopes[file]
        element: Type | None = None
        if ref.name in PRIMITIVES:
            element = Primitive(ref.name, int(ref.bound.strip("<= \t\n")) if ref.bound else None)
        elif "/" in ref.name:
            package, _, last = ref.name.partition("/")
            element = Named(package, last)
        elif ref.name in _OTHER_NAMES and not scope.find(ref.name):
            self._report.report(
                "unresolved-name",
                ref.span,
                kind="type",
                name=ref.name,
                help=f"write `{_OTHER_NAMES[ref.name]}`",
            )
        else:
            element = self._declared(ref, scope, seen)
        if isinstance(element, Array) and ref.array:
            self._report.report("nested-array", ref.span, help="put the inner array into a struct")
        elif element is not None and ref.array:
            size = ref.array.strip("[<=] \t\n")
            element = Array(element, int(size) if size else None, "<=" in ref.array)
        ref.type = element

    def _declared(self, ref: TypeRef, scope: FileScope, seen: tuple[AliasType, ...]) -> Type | None:
        declaration = scope.resolve(ref.name, ref.span, _TYPES, self._report, built_in=PRIMITIVES)
        if declaration is None:
            return None
        home = self._homes[declaration]
        if not isinstance(declaration, AliasType):
            return interface_name(home, declaration.name)
        if declaration in self._endless:
            return None
        if declaration in seen:
            self._endless.update(seen)
            first, *others = seen[seen.index(declaration) :]
            self._report.report(
                "type-cycle",
                first.type.span,
                name=declaration.name,
                related=tuple(Label(alias.type.span, "by way of this") for alias in others),
            )
            return None
        self.link(declaration.type, home, (*seen, declaration))
        return declaration.type.type
