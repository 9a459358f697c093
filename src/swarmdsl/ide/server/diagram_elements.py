"""Elements of diagrams that show a position of the text.

Names are taken from the text, so that a model with errors has elements, too.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TypeVar

from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.references import owner_at
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    Branch,
    Choice,
    Component,
    Connector,
    Environment,
    EnvironmentUse,
    FinalState,
    Fitness,
    FitnessUse,
    History,
    Initial,
    Member,
    Node,
    Optimization,
    Parallel,
    Part,
    Port,
    Region,
    RobotValues,
    Role,
    State,
    StateMachine,
    Swarm,
    Transition,
    children,
)

N = TypeVar("N", bound=Node)
Element = tuple[str, str]
"""Id of a diagram, and of a node, edge or port in it; its frame has an empty id."""


def elements_at(workspace: Workspace, file: File, offset: int) -> list[Element]:
    """Return the elements that show an offset, that of its own diagram first.

    A diagram may not exist: a member without parts has none.
    """
    text = file.source.text
    # The indentation belongs to the first word of its line.
    while text[offset : offset + 1] in (" ", "\t") and not _begun(text, offset):
        offset += 1
    owner = owner_at(file, offset)
    inside = _inside(owner, offset) if owner is not None else None
    match owner:
        case StateMachine():
            return [(f"{owner.name}.statechart", _in_machine(owner, offset))]
        case Swarm():
            return [(f"{owner.name}.composition", _in_swarm(inside))]
        case Optimization():
            return [(f"{owner.swarm.name}.composition", "swarm")]
        case Member():
            shown = (f"{owner.name}.internal", _in_member(owner, inside))
            return [shown, *_roles(workspace, owner)]
        case Component():
            return list(_parts(workspace, owner, inside))
        case Environment() | Fitness():
            return list(_around(workspace, owner))
    return []


def _begun(text: str, offset: int) -> bool:
    """Return True if a line has words before an offset."""
    return bool(text[text.rfind("\n", 0, offset) + 1 : offset].strip())


def _inside(node: Node, offset: int) -> Node | None:
    """Return the child at an offset; of two that touch there, the one that begins."""
    found = None
    for child in children(node):
        span = child.span.absolute
        if span.start <= offset <= span.end:
            found = child
    return found


def _in_machine(machine: StateMachine, offset: int) -> str:
    """Return the innermost state, or the transition in it."""
    id_ = ""
    node: Node = machine
    while True:
        inside = _inside(node, offset)
        match inside:
            case State() | Parallel() | Region() | Choice() | History() | FinalState():
                id_ = f"{id_}.{inside.name}" if id_ else str(inside.name)
                node = inside
            case Initial():
                return f"{id_}#initial->"
            case Transition() | Branch():
                # Transitions are numbered in each state.
                leaving = [each for each in children(node) if isinstance(each, type(inside))]
                return f"{id_}->{leaving.index(inside)}"
            case _:
                return id_


def _in_swarm(inside: Node | None) -> str:
    match inside:
        case Role():
            return f"role.{inside.name}"
        case RobotValues():
            return f"role.{inside.role.name}"
        case EnvironmentUse():
            return "environment"
        case FitnessUse():
            return "fitness"
    return "swarm"


def _in_member(member: Member, inside: Node | None) -> str:
    match inside:
        case Part():
            return str(inside.name)
        case Port():
            return f":{inside.name}"
        # Connectors are numbered; those of the base come first, in another declaration.
        case Connector() if member.base is None:
            connectors = [each for each in member.items if isinstance(each, Connector)]
            return f"connector{connectors.index(inside)}"
    return ""


def _roles(workspace: Workspace, member: Member) -> Iterator[Element]:
    for swarm in _declared(workspace, Swarm):
        for each in swarm.items:
            if isinstance(each, Role) and each.member.target is member:
                yield f"{swarm.name}.composition", f"role.{each.name}"


def _parts(workspace: Workspace, component: Component, inside: Node | None) -> Iterator[Element]:
    port = f":{inside.name}" if isinstance(inside, Port) else ""
    for member in _declared(workspace, Member):
        for each in member.items:
            if isinstance(each, Part) and each.component.target is component:
                yield f"{member.name}.internal", f"{each.name}{port}"


def _around(workspace: Workspace, owner: Environment | Fitness) -> Iterator[Element]:
    for swarm in _declared(workspace, Swarm):
        for each in swarm.items:
            if isinstance(each, EnvironmentUse) and each.environment.target is owner:
                yield f"{swarm.name}.composition", "environment"
            if isinstance(each, FitnessUse) and each.fitness.target is owner:
                yield f"{swarm.name}.composition", "fitness"


def _declared(workspace: Workspace, kind: type[N]) -> Iterable[N]:
    return (each for _, each in workspace.project.declarations() if isinstance(each, kind))
