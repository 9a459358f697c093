"""Every rule about a model whose names are resolved.

A declaration with a piece missing after a syntax error is passed over: what it seems to
lack may stand in the piece.
"""

from __future__ import annotations

from swarmdsl.diagnostics import Diagnostics, Severity
from swarmdsl.libraries import SUFFIX
from swarmdsl.load import Project
from swarmdsl.syntax import (
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
    StateMachine,
    Swarm,
)
from swarmdsl.used import used_declarations
from swarmdsl.validate.activities import check_activities
from swarmdsl.validate.architecture import check_component, check_inheritance, check_member
from swarmdsl.validate.composition import check_environment, check_swarm
from swarmdsl.validate.conflicts import check_conflicts
from swarmdsl.validate.context import Context, make_context
from swarmdsl.validate.dataflow import check_variables
from swarmdsl.validate.enums import check_enum
from swarmdsl.validate.events import check_events
from swarmdsl.validate.expressions import check_expressions
from swarmdsl.validate.guards import check_guards
from swarmdsl.validate.initialization import check_initialization
from swarmdsl.validate.interfaces import (
    check_event,
    check_function,
    check_known,
    check_message_cycles,
    check_topics,
    check_values,
)
from swarmdsl.validate.names import check_names
from swarmdsl.validate.optimization import (
    check_constant,
    check_fitness,
    check_optimization,
)
from swarmdsl.validate.order import check_order
from swarmdsl.validate.reachability import check_reachability
from swarmdsl.validate.settling import check_settling, circles_of
from swarmdsl.validate.structure import check_structure, check_submachines
from swarmdsl.validate.style import check_style
from swarmdsl.validate.transitions import check_transitions


def validate(project: Project, report: Diagnostics) -> None:
    """Run all rules."""
    context = make_context(project, report)
    check_names(project, report)
    check_submachines(project, report)
    check_inheritance(project, report)
    check_message_cycles(context)
    used = used_declarations(project)
    check_topics(used, report)
    in_libraries = Diagnostics()
    for file, declaration in project.declarations():
        if declaration not in file.parsed.damaged:
            found = in_libraries if file.library else report
            _check(declaration, context.reporting_to(found))
            # The files that `import ros` reads are mostly those of the same people.
            if file.library and not file.source.name.endswith(SUFFIX):
                check_known(declaration, context)
    # Whoever uses a library cannot mend what is only a warning there.
    report.include(found for found in in_libraries if found.severity is Severity.ERROR)
    check_events([node for _, node in used], context)
    check_initialization(project, context)
    for _, optimization in project.optimizations():
        check_optimization(optimization, context)


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
            check_structure(declaration, context)
            check_transitions(declaration, context)
            circles = circles_of(declaration, context)
            check_settling(declaration, circles, context)
            check_order(declaration, circles, context)
            check_reachability(declaration, context)
            check_activities(declaration, context)
            check_expressions(declaration, context)
            check_guards(declaration, circles, context)
            check_variables(declaration, context)
            check_conflicts(declaration, context)
        case Constant():
            check_constant(declaration, context)
        case MessageType():
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


__all__ = ["validate"]
