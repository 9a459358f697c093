"""The whole model, as generators see it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from typing import Protocol, TypeVar

from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span
from swarmdsl.ir.architecture import Component, Environment, Member, Swarm
from swarmdsl.ir.contracts import promised
from swarmdsl.ir.derived import DERIVED
from swarmdsl.ir.interfaces import Action, Event, Field, Function, Interface, Message
from swarmdsl.ir.optimization import Fitness, Optimization
from swarmdsl.ir.properties import Property
from swarmdsl.ir.statemachine import StateMachine
from swarmdsl.syntax.action_messages import generated_from
from swarmdsl.syntax.types import Named, Type


@dataclass(frozen=True)
class System:
    """All declarations, in the order of the files and of the text in them.

    `name` is the package of the first file, or its file name if it has none. `standard` are
    the interfaces of ROS that the model uses and does not describe, with those in their fields;
    `ros_packages` the packages of ROS among those that the model mentions.
    """

    name: str
    interfaces: tuple[Interface, ...] = ()
    events: tuple[Event, ...] = ()
    functions: tuple[Function, ...] = ()
    components: tuple[Component, ...] = ()
    members: tuple[Member, ...] = ()
    machines: tuple[StateMachine, ...] = ()
    environments: tuple[Environment, ...] = ()
    swarms: tuple[Swarm, ...] = ()
    fitness: tuple[Fitness, ...] = ()
    optimizations: tuple[Optimization, ...] = ()
    properties: tuple[Property, ...] = ()
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)
    standard: tuple[Interface, ...] = field(default=(), compare=False, metadata=DERIVED)
    ros_packages: tuple[str, ...] = field(default=(), compare=False, metadata=DERIVED)

    @cached_property
    def judged(self) -> tuple[Property, ...]:
        """The properties, and those that the contracts of members promise."""
        return (
            *self.properties,
            *promised(self.members, self.swarms, self.properties, self.machines_by_name),
        )

    def event(self, name: str) -> Event:
        """Return the event of that name."""
        return self.events_by_name[name]

    def function(self, name: str) -> Function:
        """Return the function of that name."""
        return self.functions_by_name[name]

    def events_of(self, names: Iterable[str]) -> list[Event]:
        """Return the events of some names, in the order of the declarations."""
        return _in_order(names, self.events_by_name, self._event_places)

    def functions_of(self, names: Iterable[str]) -> list[Function]:
        """Return the functions of some names, in the order of the declarations."""
        return _in_order(names, self.functions_by_name, self._function_places)

    def interfaces_of(self, types: Iterable[Type]) -> list[Interface]:
        """Return what the model itself describes of some types, in the order of declarations."""
        return _in_order(types, self.interfaces_by_type, self._interface_places)

    def interface(self, type_: object) -> Interface | None:
        """Return the interface as the model describes it, or None."""
        found = self.interfaces_by_type.get(type_)
        if found is None and isinstance(type_, Named):
            return _message_of_action(type_, self._actions)
        return found

    def known_interface(self, type_: object, kind: type[Interface] = Message) -> Interface | None:
        """Return the interface as the model describes it, else as ROS does.

        If ROS has several of one name (`nav_msgs/GetMap`), that of class `kind` is preferred.
        """
        described = self.interface(type_)
        if described is not None:
            return described
        found = self._standard.get(type_, [])
        if not found and isinstance(type_, Named):
            return _message_of_action(type_, self._standard_actions)
        return min(found, key=lambda known: not isinstance(known, kind), default=None)

    # A model can have thousands of each, and none is searched for every use.

    @cached_property
    def events_by_name(self) -> Mapping[str, Event]:
        """The events by name, in their order; likewise below."""
        return _by_name(self.events)

    @cached_property
    def functions_by_name(self) -> Mapping[str, Function]:
        """The functions by name."""
        return _by_name(self.functions)

    @cached_property
    def components_by_name(self) -> Mapping[str, Component]:
        """The components by name."""
        return _by_name(self.components)

    @cached_property
    def members_by_name(self) -> Mapping[str, Member]:
        """The members by name."""
        return _by_name(self.members)

    @cached_property
    def machines_by_name(self) -> Mapping[str, StateMachine]:
        """The state machines by name."""
        return _by_name(self.machines)

    @cached_property
    def interfaces_by_type(self) -> Mapping[object, Interface]:
        """The interfaces that the model describes, by type."""
        return {known.type: known for known in self.interfaces}

    @cached_property
    def robot_topics(self) -> frozenset[str]:
        """The topics of the events that are of one robot, not of the swarm."""
        return frozenset(event.topic for event in self.events if not event.swarm)

    @cached_property
    def _event_places(self) -> Mapping[str, int]:
        return {name: place for place, name in enumerate(self.events_by_name)}

    @cached_property
    def _function_places(self) -> Mapping[str, int]:
        return {name: place for place, name in enumerate(self.functions_by_name)}

    @cached_property
    def _interface_places(self) -> Mapping[object, int]:
        return {type_: place for place, type_ in enumerate(self.interfaces_by_type)}

    @cached_property
    def _standard(self) -> Mapping[object, Sequence[Interface]]:
        found: dict[object, list[Interface]] = {}
        for known in self.standard:
            found.setdefault(known.type, []).append(known)
        return found

    @cached_property
    def _actions(self) -> Mapping[object, Action]:
        return _actions(self.interfaces)

    @cached_property
    def _standard_actions(self) -> Mapping[object, Action]:
        return _actions(self.standard)


class _HasName(Protocol):
    @property
    def name(self) -> str: ...


K = TypeVar("K")
T = TypeVar("T")
N = TypeVar("N", bound=_HasName)


def _by_name(nodes: Iterable[N]) -> Mapping[str, N]:
    return {node.name: node for node in nodes}


def _in_order(keys: Iterable[K], known: Mapping[K, T], places: Mapping[K, int]) -> list[T]:
    return [known[key] for key in sorted(known.keys() & set(keys), key=places.__getitem__)]


def _actions(interfaces: Sequence[Interface]) -> Mapping[object, Action]:
    return {known.type: known for known in reversed(interfaces) if isinstance(known, Action)}


def _message_of_action(type_: Named, known: Mapping[object, Action]) -> Message | None:
    """Return the message that ROS generates from one of the known actions."""
    for generated in generated_from(type_):
        action = known.get(generated.action)
        if action is not None:
            parts = {"goal": action.goal, "result": action.result, "feedback": action.feedback}
            wrapped = tuple(Field(name, inside) for name, inside in generated.fields)
            return Message(type_, wrapped or parts[generated.part], action.external)
    return None
