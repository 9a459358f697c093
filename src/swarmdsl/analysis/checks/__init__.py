"""Every rule about a model whose names are resolved.

A declaration with a piece missing after a syntax error is passed over: what it seems to
lack may stand in the piece.
"""

from __future__ import annotations

from swarmdsl.analysis.checks.activities import check_activities
from swarmdsl.analysis.checks.architecture import check_component, check_inheritance, check_member
from swarmdsl.analysis.checks.composition import check_environment, check_swarm
from swarmdsl.analysis.checks.conflicts import check_conflicts
from swarmdsl.analysis.checks.context import Context, make_context
from swarmdsl.analysis.checks.dataflow import check_variables
from swarmdsl.analysis.checks.enums import check_enum
from swarmdsl.analysis.checks.events import check_events
from swarmdsl.analysis.checks.expressions import check_expressions
from swarmdsl.analysis.checks.guards import check_guards
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
from swarmdsl.analysis.checks.livelock import Settling, check_settling
from swarmdsl.analysis.checks.names import check_names, check_names_inside
from swarmdsl.analysis.checks.optimization import (
    check_constant,
    check_fitness,
    check_optimization,
    check_optimizations,
)
from swarmdsl.analysis.checks.reachability import check_reachability
from swarmdsl.analysis.checks.shadowed_transitions import check_order
from swarmdsl.analysis.checks.structure import check_structure
from swarmdsl.analysis.checks.style import check_style
from swarmdsl.analysis.checks.submachines import check_submachines, reused_machines
from swarmdsl.analysis.checks.transitions import check_transitions
from swarmdsl.analysis.checks.unused import check_unused
from swarmdsl.analysis.usage import used_declarations
from swarmdsl.base.diagnostics.collector import Diagnostics, Severity
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
    ServiceType,
    StateMachine,
    Swarm,
)


def validate(project: Project, report: Diagnostics) -> None:
    """Run all rules."""
    context = make_context(project, report)
    check_together(project, context)
    reused = reused_machines(context)
    for file, declaration in project.declarations():
        check_alone(file, declaration, context, reused=declaration in reused)
    for _, optimization in project.optimizations():
        check_optimization(optimization, context)


def check_together(project: Project, context: Context) -> None:
    """Run the rules about all declarations together."""
    check_names(project, context.report)
    check_submachines(project, context)
    check_inheritance(project, context.report)
    check_message_cycles(context)
    check_optimizations(project, context)
    check_unused(project, context)
    used = used_declarations(project, context.known.uses)
    context.known.uses = context.known.uses.only(project)
    check_topics(used, context.report)
    check_events([node for _, node in used], context)


def check_alone(file: File, declaration: Declaration, context: Context, *, reused: bool) -> None:
    """Run the rules about one declaration and what it leads to.

    Of a machine it must be known whether another one reuses it.
    """
    check_names_inside(declaration, context.report, file.parsed.lost_names)
    if declaration in file.parsed.damaged:
        return
    if file.library:
        _check_in_library(file, declaration, context)
        return
    _check(declaration, context)
    if isinstance(declaration, StateMachine):
        check_initialization(declaration, context, reused=reused)


def _check_in_library(file: File, declaration: Declaration, context: Context) -> None:
    """Report errors only: whoever uses a library cannot mend what is a warning there."""
    found = Diagnostics()
    _check(declaration, context.reporting_to(found))
    # The files that `import ros` reads are mostly those of the same people.
    if not file.source.name.endswith(SUFFIX):
        check_known(declaration, context)
    context.report.include(one for one in found if one.severity is Severity.ERROR)


def _check(declaration: Declaration, context: Context) -> None:
    """Run the rules of a declaration."""
    check_values(declaration, context)
    check_known(declaration, context)
    check_style(declaration, context)
    match declaration:
        case Event():
            check_event(declaration, context)
        case Function():
            check_function(declaration, context)
        case Component():
            check_component(declaration, context)
        case Member():
            check_member(declaration, context)
        case StateMachine():
            # First of all: it makes conditions of the guards, which other rules compare.
            check_expressions(declaration, context)
            check_structure(declaration, context)
            check_transitions(declaration, context)
            settling = Settling(declaration, context)
            check_settling(declaration, settling, context)
            check_order(declaration, settling, context)
            check_reachability(declaration, context)
            check_activities(declaration, context)
            check_guards(declaration, settling, context)
            check_variables(declaration, context)
            check_conflicts(declaration, context)
        case Constant():
            check_constant(declaration, context)
        case ServiceType() | ActionType():
            check_standard(declaration, context)
        case MessageType():
            check_standard(declaration, context)
            for constant in declaration.constants:
                check_constant(constant, context)
        case EnumType():
            check_enum(declaration, context)
        case Fitness():
            check_fitness(declaration, context)
        case Swarm():
            check_swarm(declaration, context)
        case Environment():
            check_environment(declaration, context)


__all__ = [
    "check_alone",
    "check_optimization",
    "check_together",
    "make_context",
    "reused_machines",
    "validate",
]
