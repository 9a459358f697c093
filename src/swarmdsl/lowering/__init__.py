"""Lower syntax trees to the intermediate representation.

The model must be free of errors: nothing is reported here, and a failed assertion is a bug in
swarmdsl.
"""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl import ir
from swarmdsl.analysis.resolve.membership import used_member_events
from swarmdsl.analysis.usage import used_declarations
from swarmdsl.base.records import replace
from swarmdsl.lowering.architecture import (
    lower_component,
    lower_environment,
    lower_member,
    lower_swarm,
)
from swarmdsl.lowering.context import make_context, operation_owners
from swarmdsl.lowering.interfaces import (
    lower_event,
    lower_function,
    lower_interface,
    lower_operations,
    lower_services,
)
from swarmdsl.lowering.machines import lower_machine, names_of_variables
from swarmdsl.lowering.optimization import lower_fitness, lower_optimization
from swarmdsl.lowering.properties import lower_property
from swarmdsl.lowering.standard_interfaces import with_standard_interfaces
from swarmdsl.project.loader import File, Project
from swarmdsl.syntax.ast import (
    ActionType,
    Component,
    Declaration,
    EnumType,
    Environment,
    Event,
    Fitness,
    Function,
    Member,
    MessageType,
    Part,
    Property,
    ServiceType,
    StateMachine,
    StructType,
    Swarm,
    Variable,
)


def lower(
    project: Project,
    name: str | None = None,
    declarations: list[tuple[File, Declaration]] | None = None,
) -> ir.System:
    """Return the project as one system, in the order of files and text.

    Its name is the first package unless one is given. Of libraries it contains what the project
    uses, or the given `declarations` with all that they use.
    """
    used = used_declarations(project) if declarations is None else declarations
    used = [*used, *used_member_events(node for _, node in used)]
    context = make_context(project, used)
    interfaces: list[ir.Interface] = []
    events: list[ir.Event] = []
    functions: list[ir.Function] = []
    components: list[ir.Component] = []
    members: list[ir.Member] = []
    machines: list[ir.StateMachine] = []
    environments: list[ir.Environment] = []
    swarms: list[ir.Swarm] = []
    variables: dict[Variable, str] = {}
    for file, declaration in used:
        match declaration:
            case StructType() | EnumType() | MessageType() | ServiceType() | ActionType():
                interfaces.append(lower_interface(declaration, file, context))
            case Event():
                events.append(lower_event(declaration, context))
            case Function():
                functions.append(lower_function(declaration, context))
            case Component():
                components.append(lower_component(declaration, context))
                interfaces += lower_services(declaration, context)
                functions += lower_operations(declaration, context)
            case Member():
                members.append(lower_member(declaration, context))
            case StateMachine():
                machines.append(lower_machine(declaration, context))
                variables |= names_of_variables(declaration, machines[-1])
            case Environment():
                environments.append(lower_environment(declaration, context))
            case Swarm():
                swarms.append(lower_swarm(declaration, context))
    judging = context.reusing(variables, {})
    fitness = [lower_fitness(node, judging) for _, node in used if isinstance(node, Fitness)]
    properties = [lower_property(node, judging) for _, node in used if isinstance(node, Property)]
    parts = (owner for owner in operation_owners(used) if isinstance(owner, Part))
    functions += (function for part in parts for function in lower_operations(part, context))
    first = project.files[0]
    system = ir.System(
        name=name or first.package,
        interfaces=tuple(interfaces),
        events=(*events, *context.monitored),
        # A part named like its component shares the component's servers.
        functions=_with_libraries({f.name: f for f in functions}.values(), project),
        components=tuple(components),
        members=tuple(members),
        machines=tuple(machines),
        environments=tuple(environments),
        swarms=tuple(swarms),
        fitness=tuple(fitness),
        optimizations=tuple(lower_optimization(o, context) for _, o in project.optimizations()),
        properties=tuple(properties),
        doc=first.model.package.doc if first.model.package else "",
        origin=first.model.package.span if first.model.package else None,
    )
    return with_standard_interfaces(system)


def _with_libraries(functions: Iterable[ir.Function], project: Project) -> tuple[ir.Function, ...]:
    """Return the functions, with those from libraries marked."""
    libraries = {file.source.name for file in project.files if file.library}
    return tuple(
        replace(function, in_library=True)
        if function.origin is not None and function.origin.source.name in libraries
        else function
        for function in functions
    )
