"""Context of lowering: names in the system, types of expressions."""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from typing import Any, cast

from swarmdsl import ir
from swarmdsl.analysis.event_topics import received_topic
from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.analysis.resolve.interfaces import Interfaces
from swarmdsl.analysis.resolve.type_names import interface_name
from swarmdsl.analysis.types import Typing
from swarmdsl.analysis.types.enum_values import underlying
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.naming import camel_case, snake_case
from swarmdsl.base.records import dataclass, field, replace
from swarmdsl.project.loader import File, Project
from swarmdsl.syntax.ast import (
    Activity,
    BehaviorUse,
    Component,
    Declaration,
    EnumType,
    Event,
    Member,
    MonitorTrigger,
    Operation,
    Param,
    Part,
    Ref,
    Region,
    StateMachine,
    TypeRef,
    Variable,
    Vertex,
    nodes_of,
)


@dataclass(frozen=True)
class Context:
    """Names and types that all of lowering needs.

    `names` gives each declaration its name in the system: its own, prefixed with the package
    if two packages use the same. `operations` gives the functions of operations
    by the namespace of their server, `services` the types of these servers. `heard` gives the
    events by incoming topic; `monitored` are those of them that exist only because a transition
    monitors their topic.
    `behaving` are the members and components by machine, `parts` those of members by component.
    In a machine that another one reuses, `variables` gives the new names of its variables and
    `values` the values of its params. `enums` are the integer types of enums.
    `states` gives the ids of the states in a machine, as it is used.
    """

    names: Mapping[Declaration, str]
    operations: Mapping[tuple[str, Operation], str]
    services: Mapping[Operation, ir.Named]
    heard: Mapping[str, str]
    monitored: tuple[ir.Event, ...]
    typing: Typing
    behaving: Mapping[StateMachine, list[Member | Component]]
    parts: Mapping[Component, list[Part]]
    variables: Mapping[Variable, str] = field(default_factory=dict)
    values: Mapping[Param, ir.Expression] = field(default_factory=dict)
    enums: Mapping[ir.Named, ir.Primitive] = field(default_factory=dict)
    states: Mapping[Vertex | Region, str] = field(default_factory=dict)

    def name(self, ref: Ref[Any]) -> str:
        """Return the name of the target of a resolved reference."""
        return self.names[cast("Declaration", ref.target)]

    def declared(self, declaration: Declaration) -> str:
        """Return the name of a declaration, of a library too."""
        return self.names.get(declaration, str(declaration.name))

    def function(self, activity: Activity) -> str:
        """Return the name of the function that an activity calls."""
        operation = activity.function.target
        if not isinstance(operation, Operation):
            return self.name(activity.function)
        assert isinstance(activity.owner, (Component, Part))
        return self.operations[self.namespace(activity.owner), operation]

    def namespace(self, owner: Component | Part) -> str:
        """Return the namespace of the servers of its operations, below the robot's."""
        return str(owner.name) if isinstance(owner, Part) else snake_case(self.names[owner])

    def offered(self, owner: Component | Part) -> tuple[str, ...]:
        """Return the functions of its operations, inherited ones first."""
        namespace = self.namespace(owner)
        return tuple(self.operations[namespace, item] for item in operations_of(owner))

    def reusing(
        self, variables: Mapping[Variable, str], values: Mapping[Param, ir.Expression]
    ) -> Context:
        """Return the context inside a reused machine."""
        return replace(self, variables=variables, values=values)

    def with_event(self, types: Sequence[ir.Type], *, of_swarm: bool) -> Context:
        """Return the context of events with messages of these types: `event` is one of them."""
        alike = all(each == types[0] for each in types)
        typing = self.typing.on_event(types[0], known=alike, of_swarm=of_swarm)
        return replace(self, typing=typing)

    def type_of(self, ref: TypeRef) -> ir.Type:
        """Return the type of a resolved type reference; for an enum its integer type."""
        assert ref.type is not None
        return self.plain(ref.type)

    def plain(self, type_: ir.Type) -> ir.Type:
        """Return the type with integer types instead of enums."""
        if isinstance(type_, ir.Array):
            return replace(type_, element=self.plain(type_.element))
        if not isinstance(type_, ir.Named) or type_ not in self.enums:
            return type_
        return replace(self.enums[type_], enum=type_)


