"""What is known of the interfaces that types name: declared, imported, or standard in ROS."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.ir.types import Named
from swarmdsl.link_types import interface_name, written_type
from swarmdsl.load import File
from swarmdsl.ros import standard
from swarmdsl.ros.interface_file import Kind
from swarmdsl.suggest import closest
from swarmdsl.syntax import (
    ActionType,
    AliasType,
    Declaration,
    EnumType,
    Field,
    Interface,
    MessageType,
    ServiceType,
    StructType,
    TypeRef,
    walk,
)

_KINDS: dict[type[Interface], Kind] = {ServiceType: "srv", ActionType: "action"}


class Interfaces:
    """The interfaces of a project, and behind them those that ROS comes with."""

    def __init__(self, declarations: Iterable[tuple[File, Declaration]]) -> None:
        self.declared: dict[Named, Interface] = {}
        self._packages: dict[str, list[str]] = {}
        for file, node in declarations:
            if isinstance(
                node, (StructType, EnumType, AliasType, MessageType, ServiceType, ActionType)
            ):
                name = interface_name(file, node.name)
                self.declared.setdefault(name, node)
                self._packages.setdefault(name.package, []).append(name.name)

    def get(self, type_: Named, wanted: type[Interface] = MessageType) -> Interface | None:
        """The interface of that name, None when nothing is known of it.

        Where ROS has several of one name (`nav_msgs/GetMap`) it is the `wanted` one.
        """
        found = self.declared.get(type_)
        if found is None:
            found = standard.lookup(type_, _KINDS.get(wanted)) or standard.lookup(type_)
            for ref in walk(found) if found is not None else ():
                if isinstance(ref, TypeRef) and ref.type is None:
                    ref.type = written_type(ref)
        return found

    def fields(self, type_: Named) -> list[Field] | None:
        """The fields of a message or struct, None when they are not known."""
        found = self.get(type_)
        return found.fields if isinstance(found, (StructType, MessageType)) else None

    def similar(self, type_: Named) -> Named | None:
        """What may be meant by a name of which nothing is known: one that ROS or the project has.

        Of a package that is not known itself nothing can be said, unless another one of
        nearly its name has the interface.
        """
        if type_.package in standard.packages():
            name = closest(type_.name, standard.names(type_.package))
            return Named(type_.package, name) if name else None
        package = closest(type_.package, [*standard.packages(), *self._packages])
        if package is None or package == type_.package:
            return None
        near = Named(package, type_.name)
        return near if self.get(near) is not None else None
