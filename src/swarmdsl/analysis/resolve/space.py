"""Resolve names of the space: areas, kinds of targets, and values that models of functions use."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping

from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.analysis.resolve.interfaces import Interfaces
from swarmdsl.analysis.resolve.report_unresolved import report_missing_inside
from swarmdsl.analysis.resolve.scopes import FileScope
from swarmdsl.analysis.resolve.values import ValueLinker
from swarmdsl.base.diagnostics.advice import Advice, insert
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.numerals import integer
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    ActionType,
    Area,
    Communication,
    Component,
    Environment,
    EnvironmentUse,
    Expression,
    Field,
    Function,
    ModelUse,
    Param,
    Ref,
    RobotValues,
    Role,
    ServiceType,
    Sight,
    Swarm,
    Targets,
    nodes_of,
)
from swarmdsl.syntax.types import Named


def areas_of(environment: Environment) -> dict[str, Area]:
    """Return the areas of an environment by name. The first of a repeated name counts."""
    found: dict[str, Area] = {}
    for item in environment.items:
        if isinstance(item, Area):
            found.setdefault(str(item.name), item)
    return found


def targets_of(project: Project) -> dict[str, Targets]:
    """Return the first targets of each kind, in any environment."""
    found: dict[str, Targets] = {}
    for _, owner in project.declarations():
        for item in owner.items if isinstance(owner, Environment) else ():
            if isinstance(item, Targets):
                found.setdefault(str(item.name), item)
    return found


def target_counts(project: Project) -> Counter[str]:
    """Return how many targets of each kind there are in the environment with most of them."""
    found: Counter[str] = Counter()
    for _, owner in project.declarations():
        here: Counter[str] = Counter()
        for item in owner.items if isinstance(owner, Environment) else ():
            if isinstance(item, Targets):
                here[str(item.name)] += integer(item.count or "0") or max(len(item.places), 1)
        found |= here
    return found


def link_environment(owner: Environment, scope: FileScope, report: Diagnostics) -> None:
    """Resolve the areas in which targets are."""
    areas = areas_of(owner)
    for item in owner.items:
        if isinstance(item, Targets) and item.area is not None:
            _link_area(item.area, owner, areas, scope, report)


def link_starts(swarm: Swarm, scope: FileScope, report: Diagnostics) -> None:
    """Resolve the areas in which robots start: those of the environment of the swarm."""
    use = next((item for item in swarm.items if isinstance(item, EnvironmentUse)), None)
    environment = use.environment.target if use is not None else None
    if use is not None and environment is None:
        return  # it is reported itself
    areas = areas_of(environment) if environment is not None else {}
    for item in swarm.items:
        if isinstance(item, (Role, RobotValues)) and item.start is not None:
            ref = item.start.area
            if ref is not None and environment is not None:
                _link_area(ref, environment, areas, scope, report)
            elif ref is not None:
                report_missing_inside(
                    "area",
                    ref.name,
                    ref.span,
                    (),
                    scope,
                    report,
                    hint=lambda: Advice(
                        f"swarm `{swarm.name}` has no environment: add one, `environment Name`",
                        "add environment",
                        swarm.name,
                    ),
                )


def _link_area(
    ref: Ref[Area],
    environment: Environment,
    areas: Mapping[str, Area],
    scope: FileScope,
    report: Diagnostics,
) -> None:
    ref.target = areas.get(ref.name)
    if ref.target is None:
        kind = f"area in environment `{environment.name}`"
        report_missing_inside(
            kind,
            ref.name,
            ref.span,
            areas,
            scope,
            report,
            hint=lambda: insert(
                f"area {ref.name} : (0 m, 0 m) .. (10 m, 10 m)", environment.name.span, to="it"
            ),
        )


def link_sights(
    owner: Component, scope: FileScope, values: ValueLinker, report: Diagnostics
) -> set[Expression]:
    """Resolve the targets that a component finds, and its params in the values.

    Return these values. A model without any targets is a part of others: they have the
    environment.
    """
    sights = [item for item in owner.items if isinstance(item, Sight)]
    if not sights:
        return set()
    given = [each.value for sight in sights for each in sight.values]
    values.link_only(given, owner, {str(each.name): each for each in all_items(owner, Param)})
    known = targets_of(scope.project)
    for sight in sights:
        ref = sight.target
        ref.target = known.get(ref.name)
        if ref.target is None and known:
            report_missing_inside("target", ref.name, ref.span, known, scope, report)
    return set(given)


def link_model(owner: Function, scope: FileScope, values: ValueLinker) -> set[Expression]:
    """Resolve the names in the arguments of the model of a function; return these arguments.

    They are its params, and the fields of its goal or request.
    """
    given = [argument.value for use in nodes_of(owner, ModelUse) for argument in use.arguments]
    if given:
        params = {str(each.name): each for each in nodes_of(owner, Param)}
        goal = {str(each.name): each for each in goal_fields(owner, scope.interfaces) or ()}
        values.link_only(given, owner, {**goal, **params})
    return set(given)


def goal_fields(owner: Function, interfaces: Interfaces) -> list[Field] | None:
    """Return the fields of the goal or request of a function; None if they are not known."""
    for item in owner.items:
        if not isinstance(item, Communication) or not isinstance(item.type.type, Named):
            continue
        kind = ActionType if item.paradigm == "action" else ServiceType
        match interfaces.get(item.type.type, kind):
            case ActionType(goal=goal):
                return goal
            case ServiceType(request=request):
                return request
    return None
