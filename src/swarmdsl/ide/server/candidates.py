"""What a name can mean where it stands: the declarations and states that are in sight there."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.analysis.resolve.scopes import FileScope
from swarmdsl.analysis.resolve.states import content, regions, vertices
from swarmdsl.driver.workspace import Workspace
from swarmdsl.ide.server.fields import fields_of
from swarmdsl.ide.server.speculative_parse import WORD
from swarmdsl.syntax.ast import (
    NODES,
    Activity,
    Component,
    Constant,
    Container,
    DoneTrigger,
    EnumType,
    FieldUse,
    FinalState,
    FitnessInput,
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
    Ref,
    Region,
    Role,
    State,
    StateMachine,
    Swarm,
    TopLevel,
    Variable,
    nodes_of,
    references,
    walk,
)


class Candidates:
    """Looks for what can stand at an offset, in the declaration that is `around` it."""

    def __init__(
        self, workspace: Workspace, scope: FileScope, around: TopLevel, offset: int
    ) -> None:
        self._workspace = workspace
        self._scope = scope
        self._around = around
        self._offset = offset

    def of(self, owner: TopLevel) -> Iterator[Iterable[Node]]:
        """What the word on trial in a declaration can mean.

        Nothing where no name of something that exists stands.
        """
        for holder, ref in references(owner):
            if WORD in ref.name:
                yield self._meant(holder, ref, owner)
        for field in nodes_of(owner, FieldUse):
            if field.name == WORD:
                base = field.base
                enum = base.target if isinstance(base, NameUse) else None
                if isinstance(enum, EnumType):
                    yield enum.values
                else:
                    yield fields_of(field, owner, self._workspace.project)
        for use in nodes_of(owner, NameUse):
            if WORD in use.name:
                kinds = (Variable, Param, FitnessInput)
                own = [node for kind in kinds for node in nodes_of(self._around, kind)]
                yield [*own, *self._visible((Constant, EnumType))]

    def _meant(self, holder: Node, ref: Ref[Node], owner: TopLevel) -> Iterable[Node]:
        """What a reference can lead to."""
        path = ref.name.partition(WORD)[0].rstrip(".").split(".")
        around = self._around
        match holder, around:
            case PortRef(part=part), Member():
                parts = {str(each.name): each for each in all_items(around, Part)}
                if part is not None and WORD not in part.name:
                    component = parts[part.name].component.target if part.name in parts else None
                    return all_items(component, Port) if component is not None else ()
                return [*parts.values(), *all_items(around, Port)]
            case DoneTrigger(region=region), StateMachine():
                inner = self._containers()[-1]
                if region is ref:
                    return regions(inner)
                inside = content(inner)
                return [v for v in vertices(inside) if isinstance(v, FinalState)] if inside else ()
            case Activity(owner=Component() | Part() | None as of), _:
                return self._done(path, of)
        kind = NODES.get(ref.kind)
        if ref.kind == "Vertex" and isinstance(around, StateMachine):
            if path != [""]:
                named: list[State | Parallel] = [
                    *nodes_of(around, State),
                    *nodes_of(around, Parallel),
                ]
                return [v for each in named if each.name == path[-1] for v in _inside(each)]
            levels = [_inside(each) for each in reversed(self._containers())]
            return [vertex for level in levels for vertex in level]
        if isinstance(around, Optimization) and kind is Role:
            swarm = self._scope.one(around.swarm.name, Swarm)
            return [each for each in swarm.items if isinstance(each, Role)] if swarm else ()
        if kind is None or not issubclass(kind, TopLevel):
            return ()
        package = ".".join(path)
        return [
            node
            for node in self._visible((kind,))
            if not package or self._scope.find(f"{package}.{node.name}")  # type: ignore[attr-defined]
        ]

    def _done(self, path: list[str], owner: Component | Part | None) -> Iterable[Node]:
        """What a state can do: functions, and operations of components and parts."""
        if path == [""]:
            return [*self._visible((NODES["Function"],)), *self._parts()]
        if isinstance(owner, Part):
            owner = owner.component.target
        return all_items(owner, Operation) if owner is not None else ()

    def _parts(self) -> list[Part]:
        """The parts with operations of a member that runs the machine."""
        if not isinstance(self._around, StateMachine):
            return []
        return [
            part
            for runner in self._workspace.runners(self._around)[:1]
            for part in all_items(runner, Part)
            if part.component.target and all_items(part.component.target, Operation)
        ]

    def _containers(self) -> list[Container]:
        """The machine and the states around the offset, the innermost last."""
        assert isinstance(self._around, StateMachine)
        return containers(self._around, self._offset)

    def _visible(self, kinds: tuple[type[Node], ...]) -> list[Node]:
        """The declarations of some kinds that the file sees."""
        return visible(self._scope, kinds)


def visible(scope: FileScope, kinds: tuple[type[Node], ...]) -> list[Node]:
    """The declarations of some kinds that a file sees."""
    found: list[Node] = []
    for kind in kinds:
        for name in scope.names(kind):  # type: ignore[arg-type]
            found += [node for _, node in scope.find(name) if isinstance(node, kind)]
    return found


def containers(machine: StateMachine, offset: int) -> list[Container]:
    """The machine and the states around an offset, the innermost last."""
    found: list[Container] = []
    for node in walk(machine):
        if isinstance(node, (StateMachine, State, Parallel, Region)):
            span = node.span.absolute
            if span.start <= offset <= span.end:
                found.append(node)
    return found or [machine]


def _inside(state: Node) -> list[Node]:
    """The states directly inside another, those in its regions among them."""
    if isinstance(state, Parallel):
        return [each for region in regions(state) for each in vertices(region)]
    return list(vertices(state)) if isinstance(state, (State, Region, StateMachine)) else []
