"""Facts of properties and measures, with their robots, states and values.

A state has its name or a path, as in tests: `Search.Sweep` is a state `Sweep` anywhere inside a
state or region `Search`, in a reused machine too.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TypeVar

from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.analysis.resolve.states import content, regions, states_by_name
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    BehaviorUse,
    Choice,
    Component,
    Container,
    Fact,
    Fitness,
    FitnessUse,
    History,
    Measure,
    Member,
    Node,
    Param,
    Part,
    Property,
    PropertySubject,
    Role,
    StateMachine,
    Swarm,
    TopLevel,
    Variable,
    Vertex,
    Who,
    nodes_of,
    walk,
)

Path = tuple[str, ...]
Sentence = Property | Measure
"""Node with facts about the robots of its subject, or about the robot of its `each`."""
N = TypeVar("N", bound=Node)


def subjects_of(owner: Property | Fitness, project: Project) -> Sequence[PropertySubject]:
    """Return what a property or fitness that names no subject can be about.

    For a property, these are all swarms, or all state machines of a model without swarms.
    """
    if isinstance(owner, Fitness):
        return measured_swarms(owner, project)
    return _own(project, Swarm) or _own(project, StateMachine)


def measured_swarms(fitness: Fitness, project: Project) -> list[Swarm]:
    """Return what a fitness that names no swarm can be about: those that have it, else all."""
    swarms = _own(project, Swarm)
    return [each for each in swarms if _has(each, fitness)] or swarms


def _own(project: Project, kind: type[N]) -> list[N]:
    own = (node for file, node in project.declarations() if not file.library)
    return [node for node in own if isinstance(node, kind)]


def _has(swarm: Swarm, fitness: Fitness) -> bool:
    """Return True if a swarm has a fitness; this reference is resolved before."""
    uses = (item for item in swarm.items if isinstance(item, FitnessUse))
    return any(use.fitness.target is fitness for use in uses)


def facts_in(sentence: Sentence) -> list[Fact]:
    """Return the facts in a sentence, in document order."""
    return _nodes(sentence, Fact)


def robots_in(sentence: Sentence) -> list[Who]:
    """Return what names robots in a sentence, in document order."""
    return _nodes(sentence, Who)


def each_robot_of(measure: Measure) -> Fact | None:
    """Return the fact of a measure that is about each robot of a role: `count(role in State)`."""
    if measure.until or len(measure.claim.any) > 1 or len(measure.claim.any[0].all) > 1:
        return None
    term = measure.claim.any[0].all[0]
    who = term.fact.who if term.fact is not None and not term.negated else None
    return term.fact if who is not None and not (who.quantifier or who.lower or who.index) else None


def _nodes(sentence: Sentence, kind: type[N]) -> list[N]:
    if isinstance(sentence, TopLevel):
        return [*nodes_of(sentence, kind)]
    return [node for node in walk(sentence) if isinstance(node, kind)]


def is_from_outside(fact: Fact) -> bool:
    """Return True for the fact that an event arrives from outside, which is about no robot."""
    return fact.event is not None and not fact.act


def roles_of(subject: PropertySubject | None) -> dict[str, Role]:
    """Return the roles of a swarm by name; a machine has none."""
    items = subject.items if isinstance(subject, Swarm) else ()
    return {str(item.name): item for item in items if isinstance(item, Role)}


def role_of_fact(fact: Fact, owner: Sentence) -> Role | None:
    """Return the role that a fact is about: its own, or that of `each`."""
    if fact.counted is not None:
        return fact.counted.target
    if fact.who is not None:
        return fact.who.role.target
    return owner.each.role.target if owner.each is not None else None


def machines_of_fact(fact: Fact, owner: Sentence) -> list[StateMachine]:
    """Return the machines that the robots of a fact and their parts run."""
    if isinstance(owner.about, StateMachine):
        return [owner.about] if fact.counted is None and fact.who is None else []
    return machines_of_role(role_of_fact(fact, owner))


def machines_of_role(role: Role | None) -> list[StateMachine]:
    """Return the machines of the members of a role."""
    member = role.member.target if role is not None else None
    return machines_of_member(member) if member is not None else []


def machines_of_member(member: Member) -> list[StateMachine]:
    """Return the machines that a member and its parts run."""
    components = [part.component.target for part in all_items(member, Part)]
    runners: list[Member | Component] = [member, *(each for each in components if each is not None)]
    uses = [use.machine.target for each in runners for use in all_items(each, BehaviorUse)]
    return list(dict.fromkeys(machine for machine in uses if machine is not None))


def values_of_fact(fact: Fact, owner: Sentence) -> dict[str, Variable | Param]:
    """Return the variables and params of the robots of a fact, without those of parts.

    A variable of a state is among them if no other value of the robots has its name. An event from
    outside is about no robot.
    """
    if is_from_outside(fact):
        return {}
    role = role_of_fact(fact, owner)
    member = role.member.target if role is not None else None
    machines = [owner.about] if isinstance(owner.about, StateMachine) else []
    found: dict[str, Variable | Param] = {}
    if member is not None:
        machines = [
            use.machine.target
            for use in all_items(member, BehaviorUse)
            if use.machine.target is not None
        ]
        found = {str(param.name): param for param in all_items(member, Param)}
    for machine in machines:
        for item in machine.items:
            if isinstance(item, (Variable, Param)):
                found.setdefault(str(item.name), item)
    inner = [each for machine in machines for each in nodes_of(machine, Variable)]
    count = Counter(str(each.name) for each in inner)
    return {**{str(each.name): each for each in inner if count[str(each.name)] == 1}, **found}


def state_paths(machine: StateMachine) -> Iterator[tuple[Path, Vertex]]:
    """Yield the states in which a machine can be, with their paths, outer ones first.

    Paths have the regions, as in traces.
    """
    work: list[tuple[Path, Vertex | Container, frozenset[StateMachine]]] = [
        ((), machine, frozenset((machine,)))
    ]
    while work:
        path, outer, around = work.pop(0)
        inner: Vertex | Container | None = content(outer)
        if isinstance(inner, StateMachine) and inner is not machine:
            if inner in around:
                continue  # a check reports machines that contain themselves
            around |= {inner}
        within = inner if inner is not None else outer
        holders: list[tuple[Path, Vertex | Container]]
        holders = [((*path, str(each.name)), each) for each in regions(within)]
        for place, holder in holders or [(path, within)]:
            for each in states_by_name(holder).values():
                for state in each:
                    if not isinstance(state, (Choice, History)):
                        found = (*place, str(state.name))
                        yield found, state
                        work.append((found, state, around))


def matches(path: Path, written: Sequence[str]) -> bool:
    """Return True if a path ends with the last written name and has the others before it."""
    if path[-1] != written[-1]:
        return False
    names = iter(path[:-1])
    return all(name in names for name in written[:-1])


def find_states(
    machines: Iterable[StateMachine], name: str
) -> Mapping[Path, tuple[StateMachine, Vertex]]:
    """Return the states that a name or a path means: one, unless it is ambiguous or unknown."""
    written = tuple(name.split("."))
    found = {}
    for machine in machines:
        for path, state in state_paths(machine):
            if matches(path, written):
                if path == written:
                    return {path: (machine, state)}
                found[path] = (machine, state)
    return found
