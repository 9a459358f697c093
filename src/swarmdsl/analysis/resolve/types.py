"""Resolve the names of types."""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.analysis.resolve.report_unresolved import report_type
from swarmdsl.analysis.resolve.scopes import FileScope, Unresolved
from swarmdsl.analysis.resolve.type_names import (
    array_of,
    bound_of,
    brackets_of,
    interface_name,
    is_size,
    written_element,
)
from swarmdsl.base.diagnostics.advice import Advice, write
from swarmdsl.base.diagnostics.collector import Diagnostics, Label
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
from swarmdsl.syntax.types import Array, Type, with_unit

_TYPES: tuple[type[Interface], ...] = (
    StructType,
    EnumType,
    AliasType,
    MessageType,
    ServiceType,
    ActionType,
)


class TypeLinker:
    """Sets `EnumType.type` and `TypeRef.type`, following aliases across files."""

    def __init__(self, scopes: Mapping[File, FileScope], project: Project) -> None:
        self._scopes = scopes
        self._report = Diagnostics()
        # Aliases on reported cycles.
        self._endless: set[AliasType] = set()
        self._homes = {declaration: file for file, declaration in project.declarations()}
        for declaration, file in self._homes.items():
            if isinstance(declaration, EnumType):
                declaration.type = interface_name(file, declaration.name)

    def link(self, ref: TypeRef, file: File, report: Diagnostics) -> None:
        """Resolve a type in a file, and the types of the aliases that it names."""
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
                seen = list(aliases)
                self._report_cycle(seen[seen.index(found) :])
                self._endless.update(aliases)
            if found in self._endless:
                break
            aliases[found] = None
            ref, file = found.type, self._homes[found]
            found = ref.type
        element = None if isinstance(found, AliasType) else found
        for ref in reversed(waiting):
            element = ref.type = self._with_unit(self._in_array(element, ref), ref)

    def _with_unit(self, type_: Type | None, ref: TypeRef) -> Type | None:
        """Apply the unit of a reference to its type, which has no other."""
        if ref.unit is None or type_ is None:
            return type_
        # Most models have no wrong units.
        from swarmdsl.analysis.resolve.unit_names import find_unit

        unit = find_unit(type_, ref.unit, self._report)
        return type_ if unit is None else with_unit(type_, unit)

    def _named(self, ref: TypeRef, scope: FileScope) -> Type | AliasType | None:
        """Resolve the name of a type; report a failure and return None."""
        if ref.bound and not self._check_bound(ref):
            return None
        written = written_element(ref)
        if written is not None:
            return written
        found = scope.resolve(ref.name, _TYPES)
        if isinstance(found, Unresolved):
            report_type(found, ref, _TYPES, scope, self._report)
            return None
        if isinstance(found, AliasType):
            return found
        return interface_name(self._homes[found], found.name)

    def _in_array(self, element: Type | None, ref: TypeRef) -> Type | None:
        """Apply the brackets of a reference to the type of its name."""
        if element is None or not ref.array:
            return element
        brackets = brackets_of(ref)
        if isinstance(element, Array) or len(brackets) > 1:
            self._report.report("nested-array", ref.span, help="put the inner array into a struct")
            return element
        ((bounded, size),) = brackets
        fault = ""
        if bounded == "<" or (bounded and not size):
            fault = "such a bound"
        elif size and not is_size(size):
            fault = f"{size} elements"
        if fault:
            # Most models do not need this module of hints.
            from swarmdsl.syntax.errors.hints import SIZES

            self._report.report(
                "impossible-array", ref.span, what="an array", size=fault, help=SIZES
            )
            return None
        return array_of(element, ref)

    def _check_bound(self, ref: TypeRef) -> bool:
        """Return True for the valid bound of a string; report any other bound."""
        if ref.name not in ("string", "wstring"):
            what, size = f"a `{ref.name}`", "a bound"
            array = f"{ref.name}[{ref.bound}]"
            help_ = Advice("`[<=4]` is the bound of an array", "propose", array)
        elif not ref.bound.startswith("<="):
            what, size, help_ = "a string", "such a bound", write(f"{ref.name}<={bound_of(ref)}")
        elif not is_size(bound_of(ref)):
            what, size = "a string", f"at most {bound_of(ref)} characters"
            help_ = Advice(f"write `{ref.name}` for a string of any length", "propose", ref.name)
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
            related=tuple(Label(alias.type.span, "through this") for alias in others),
        )
