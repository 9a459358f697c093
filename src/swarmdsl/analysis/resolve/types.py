"""Names of types to types."""

from __future__ import annotations

import re
from collections.abc import Mapping

from swarmdsl.analysis.resolve.scopes import FileScope
from swarmdsl.base.diagnostics.collector import Diagnostics, Label, listed
from swarmdsl.project.loader import File, Project
from swarmdsl.syntax.ast import (
    ActionType,
    AliasType,
    EnumType,
    Interface,
    MessageType,
    ServiceType,
    StructType,
    TypeRef,
)
from swarmdsl.syntax.types import PRIMITIVES, Array, Named, Primitive, Type

_TYPES: tuple[type[Interface], ...] = (
    StructType,
    EnumType,
    AliasType,
    MessageType,
    ServiceType,
    ActionType,
)
_PRIMITIVES = {name: Primitive(name) for name in PRIMITIVES}
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

# No message has room for more elements or characters than such a number counts.
_MOST_DIGITS = 9
_BRACKETS = re.compile(r"\[\s*(<=?)?\s*([^\]\s]*)\s*\]")


def interface_name(file: File, name: str) -> Named:
    """The full name of an interface declared in a file."""
    package, _, last = name.rpartition("/")
    return Named(package or file.package.replace(".", "_"), last)


def written_type(ref: TypeRef) -> Type | None:
    """The type that stands there in full, None for a name that must be looked up."""
    element = _written_element(ref)
    return _in_array(element, ref) if element is not None and ref.array else element


def _written_element(ref: TypeRef) -> Type | None:
    if ref.name in _PRIMITIVES:
        return Primitive(ref.name, int(_bound(ref))) if ref.bound else _PRIMITIVES[ref.name]
    package, slash, name = ref.name.partition("/")
    return Named(package, name) if slash else None


def _in_array(element: Type, ref: TypeRef) -> Array:
    ((bounded, size),) = _BRACKETS.findall(ref.array)
    return Array(element, int(size) if size else None, bool(bounded))


def _bound(ref: TypeRef) -> str:
    return ref.bound.strip("<= \t\n")


def _is_size(number: str) -> bool:
    return number.isdigit() and len(number) <= _MOST_DIGITS and int(number) > 0


class TypeLinker:
    """Sets `EnumType.type` and `TypeRef.type`, following aliases across files."""

    def __init__(self, scopes: Mapping[File, FileScope], project: Project) -> None:
        self._scopes = scopes
        self._report = Diagnostics()
        # Aliases of which a cycle was reported.
        self._endless: set[AliasType] = set()
        self._homes = {declaration: file for file, declaration in project.declarations()}
        for declaration, file in self._homes.items():
            if isinstance(declaration, EnumType):
                declaration.type = interface_name(file, declaration.name)

    def link(self, ref: TypeRef, file: File, report: Diagnostics) -> None:
        """Resolve a type named in a file, and with it those that its aliases name."""
        if ref.type is not None:
            return
        self._report = report
        waiting: list[TypeRef] = []
        aliases: dict[AliasType, None] = {}
        found: Type | AliasType | None = ref.type
        while ref.type is None:
            waiting.append(ref)
            found = self._named(ref, self._scopes[file])
            if not isinstance(found, AliasType):
                break
            if found in aliases:
                way = list(aliases)
                self._report_cycle(way[way.index(found) :])
                self._endless.update(aliases)
            if found in self._endless:
                break
            aliases[found] = None
            ref, file = found.type, self._homes[found]
            found = ref.type
        element = None if isinstance(found, AliasType) else found
        for ref in reversed(waiting):
            element = ref.type = self._in_array(element, ref)

    def _named(self, ref: TypeRef, scope: FileScope) -> Type | AliasType | None:
        """What the name of a type means; None when it means nothing, which is reported."""
        if ref.bound and not self._check_bound(ref):
            return None
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
        if self._reports_package(ref, scope):
            return None
        found = scope.resolve(ref.name, ref.span, _TYPES, self._report, built_in=PRIMITIVES)
        if found is None or isinstance(found, AliasType):
            return found
        return interface_name(self._homes[found], found.name)

    def _reports_package(self, ref: TypeRef, scope: FileScope) -> bool:
        """Report the name of an interface that ROS comes with, without its package."""
        name = ref.name
        if name.lower() in PRIMITIVES or name in scope.lost or scope.find(name):
            return False
        if not self._report.wants_hint("unresolved-name"):
            return False
        if any(declared.name == name for declared in self._homes):
            return False
        # Reading these takes a while, and most models are right.
        from swarmdsl.project.rosidl import standard

        meant = [f"{each}/{name}" for each in standard.packages() if name in standard.names(each)]
        if meant:
            help_ = f"write {listed(meant)}"
            self._report.report("unresolved-name", ref.span, kind="type", name=name, help=help_)
        return bool(meant)

    def _in_array(self, element: Type | None, ref: TypeRef) -> Type | None:
        """The type of a reference whose name, without the brackets behind it, means `element`."""
        if element is None or not ref.array:
            return element
        brackets = _BRACKETS.findall(ref.array)
        if isinstance(element, Array) or len(brackets) > 1:
            self._report.report("nested-array", ref.span, help="put the inner array into a struct")
            return element
        ((bounded, size),) = brackets
        fault = ""
        if bounded == "<" or (bounded and not size):
            fault = "such a bound"
        elif size and not _is_size(size):
            fault = f"{size} elements"
        if fault:
            # Imported here because it is all advice, which most models do without.
            from swarmdsl.syntax.errors.hints import SIZES

            self._report.report(
                "impossible-array", ref.span, what="an array", size=fault, help=SIZES
            )
            return None
        return _in_array(element, ref)

    def _check_bound(self, ref: TypeRef) -> bool:
        """Report a bound that no text has; return whether there is none such."""
        if ref.name not in ("string", "wstring"):
            what, size, help_ = f"a `{ref.name}`", "a bound", "`[<=4]` is the bound of an array"
        elif not ref.bound.startswith("<="):
            what, size, help_ = "a text", "such a bound", f"write `{ref.name}<={_bound(ref)}`"
        elif not _is_size(_bound(ref)):
            what, size = "a text", f"at most {_bound(ref)} characters"
            help_ = f"write `{ref.name}` for a text of any length"
        else:
            return True
        self._report.report("impossible-array", ref.span, what=what, size=size, help=help_)
        return False

    def _report_cycle(self, aliases: list[AliasType]) -> None:
        first, *others = aliases
        self._report.report(
            "type-cycle",
            first.type.span,
            name=first.name,
            related=tuple(Label(alias.type.span, "by way of this") for alias in others),
        )
