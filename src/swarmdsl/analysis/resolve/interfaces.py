"""Interfaces that types name: declared, imported, or standard in ROS."""

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

# Suffixes of the messages that ROS generates from an action or service.
_GENERATED = r"Action(?:Goal|Result|Feedback)?$|_?(?:Goal|Result|Feedback|Request|Response)$"
_KINDS: dict[type[Interface], Kind] = {ServiceType: "srv", ActionType: "action"}


def is_secondary_description(file: File) -> bool:
    """Return True for a model in a library, whose descriptions of ROS interfaces count least."""
    return file.library and file.source.name.endswith(SUFFIX)


def own_interfaces(project: Project) -> set[Named]:
    """Return the interfaces that a project declares or imports from ROS packages."""
    return {
        interface_name(file, node.name)
        for file, node in project.declarations()
        if isinstance(node, Interface) and not is_secondary_description(file)
    }


class Interfaces:
    """Interfaces of a project, then the standard ones of ROS."""

    def __init__(
        self,
        declarations: Iterable[tuple[File, Declaration]],
        read: Mapping[str, Collection[str]] | None = None,
    ) -> None:
        """Collect interfaces. `read` are completely imported packages with all names in them."""
        self._read = read or {}
        self.declared: dict[Named, Interface] = {}
        self._packages: dict[str, list[str]] = {}
        for file, node in sorted(declarations, key=lambda pair: is_secondary_description(pair[0])):
            if isinstance(
                node, (StructType, EnumType, AliasType, MessageType, ServiceType, ActionType)
            ):
                name = interface_name(file, node.name)
                self.declared.setdefault(name, node)
                self._packages.setdefault(name.package, []).append(name.name)

    def get(self, type_: Named, kind: type[Interface] = MessageType) -> Interface | None:
        """Return the interface of a name, None if it is unknown.

        `kind` chooses between several of one name in ROS (`nav_msgs/GetMap`).
        """
        found = self.declared.get(type_)
        return found if found is not None else self.standard(type_, kind)

    def standard(self, type_: Named, kind: type[Interface] = MessageType) -> Interface | None:
        """Return the standard interface of ROS with a name, whatever the project declares."""
        found = standard.lookup(type_, _KINDS.get(kind)) or standard.lookup(type_)
        for ref in nodes_of(found, TypeRef) if found is not None else ():
            if ref.type is None:
                ref.type = written_type(ref)
        return found

    def fields(self, type_: Named) -> list[Field] | None:
        """Return the fields of a message or struct, None if they are unknown."""
        found = self.get(type_)
        if found is None:
            return self._generated_fields(type_)
        return found.fields if isinstance(found, (StructType, MessageType)) else None

    def actions_of(self, type_: Named) -> Iterator[tuple[GeneratedMessage, ActionType]]:
        """Yield the actions from which ROS generates a message of this name."""
        for made in generated_from(type_):
            action = self.get(made.action, ActionType)
            if isinstance(action, ActionType):
                yield made, action

    def _generated_fields(self, type_: Named) -> list[Field] | None:
        """Fields of a message that ROS generates from an action."""
        for made, action in self.actions_of(type_):
            if made.fields:
                at = action.name.span
                return [_field(name, inside, at) for name, inside in made.fields]
            parts = {"goal": action.goal, "result": action.result, "feedback": action.feedback}
            return parts[made.part]
        return None

    def missing(self, type_: Named) -> bool:
        """Return True if an interface is missing in a completely imported package.

        Messages that ROS generates from an action or service (`TrackGoal`, `Track_Request`)
        have no file and are not missing.
        """
        known = self._read.get(type_.package)
        made = re.search(_GENERATED, type_.name)
        made_of = type_.name[: made.start()] if made else type_.name
        return known is not None and type_.name not in known and made_of not in known

    def similar(self, type_: Named) -> Named | None:
        """Return the most similar interface of ROS or the project to an unknown name.

        For an unknown package this is an interface of the same name in a similar package.
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
