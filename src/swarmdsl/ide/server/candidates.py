"""Candidates for a name at the cursor: visible declarations and states."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.analysis.resolve.addresses import machines_in, roles_of, swarms_of
from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.analysis.resolve.membership import member_events, presence_calls
from swarmdsl.analysis.resolve.scopes import FileScope
from swarmdsl.analysis.resolve.sentences import (
    Path,
    Sentence,
    facts_in,
    machines_of_fact,
    machines_of_member,
    matches,
    state_paths,
    subjects_of,
    values_of_fact,
)
from swarmdsl.analysis.resolve.sentences import roles_of as property_roles
from swarmdsl.analysis.resolve.space import areas_of, goal_fields, targets_of
from swarmdsl.analysis.resolve.states import content, regions, vertices
from swarmdsl.driver.workspace import Workspace
from swarmdsl.ide.server.fields import fields_of
from swarmdsl.ide.server.speculative_parse import PLACEHOLDER
from swarmdsl.syntax.ast import (
    NODES,
    Activity,
    Address,
    Area,
    Component,
    Constant,
    Container,
    DeferredEvent,
    DoneTrigger,
    EnumType,
    Environment,
    EnvironmentUse,
    Event,
    EventTrigger,
    Fact,
    FieldUse,
    FinalState,
    Fitness,
    FitnessInput,
    Function,
    Measure,
    Member,
    NameUse,
    Node,
    Operation,
    Optimization,
    Parallel,
    Param,
    Part,
    Port,
    PortRef,
    Property,
    PropertySubject,
    Ref,
    Region,
    Role,
    SafeState,
    State,
    StateMachine,
    Swarm,
    Targets,
    TopLevel,
    Variable,
    name_of,
    nodes_of,
    references,
    walk,
)


class Candidates:
    """Candidates at an offset in the declaration `around` it."""

    def __init__(
        self, workspace: Workspace, scope: FileScope, around: TopLevel, offset: int
    ) -> None:
        self._workspace = workspace
        self._scope = scope
        self._around = around
        self._offset = offset

    def of(self, owner: TopLevel) -> Iterator[Iterable[Node]]:
        """Yield the possible targets of the placeholder in a declaration.

        Yields nothing if the placeholder does not refer to an existing element.
        """
        for holder, ref in references(owner):
            if PLACEHOLDER in ref.name:
                yield self._targets(holder, ref, owner)
        for field in nodes_of(owner, FieldUse):
            if field.name == PLACEHOLDER:
                base = field.base
                enum = base.target if isinstance(base, NameUse) else None
                if isinstance(enum, EnumType):
                    yield enum.values
                else:
                    yield fields_of(field, owner, self._workspace.project)
        counted = {each for call in presence_calls(owner) for each in call.arguments}
        if any(PLACEHOLDER in each.span.text for each in counted):
            yield self._roles()
        for use in nodes_of(owner, NameUse):
            if PLACEHOLDER in use.name and use not in counted:
                kinds = (Variable, Param, FitnessInput)
                own: list[Node] = [n for kind in kinds for n in nodes_of(self._around, kind)]
                if isinstance(owner, (Property, Fitness)):
                    read = self._of_robots(use, owner)
                    own = own if read is None else read
                if isinstance(self._around, StateMachine):
                    seen = {each for around in self._containers() for each in around.items}
                    own = [node for node in own if node in seen]
                if isinstance(owner, Function):
                    own += goal_fields(owner, self._scope.interfaces) or ()
                roles = self._roles() if _is_address(use, owner) else []
                yield [*roles, *own, *self._visible((Constant, EnumType))]

    def _targets(self, holder: Node, ref: Ref[Node], owner: TopLevel) -> Iterable[Node]:
        """Return the possible targets of a reference."""
        path = ref.name.partition(PLACEHOLDER)[0].rstrip(".").split(".")
        around = self._around
        match holder, around:
            case PortRef(part=part), Member():
                parts = {str(each.name): each for each in all_items(around, Part)}
                if part is not None and PLACEHOLDER not in part.name:
                    component = parts[part.name].component.target if part.name in parts else None
                    return all_items(component, Port) if component is not None else ()
                return [*parts.values(), *all_items(around, Port)]
            case DoneTrigger(region=region), StateMachine():
                inner = self._containers()[-1]
                if region is ref:
                    return regions(inner)
                inside = content(inner)
                return [v for v in vertices(inside) if isinstance(v, FinalState)] if inside else ()
            case SafeState(), Member():
                return _states_of(machines_of_member(around), path)
            case Activity(owner=Component() | Part() | None as of), _:
                return self._callables(path, of)
        kind = NODES.get(ref.kind)
        if kind is Area or kind is Targets:
            return self._in_space(kind)
        if ref.kind == "Vertex" and isinstance(around, StateMachine):
            if path != [""]:
                named: list[State | Parallel] = [
                    *nodes_of(around, State),
                    *nodes_of(around, Parallel),
                ]
                return [v for each in named if each.name == path[-1] for v in _substates(each)]
            levels = [_substates(each) for each in reversed(self._containers())]
            return [vertex for level in levels for vertex in level]
        if isinstance(owner, (Property, Fitness)) and ref.kind in ("Role", "Vertex"):
            return self._in_sentence(holder, ref, owner, path)
        if isinstance(holder, Fact) and not holder.act and isinstance(owner, (Property, Fitness)):
            # An event from outside, or a role before a verb.
            roles = property_roles(self._about(owner)).values()
            return [*self._visible((NODES["Event"],)), *roles]
        if isinstance(around, Optimization) and kind is Role:
            swarm = self._scope.one(around.swarm.name, Swarm)
            return [each for each in swarm.items if isinstance(each, Role)] if swarm else ()
        if kind is None or not issubclass(kind, TopLevel):
            return ()
        package = ".".join(path)
        if not package and isinstance(holder, (DeferredEvent, EventTrigger)):
            _, of_members = member_events()
            declared = self._scope.names(Event)
            undeclared = [node for name, node in of_members.items() if name not in declared]
            return [*self._visible((kind,)), *undeclared]
        return [
            node
            for node in self._visible((kind,))
            if not package or self._scope.find(f"{package}.{name_of(node)}")
        ]

    def _in_space(self, kind: type[Node]) -> Iterable[Node]:
        """Return the areas around the offset, or the targets of all environments."""
        if kind is Targets:
            return list(targets_of(self._workspace.project).values())
        around = self._around
        if isinstance(around, Swarm):
            uses = [item for item in around.items if isinstance(item, EnvironmentUse)]
            found = self._scope.one(uses[0].environment.name, Environment) if uses else None
        else:
            found = around if isinstance(around, Environment) else None
        return list(areas_of(found).values()) if found is not None else ()

    def _in_sentence(
        self, holder: Node, ref: Ref[Node], owner: Property | Fitness, path: list[str]
    ) -> Iterable[Node]:
        """Return the roles or the states that a property or a measure can name."""
        roles = property_roles(self._about(owner))
        if ref.kind == "Role" or not isinstance(holder, Fact):
            return list(roles.values())
        sentence = self._sentence(holder, owner)
        machines = machines_of_fact(holder, sentence) if sentence is not None else []
        return _states_of(machines, path)

    def _of_robots(self, use: NameUse, owner: Property | Fitness) -> list[Node] | None:
        """Return the values of robots that a condition of a fact can read; None elsewhere."""
        for fact in nodes_of(owner, Fact):
            if fact.guard is not None and any(node is use for node in walk(fact.guard)):
                sentence = self._sentence(fact, owner)
                return [*values_of_fact(fact, sentence).values()] if sentence is not None else []
        return None

    def _sentence(self, fact: Fact, owner: Property | Fitness) -> Sentence | None:
        """Return the sentence of a fact, with its roles resolved."""
        sentences: list[Sentence] = [owner] if isinstance(owner, Property) else []
        sentences += nodes_of(owner, Measure)
        about = self._about(owner)
        roles = property_roles(about)
        for sentence in sentences:
            if fact in facts_in(sentence):
                sentence.about = about
                named = [sentence.each.role] if sentence.each is not None else []
                named += [fact.who.role] if fact.who is not None else []
                named += [fact.counted] if fact.counted is not None else []
                for role in named:
                    role.target = roles.get(role.name)
                return sentence
        return None

    def _about(self, owner: Property | Fitness) -> PropertySubject | None:
        """Return what a property or the measures of a fitness are about."""
        if owner.subject is not None:
            name = owner.subject.name
            return self._scope.one(name, Swarm) or self._scope.one(name, StateMachine)
        own = subjects_of(owner, self._workspace.project)
        return own[0] if len(own) == 1 else None

    def _roles(self) -> list[Node]:
        """Return the roles of the swarms that run the machine; of all swarms if none does."""
        swarms = swarms_of(self._workspace.project)
        running = [each for each in swarms if self._around in machines_in(each)]
        return [role for each in running or swarms for role in roles_of(each).values()]

    def _callables(self, path: list[str], owner: Component | Part | None) -> Iterable[Node]:
        """Return the functions, and operations of components and parts, that a state can call."""
        if path == [""]:
            return [*self._visible((NODES["Function"],)), *self._parts()]
        if isinstance(owner, Part):
            owner = owner.component.target
        return all_items(owner, Operation) if owner is not None else ()

    def _parts(self) -> list[Part]:
        """Return the parts with operations of the first member that runs the machine."""
        if not isinstance(self._around, StateMachine):
            return []
        return [
            part
            for runner in self._workspace.runners(self._around)[:1]
            for part in all_items(runner, Part)
            if part.component.target and all_items(part.component.target, Operation)
        ]

    def _containers(self) -> list[Container]:
        """Return the machine and the states around the offset, innermost last."""
        assert isinstance(self._around, StateMachine)
        return containers(self._around, self._offset)

    def _visible(self, kinds: tuple[type[Node], ...]) -> list[Node]:
        """Return the declarations of some kinds that are visible in the file."""
        return visible(self._scope, kinds)


def _is_address(use: NameUse, owner: TopLevel) -> bool:
    """Return True for a name in the place of the role of an address."""
    return any(each.role_use is use for each in nodes_of(owner, Address))


def visible(scope: FileScope, kinds: tuple[type[Node], ...]) -> list[Node]:
    """Return the declarations of some kinds that are visible in a file."""
    found: list[Node] = []
    for kind in kinds:
        for name in scope.names(kind):
            found += [node for _, node in scope.find(name) if isinstance(node, kind)]
    return found


def containers(machine: StateMachine, offset: int) -> list[Container]:
    """Return the machine and the states around an offset, innermost last."""
    found: list[Container] = []
    for node in walk(machine):
        if isinstance(node, (StateMachine, State, Parallel, Region)):
            span = node.span.absolute
            if span.start <= offset <= span.end:
                found.append(node)
    return found or [machine]


def _substates(state: Node) -> list[Node]:
    """Return the direct substates of a state, including those in its regions."""
    if isinstance(state, Parallel):
        return [each for region in regions(state) for each in vertices(region)]
    return list(vertices(state)) if isinstance(state, (State, Region, StateMachine)) else []


def _states_of(machines: Iterable[StateMachine], path: list[str]) -> list[Node]:
    """Return the states of machines; after the path of a state, those inside it."""
    paths = [found for machine in machines for found in state_paths(machine)]
    states = {names for names, _ in paths}
    return [
        v
        for names, v in paths
        if path == [""] or any(matches(around, path) for around in _around(names, states))
    ]


def _around(path: Path, states: set[Path]) -> list[Path]:
    """Return the paths that can be before the name of a state: its region and its state."""
    outer = path[:-1]
    found = [outer] if outer in states else [outer, outer[:-1]]
    return [each for each in found if each]
