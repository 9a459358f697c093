"""Resolve names in properties and measures: subject, roles, states, and values of robots."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TypeVar

from swarmdsl.analysis.resolve.report_unresolved import report_missing_inside, resolve_or_report
from swarmdsl.analysis.resolve.scopes import FileScope
from swarmdsl.analysis.resolve.sentences import (
    Sentence,
    facts_in,
    find_states,
    is_from_outside,
    machines_of_fact,
    machines_of_member,
    machines_of_role,
    measured_swarms,
    robots_in,
    roles_of,
    state_paths,
    subjects_of,
    values_of_fact,
)
from swarmdsl.analysis.resolve.space import targets_of
from swarmdsl.analysis.resolve.values import ValueLinker
from swarmdsl.base.diagnostics.advice import write
from swarmdsl.base.diagnostics.collector import Diagnostics, Label, listed
from swarmdsl.syntax.ast import (
    Contract,
    Expression,
    Fitness,
    FitnessInput,
    Measure,
    Member,
    Node,
    Param,
    Property,
    PropertySubject,
    Ref,
    SpaceMeasure,
    StateMachine,
    Swarm,
    Vertex,
    nodes_of,
)

N = TypeVar("N", bound=Node)

_SUBJECTS: tuple[type[Swarm | StateMachine], ...] = (Swarm, StateMachine)


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
                machines = [each for role in roles.values() for each in machines_of_role(role)]
            values.link_only([fact.guard], owner, values_of_fact(fact, sentence), machines)
    return guards


def link_safe_states(
    contract: Contract, member: Member, scope: FileScope, report: Diagnostics
) -> None:
    """Resolve the states that a contract of a member leads to."""
    machines = machines_of_member(member)
    for each in contract.states if machines else ():
        _link_state(each.state, machines, scope, report)


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
