"""Names in the text of a system."""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.base.records import dataclass
from swarmdsl.ir import Array, Component, Function, Named, Part, Primitive, System, Type
from swarmdsl.syntax.types import PRIMITIVES, declared_unit


@dataclass(frozen=True)
class Names:
    """Names that differ between text and system.

    `own` are the interfaces that the model declares itself; `operations` the functions that
    components and parts offer, as `Component.operation`.
    """

    own: frozenset[Named]
    operations: Mapping[str, str]

    def type(self, type_: Type) -> str:
        """Return a type as written in the model."""
        unit = declared_unit(type_)
        return f"{self._plain(type_)} in {unit}" if unit is not None else self._plain(type_)

    def _plain(self, type_: Type) -> str:
        """Return a type without its unit."""
        match type_:
            case Array(element=element, size=size, bounded=bounded):
                return f"{self._plain(element)}[{'<=' if bounded else ''}{size or ''}]"
            case Named(name=name) if type_ in self.own and name not in PRIMITIVES:
                return name
            case Primitive() | Named():
                return str(type_)

    def function(self, name: str) -> str:
        """Return a function as written in a state."""
        return self.operations.get(name, name)


def make_names(system: System) -> Names:
    """Collect the names that differ between text and system."""
    # The last one counts: every machine can call a component.
    owners: list[Part | Component] = [*all_parts(system), *system.components]
    return Names(
        frozenset(known.type for known in system.interfaces if not known.external),
        {
            name: f"{owner.name}.{operation_name(system.function(name))}"
            for owner in owners
            for name in owner.operations
        },
    )


def all_parts(system: System) -> list[Part]:
    """Yield the parts of all members."""
    return [part for member in system.members for part in member.parts]


def own_operations(component: Component, system: System) -> tuple[str, ...]:
    """Return the functions that a component offers itself, without its base's."""
    base = system.components_by_name.get(component.base or "")
    return component.operations[len(base.operations) if base is not None else 0 :]


def operation_name(function: Function) -> str:
    """Return the name of a function in the component that offers it."""
    return function.communication.name.rpartition("/")[2]
