"""What is known of the interfaces that types name: declared, imported, or standard in ROS."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping

from swarmdsl.analysis.resolve.type_names import interface_name, written_type
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import closest
from swarmdsl.project.libraries import SUFFIX
from swarmdsl.project.loader import File, Project
from swarmdsl.project.rosidl import standard
from swarmdsl.project.rosidl.interface_file import Kind
from swarmdsl.syntax.action_messages import GeneratedMessage, generated_from
from swarmdsl.syntax.ast import (
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
    Word,
    nodes_of,
)
from swarmdsl.syntax.types import Named

# What the messages end with that ROS makes of an action or service.
_MADE = r"Action(?:Goal|Result|Feedback)?$|_?(?:Goal|Result|Feedback|Request|Response)$"
_KINDS: dict[type[Interface], Kind] = {ServiceType: "srv", ActionType: "action"}


def only_retells(file: File) -> bool:
    """Whether it is a model in a library: what it says of others' interfaces counts least."""
    return file.library and file.source.name.endswith(SUFFIX)


def own_interfaces(project: Project) -> set[Named]:
    """The interfaces that a project describes itself, or by the files of ROS packages."""
    return {
        interface_name(file, node.name)
        for file, node in project.declarations()
        if isinstance(node, Interface) and not only_retells(file)
    }


class Interfaces:
    """The interfaces of a project, and behind them those that ROS comes with."""

    def __init__(
        self,
        declarations: Iterable[tuple[File, Declaration]],
        read: Mapping[str, Collection[str]] | None = None,
    ) -> None:
        """`read` are the packages whose interface files were read, with all names in them."""
        self._read = read or {}
        self.declared: dict[Named, Interface] = {}
        self._packages: dict[str, list[str]] = {}
        for file, node in sorted(declarations, key=lambda pair: only_retells(pair[0])):
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
        return found if found is not None else self.standard(type_, wanted)

    def standard(self, type_: Named, wanted: type[Interface] = MessageType) -> Interface | None:
        """The interface of that name that ROS comes with, whatever the project declares."""
        found = standard.lookup(type_, _KINDS.get(wanted)) or standard.lookup(type_)
        for ref in nodes_of(found, TypeRef) if found is not None else ():
            if ref.type is None:
                ref.type = written_type(ref)
        return found

    def fields(self, type_: Named) -> list[Field] | None:
        """The fields of a message or struct, None when they are not known."""
        found = self.get(type_)
        if found is None:
            return self._fields_made(type_)
        return found.fields if isinstance(found, (StructType, MessageType)) else None

    def actions_of(self, type_: Named) -> Iterator[tuple[GeneratedMessage, ActionType]]:
        """The actions that ROS makes a message of that name of."""
        for made in generated_from(type_):
            action = self.get(made.action, ActionType)
            if isinstance(action, ActionType):
                yield made, action

    def _fields_made(self, type_: Named) -> list[Field] | None:
        """The fields of what ROS makes of an action."""
        for made, action in self.actions_of(type_):
            if made.fields:
                at = action.name.span
                return [_field(name, inside, at) for name, inside in made.fields]
            parts = {"goal": action.goal, "result": action.result, "feedback": action.feedback}
            return parts[made.part]
        return None

    def missing(self, type_: Named) -> bool:
        """Whether there is certainly no such interface: the files of its package were read.

        What ROS makes of an action or service (`TrackGoal`, `Track_Request`) has no file.
        """
        known = self._read.get(type_.package)
        made = re.search(_MADE, type_.name)
        made_of = type_.name[: made.start()] if made else type_.name
        return known is not None and type_.name not in known and made_of not in known

    def similar(self, type_: Named) -> Named | None:
        """What may be meant by a name of which nothing is known: one that ROS or the project has.

        Of a package that is not known itself nothing can be said, unless another one of
        nearly its name has the interface.
        """
        known = self._read.get(type_.package)
        if known is not None:
            name = closest(type_.name, known)
            return Named(type_.package, name) if name else None
        if type_.package in standard.packages():
            name = closest(type_.name, standard.names(type_.package))
            return Named(type_.package, name) if name else None
        package = closest(type_.package, [*standard.packages(), *self._packages])
        if package is None or package == type_.package:
            return None
        near = Named(package, type_.name)
        return near if self.get(near) is not None else None


def _field(name: str, type_: Named, at: Span) -> Field:
    ref = TypeRef(at, str(type_), "", "")
    ref.type = type_
    return Field(at, Word(name, at), ref)
