"""Checks of a model whose names are resolved: the list of all passes.

Passes that look for missing items skip declarations with a part that could not be parsed,
since the missing item may be in that part.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from swarmdsl.analysis.checks.activities import check_activities
from swarmdsl.analysis.checks.addresses import check_addresses
from swarmdsl.analysis.checks.architecture import check_component, check_inheritance, check_member
from swarmdsl.analysis.checks.composition import check_environment, check_swarm
from swarmdsl.analysis.checks.conflicts import check_conflicts
from swarmdsl.analysis.checks.context import Context, make_context
from swarmdsl.analysis.checks.contracts import check_contracts
from swarmdsl.analysis.checks.dataflow import check_variables
from swarmdsl.analysis.checks.delays import check_undelayed_sends
from swarmdsl.analysis.checks.delivery import check_delivery, check_lossy_events, check_operator
from swarmdsl.analysis.checks.enums import check_enum
from swarmdsl.analysis.checks.equipment import check_equipment, check_sights
from swarmdsl.analysis.checks.events import check_events
from swarmdsl.analysis.checks.expressions import check_expressions
from swarmdsl.analysis.checks.function_models import check_model, check_model_names
from swarmdsl.analysis.checks.geometry import check_geometry
from swarmdsl.analysis.checks.guards import check_guards
from swarmdsl.analysis.checks.identities import check_identities
from swarmdsl.analysis.checks.ignored_events import check_ignored_events
from swarmdsl.analysis.checks.initialization import check_initialization
from swarmdsl.analysis.checks.interfaces import (
    check_event,
    check_function,
    check_known,
    check_message_cycles,
    check_standard,
    check_topics,
    check_values,
)
from swarmdsl.analysis.checks.livelock import check_livelock
from swarmdsl.analysis.checks.measures import check_measured_swarm, check_measures
from swarmdsl.analysis.checks.membership import check_heartbeat, check_membership
from swarmdsl.analysis.checks.monitor_names import check_monitor_names
from swarmdsl.analysis.checks.names import check_names, check_names_inside
from swarmdsl.analysis.checks.optimization import (
    check_constant,
    check_fitness,
    check_message_constants,
    check_optimization,
    check_optimizations,
)
from swarmdsl.analysis.checks.properties import check_property, check_subjects
from swarmdsl.analysis.checks.putting_off import check_putting_off
from swarmdsl.analysis.checks.reachability import check_reachability
from swarmdsl.analysis.checks.robot_values import check_robot_values
from swarmdsl.analysis.checks.shadowed_transitions import check_shadowed_transitions
from swarmdsl.analysis.checks.starts import check_starts
from swarmdsl.analysis.checks.structure import check_structure
from swarmdsl.analysis.checks.style import check_style
from swarmdsl.analysis.checks.submachines import check_submachines
from swarmdsl.analysis.checks.transitions import check_transitions
from swarmdsl.analysis.checks.unused import check_unused, collect_used
from swarmdsl.base.diagnostics.collector import Diagnostics, Severity
from swarmdsl.base.records import replace
from swarmdsl.project.libraries import SUFFIX
from swarmdsl.project.loader import File, Project
from swarmdsl.syntax.ast import (
    ActionType,
    Component,
    Constant,
    Declaration,
    EnumType,
    Environment,
    Event,
    Fitness,
    Function,
    Member,
    MessageType,
    Property,
    ServiceType,
    StateMachine,
    Swarm,
)

PROJECT_PASSES: Sequence[Callable[[Project, Context], None]] = (
    check_names,
    check_submachines,
    check_inheritance,
    check_message_cycles,
    check_optimizations,
    check_unused,
    collect_used,
    check_topics,
    check_monitor_names,
    check_events,
    check_ignored_events,
    check_addresses,
    check_identities,
    check_membership,
    check_subjects,
    check_model_names,
)
"""Passes over a whole project, in order."""

STATE_MACHINE_PASSES: Sequence[Callable[[StateMachine, Context], None]] = (
    check_expressions,  # first: computes the conditions of the guards
    check_structure,
    check_transitions,
    check_livelock,
    check_shadowed_transitions,
    check_reachability,
    check_activities,
    check_putting_off,
    check_undelayed_sends,
    check_guards,
    check_variables,
    check_conflicts,
    check_initialization,
    check_lossy_events,
)

NO_EVENT_PASSES = frozenset(
    (
        check_structure,
        check_livelock,
        check_activities,
        check_undelayed_sends,
        check_variables,
        check_initialization,
    )
)
"""Those of them that find the same, whatever the events are that a machine names."""

COMMON_PASSES: Sequence[Callable[[Declaration, Context], None]] = (
    check_values,
    check_known,
    check_style,
)
"""Passes over every declaration, before those of its kind."""

PASSES: Mapping[type[Declaration], Sequence[Callable[[Any, Context], None]]] = {
    Event: (check_event, check_delivery, check_operator),
    Function: (check_function, check_model),
    Component: (check_component, check_sights),
    Member: (check_member, check_equipment, check_contracts),
    StateMachine: STATE_MACHINE_PASSES,
    Constant: (check_constant,),
    EnumType: (check_enum,),
    MessageType: (check_standard, check_message_constants),
    ServiceType: (check_standard,),
    ActionType: (check_standard,),
    Fitness: (check_fitness, check_measures),
    Swarm: (check_swarm, check_heartbeat, check_robot_values, check_starts, check_measured_swarm),
    Environment: (check_environment, check_geometry),
    Property: (check_property,),
}
"""Passes over declarations, by kind, in order."""


def validate(project: Project, report: Diagnostics) -> None:
    """Run all passes."""
    context = make_context(project, report)
    check_project(project, context)
    for file, declaration in project.declarations():
        check_declaration(file, declaration, context)
    for _, optimization in project.optimizations():
        check_optimization(optimization, context)


def check_project(project: Project, context: Context) -> None:
    """Run the passes over a whole project, which precede those over declarations."""
    for run in PROJECT_PASSES:
        run(project, context)


def check_declaration(file: File, declaration: Declaration, context: Context) -> None:
    """Run the passes over one declaration."""
    check_with_events(file, declaration, context)
    check_without_events(file, declaration, context)


def check_with_events(file: File, declaration: Declaration, context: Context) -> None:
    """Run the passes over one declaration that may look at the events which it names."""
    if declaration in file.parsed.incomplete:
        return
    if file.library:
        _check_in_library(file, declaration, context)
    elif isinstance(declaration, StateMachine):
        for run in STATE_MACHINE_PASSES:
            if run not in NO_EVENT_PASSES:
                run(declaration, context)
    else:
        _run(declaration, context)


def check_without_events(file: File, declaration: Declaration, context: Context) -> None:
    """Run the other passes, after those: a state machine has guards whose conditions they need."""
    check_names_inside(declaration, context.report, file.parsed.skipped_names)
    if isinstance(declaration, StateMachine) and not (
        file.library or declaration in file.parsed.incomplete
    ):
        for run in (*COMMON_PASSES, *NO_EVENT_PASSES):
            run(declaration, context)


def _check_in_library(file: File, declaration: Declaration, context: Context) -> None:
    """Run the passes over a declaration of a library; users cannot fix its warnings."""
    found = Diagnostics()
    _run(declaration, replace(context.reporting_to(found), errors_only=True))
    # Files of `import ros` usually belong to the authors of the model.
    if not file.source.name.endswith(SUFFIX):
        check_known(declaration, context)
    context.report.include(one for one in found if one.severity is Severity.ERROR)


def _run(declaration: Declaration, context: Context) -> None:
    for run in COMMON_PASSES:
        run(declaration, context)
    for run in PASSES.get(type(declaration), ()):
        run(declaration, context)


__all__ = [
    "check_declaration",
    "check_optimization",
    "check_project",
    "check_with_events",
    "check_without_events",
    "make_context",
    "validate",
]
