"""Print swarms, environments, fitness, optimizations and properties."""

from __future__ import annotations

from swarmdsl.codegen.shared.property_texts import measure_text, parts_text, sentence_text
from swarmdsl.codegen.swarm_printer.architecture import print_values
from swarmdsl.codegen.swarm_printer.expressions import duration, expression
from swarmdsl.codegen.swarm_printer.interfaces import print_params
from swarmdsl.codegen.swarm_printer.layout import block, documented, quoted
from swarmdsl.codegen.swarm_printer.names import Names
from swarmdsl.codegen.swarm_printer.space import metres, print_space, space_measure, start
from swarmdsl.ir import (
    CountRange,
    Environment,
    Fitness,
    FitnessInput,
    Heartbeat,
    Multiplicity,
    Optimization,
    ParamRange,
    Property,
    RobotValues,
    Role,
    Swarm,
    doc_of,
)
from swarmdsl.ir.sentences import head

_ONE = Multiplicity(1, 1)


def print_swarm(swarm: Swarm) -> list[str]:
    """Print a swarm with its roles."""
    roles = [line for role in swarm.roles for line in _role(role)]
    uses = {"environment": swarm.environment, "fitness": swarm.fitness}
    used = [
        line
        for what, name in uses.items()
        if name is not None
        for line in documented(doc_of(swarm.docs, what), [f"{what} {name}"])
    ]
    beat = swarm.heartbeat
    if beat is not None:
        used += documented(beat.doc, [heartbeat(beat)])
    return documented(swarm.doc, block(f"swarm {swarm.name}", [*roles, *used]))


def heartbeat(beat: Heartbeat) -> str:
    """Return the heartbeat as in the model: `heartbeat 1 s lost after 5 s`."""
    return f"heartbeat {duration(beat.period)} lost after {duration(beat.timeout)}"


def _role(role: Role) -> list[str]:
    """Print a role and the values of its robots."""
    number = "" if role.multiplicity == _ONE else f"[{role.multiplicity}]"
    lines = _configured(f"{role.name} : {role.member}{number}{start(role.start)}", role)
    for robot in role.robots:
        lines += _configured(f"{role.name}[{robot.index}]{start(robot.start)}", robot)
    return lines


def _configured(head: str, owner: Role | RobotValues) -> list[str]:
    values = print_values(owner.values, owner.docs)
    is_block = values or (isinstance(owner, RobotValues) and owner.start is None)
    return documented(owner.doc, block(head, values) if is_block else [head])


def print_environment(environment: Environment) -> list[str]:
    """Print an environment, lengths in metres."""
    lines = []
    if environment.world is not None:
        world = [f"world {quoted(environment.world)}"]
        lines += documented(doc_of(environment.docs, "world"), world)
    if environment.size is not None:
        size = ["size " + " x ".join(map(metres, environment.size))]
        lines += documented(doc_of(environment.docs, "size"), size)
    lines += print_space(environment)
    return documented(environment.doc, block(f"environment {environment.name}", lines))


def print_fitness(fitness: Fitness, names: Names) -> list[str]:
    """Print a fitness with its inputs and params."""
    inputs = [
        line for each in fitness.inputs for line in documented(each.doc, [_input(each, names)])
    ]
    goal = [f"{fitness.goal} {expression(fitness.value)}"]
    objective = documented(doc_of(fitness.docs, "value"), goal)
    lines = [*inputs, *print_params(fitness.params, names), *objective]
    head = f"fitness {fitness.name}"
    if fitness.subject is not None:
        head += f" of {fitness.subject}"
    return documented(fitness.doc, block(head, lines))


def _input(each: FitnessInput, names: Names) -> str:
    declared = f"in {each.name} : {names.type(each.type)}"
    if each.space is not None:
        return f"{declared} = {space_measure(each.space)}"
    if each.measure is None:
        return declared
    return f"{declared} = {measure_text(each.measure)}"


def print_optimization(optimization: Optimization) -> list[str]:
    """Print an optimization with its search space."""
    lines = []
    for name, value in optimization.settings:
        lines += documented(doc_of(optimization.docs, name), [f"{name} {expression(value)}"])
    for kept in optimization.constraints:
        lines += documented(kept.doc, [f"subject to {kept.property}"])
    for count in optimization.counts:
        lines += documented(count.doc, [f"count of {count.role} {_range(count)}"])
    for param in optimization.params:
        step = f" step {expression(param.step)}" if param.step is not None else ""
        lines += documented(param.doc, [f"{param.role}.{param.param} {_range(param)}{step}"])
    return documented(optimization.doc, block(f"optimize {optimization.swarm}", lines))


def print_property(property_: Property) -> list[str]:
    """Print a property as one sentence."""
    text = f"{parts_text(head(property_))} : {sentence_text(property_)}"
    return documented(property_.doc, [text])


def _range(values: CountRange | ParamRange) -> str:
    return f"in {expression(values.lower)} .. {expression(values.upper)}"