def make_context(project: Project, pairs: list[tuple[File, Declaration]]) -> Context:
    """Name the declarations of the system and collect types and behaviours."""
    count = Counter(str(declaration.name) for _, declaration in pairs)
    names: dict[Declaration, str] = {}
    behaving: dict[StateMachine, list[Member | Component]] = {}
    parts: dict[Component, list[Part]] = {}
    enums: dict[ir.Named, ir.Primitive] = {}
    taken = set(count)
    for file, declaration in pairs:
        name = str(declaration.name)
        if count[name] > 1:
            name = f"{file.package.replace('.', '_')}_{name}"
            while name in taken:
                name += "_"
            taken.add(name)
        names[declaration] = name
        if isinstance(declaration, EnumType) and declaration.type is not None:
            enums[declaration.type] = underlying(declaration)
        if isinstance(declaration, (Member, Component)):
            for use in all_items(declaration, BehaviorUse):
                if use.machine.target is not None:
                    behaving.setdefault(use.machine.target, []).append(declaration)
        for part in all_items(declaration, Part) if isinstance(declaration, Member) else ():
            if part.component.target is not None:
                parts.setdefault(part.component.target, []).append(part)
    taken = set(names.values())
    operations: dict[tuple[str, Operation], str] = {}
    services: dict[Operation, ir.Named] = {}
    typing = Typing(Interfaces(project.declarations()), Diagnostics())
    context = Context(names, operations, services, {}, (), typing, behaving, parts, enums=enums)
    for file, declaration in pairs:
        for item in declaration.items if isinstance(declaration, Component) else ():
            if isinstance(item, Operation):
                service = f"{declaration.name}{camel_case(item.name)}"
                services[item] = interface_name(file, service)
    for owner in operation_owners(pairs):
        namespace = context.namespace(owner)
        for item in operations_of(owner):
            if (namespace, item) not in operations:
                name = f"{namespace}_{item.name}"
                while name in taken:
                    name += "_"
                taken.add(name)
                operations[namespace, item] = name
    heard: dict[str, str] = {}
    for _, declaration in pairs:
        if isinstance(declaration, Event):
            heard.setdefault(received_topic(declaration), names[declaration])
    monitored = tuple(_monitored(pairs, heard, taken))
    heard.update({event.topic: event.name for event in monitored})
    return replace(context, heard=heard, monitored=monitored)


def operation_owners(pairs: Iterable[tuple[File, Declaration]]) -> list[Component | Part]:
    """Return the owners of operations: components, then the parts of members."""
    owners = [declaration for _, declaration in pairs]
    return [
        *(owner for owner in owners if isinstance(owner, Component)),
        *(item for owner in owners if isinstance(owner, Member) for item in all_items(owner, Part)),
    ]


def operations_of(owner: Component | Part) -> list[Operation]:
    """Return the operations of a component, or of a part's component."""
    component = owner.component.target if isinstance(owner, Part) else owner
    assert component is not None
    return all_items(component, Operation)


def _monitored(
    pairs: Iterable[tuple[File, Declaration]], declared: Container[str], taken: set[str]
) -> Iterator[ir.Event]:
    """Yield an event for each other monitored topic, with its chosen name or that of the topic."""
    monitors: dict[str, MonitorTrigger] = {}
    chosen: dict[str, str] = {}
    for _, declaration in pairs:
        for node in nodes_of(declaration, MonitorTrigger):
            topic = received_topic(node)
            if node.type.type is None or topic in declared:
                continue
            monitors.setdefault(topic, node)
            if node.name is not None:
                chosen.setdefault(topic, str(node.name))
    taken.update(chosen.values())
    for topic, node in monitors.items():
        assert node.type.type is not None
        name = chosen.get(topic)
        if name is None:
            name = camel_case(topic)
            if not name[:1].isalpha():
                name = f"Topic{name}"
            while name in taken:
                name += "_"
            taken.add(name)
        yield ir.Event(name, node.type.type, topic, False, "", node.span)
