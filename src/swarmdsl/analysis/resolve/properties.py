"""Resolve names in properties and measures: subject, roles, states, and values of robots.

A state has its name or a path, as in tests: `Search.Sweep` is a state `Sweep` anywhere inside a
state or region `Search`, in a reused machine too.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from typing import TypeVar

from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.analysis.resolve.report_unresolved import report_missing_inside, resolve_or_report
from swarmdsl.analysis.resolve.scopes import FileScope
from swarmdsl.analysis.resolve.space import targets_of
from swarmdsl.analysis.resolve.states import content, regions, states_by_name
from swarmdsl.analysis.resolve.values import ValueLinker
from swarmdsl.base.diagnostics.advice import write
from swarmdsl.base.diagnostics.collector import Diagnostics, Label, listed
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    BehaviorUse,
    Choice,
    Component,
    Container,
    Contract,
    Expression,
    Fact,
    Fitness,
    FitnessInput,
    FitnessUse,
    History,
    Measure,
    Member,
    Node,
    Param,
    Part,
    Property,
    PropertySubject,
    Ref,
    Role,
    SpaceMeasure,
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

_SUBJECTS: tuple[type[Swarm | StateMachine], ...] = (Swarm, StateMachine)


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


def link_property(
    owner: Property, scope: FileScope, values: ValueLinker, report: Diagnostics
) -> None:
    """Resolve the names in a property except those of events and functions."""
    owner.about = _subject(owner, scope, report)
    guards = _link_facts(owner, owner, scope, values, report)
    values.link_only([e for e in nodes_of(owner, Expression) if e not in guards], owner, {})


def link_fitness(
    owner: Fitness, scope: FileScope, values: ValueLinker, report: Diagnostics
) -> None:
    """Resolve the names in a fitness except those of events and functions."""
    measures, in_space = nodes_of(owner, Measure), nodes_of(owner, SpaceMeasure)
    owner.about = owner.subject.target if owner.subject is not None else None
    if (measures or in_space) and owner.subject is None:
        found = measured_swarms(owner, scope.project)
        owner.about = found[0] if len(found) == 1 else None
    guards: set[Expression] = set()
    for measure in measures:
        measure.about = owner.about
        guards |= _link_facts(measure, owner, scope, values, report)
    for each in in_space:
        _link_in_space(each, owner, scope, report)
    own: dict[str, FitnessInput | Param] = {}
    for kind in (FitnessInput, Param):
        for item in owner.items:
            if isinstance(item, kind):
                own.setdefault(str(item.name), item)
    values.link_only([e for e in nodes_of(owner, Expression) if e not in guards], owner, own)


def _link_in_space(
    measure: SpaceMeasure, owner: Fitness, scope: FileScope, report: Diagnostics
) -> None:
    """Resolve the role, or the kind of target, of a measure of space."""
    if measure.role is not None and owner.about is not None:
        roles = roles_of(owner.about)
        measure.role.target = roles.get(measure.role.name)
        if measure.role.target is None:
            kind = f"role in swarm `{owner.about.name}`"
            name, at = measure.role.name, measure.role.span
            report_missing_inside(kind, name, at, roles, scope, report)
    if measure.target is not None:
        known = targets_of(scope.project)
        measure.target.target = known.get(measure.target.name)
        if measure.target.target is None and known:
            name, at = measure.target.name, measure.target.span
            report_missing_inside("target", name, at, known, scope, report)


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


def _link_facts(
    sentence: Sentence,
    owner: Property | Fitness,
    scope: FileScope,
    values: ValueLinker,
    report: Diagnostics,
) -> set[Expression]:
    """Resolve roles, states and values in facts; return the expressions in them."""
    facts = facts_in(sentence)
    if isinstance(sentence.about, Swarm):
        roles = roles_of(sentence.about)
        refs = [sentence.each.role] if sentence.each is not None else []
        refs += [node.role for node in robots_in(sentence)]
        refs += [fact.counted for fact in facts if fact.counted is not None]
        for ref in refs:
            ref.target = roles.get(ref.name)
            if ref.target is None:
                kind = f"role in swarm `{sentence.about.name}`"
                hint = partial(_hint_for_role, ref.name)
                report_missing_inside(kind, ref.name, ref.span, roles, scope, report, hint)
    guards = set()
    for fact in facts:
        machines = machines_of_fact(fact, sentence)
        if fact.state is not None and machines:
            _link_state(fact.state, machines, scope, report)
        if fact.guard is not None:
            guards.add(fact.guard)
            if is_from_outside(fact) and isinstance(sentence.about, Swarm):
                roles = roles_of(sentence.about)
                machines = [each for role in roles.values() for each in _machines_of_role(role)]
            values.link_only([fact.guard], owner, values_of_fact(fact, sentence), machines)
    return guards


def link_safe_states(
    contract: Contract, member: Member, scope: FileScope, report: Diagnostics
) -> None:
    """Resolve the states that a contract of a member leads to."""
    machines = machines_of_member(member)
    for each in contract.states if machines else ():
        _link_state(each.state, machines, scope, report)


def is_from_outside(fact: Fact) -> bool:
    """Return True for the fact that an event arrives from outside, which is about no robot."""
    return fact.event is not None and not fact.act


def _hint_for_role(name: str) -> str | None:
    from swarmdsl.syntax.errors.property_hints import word_hint

    return word_hint(name)


def _subject(owner: Property, scope: FileScope, report: Diagnostics) -> PropertySubject | None:
    ref = owner.subject
    if ref is None:
        found = subjects_of(owner, scope.project)
        return found[0] if len(found) == 1 else None
    ref.target = resolve_or_report(scope, ref.name, ref.span, _SUBJECTS, report)
    return ref.target


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
    return _machines_of_role(role_of_fact(fact, owner))


def _machines_of_role(role: Role | None) -> list[StateMachine]:
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


# ---- states


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


def _link_state(
    ref: Ref[Vertex], machines: Sequence[StateMachine], scope: FileScope, report: Diagnostics
) -> None:
    found = find_states(machines, ref.name)
    if not found:
        last = ref.name.rpartition(".")[2]
        paths = [path for machine in machines for path, _ in state_paths(machine)]
        names = dict.fromkeys(".".join(path) for path in paths)
        if last not in scope.skipped_names:
            kind = f"state of {listed([str(machine.name) for machine in machines])}"
            near = [*dict.fromkeys(path[-1] for path in paths), *names]
            report_missing_inside(kind, ref.name, ref.span, near, scope, report)
    elif len(found) > 1:
        report.report(
            "ambiguous-name",
            ref.span,
            name=ref.name,
            related=tuple(Label(state.name.span, "declared here") for _, state in found.values()),
            help=write(*(".".join(path) for path in found)),
        )
    else:
        ((_, ref.target),) = found.values()
