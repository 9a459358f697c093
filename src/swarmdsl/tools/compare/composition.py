"""Environments, swarms, fitness and optimizations as elements."""

from __future__ import annotations

from swarmdsl.codegen.swarm_printer.composition import heartbeat
from swarmdsl.codegen.swarm_printer.space import start
from swarmdsl.ir import (
    Environment,
    Expression,
    Fitness,
    FitnessInput,
    Optimization,
    RobotValues,
    Role,
    Swarm,
    System,
    sentences,
)
from swarmdsl.tools.compare.behaviour import param_elements
from swarmdsl.tools.compare.elements import (
    ROBOT_KIND,
    Element,
    Ref,
    Value,
    argument_values,
    expression_value,
    properties,
    reference,
    role_kind,
    type_value,
    with_doc,
)
from swarmdsl.tools.compare.sentences import sentence_value
from swarmdsl.tools.compare.space import space_elements


def environment_element(world: Environment) -> Element:
    """Return an environment with the space in it."""
    size = " x ".join(f"{length:g}" for length in world.size or ())
    values = properties(world=world.world, size=f"{size} m" if size else "")
    ref = Ref("environment", world.name)
    children = tuple(space_elements(world))
    element = Element("environment", (world.name,), values, children, ref, world.origin)
    return with_doc(element, world.doc, world.docs)


def fitness_element(fitness: Fitness, system: System) -> Element:
    """Return a fitness with its inputs and params."""
    values: tuple[tuple[str, Value], ...] = ((fitness.goal, expression_value(fitness.value)),)
    values += properties(about=reference(fitness.subject, "swarm"))
    inputs = (_input(each, fitness, system) for each in fitness.inputs)
    ref = Ref("fitness", fitness.name)
    children = (*inputs, *param_elements(fitness.params))
    element = Element("fitness", (fitness.name,), values, children, ref, fitness.origin)
    return with_doc(element, fitness.doc, fitness.docs)


def swarm_element(swarm: Swarm) -> Element:
    """Return a swarm with its roles and robots."""
    roles = (
        with_doc(
            Element(
                "role",
                (role.name,),
                properties(
                    member=reference(role.member, "member"),
                    number=str(role.multiplicity),
                    start=start(role.start).strip(),
                    values=argument_values(role.values),
                ),
                ref=Ref(role_kind(swarm.name), role.name),
                origin=role.origin,
            ),
            role.doc,
            role.docs,
        )
        for role in swarm.roles
    )
    values = properties(
        environment=reference(swarm.environment, "environment"),
        fitness=reference(swarm.fitness, "fitness"),
        heartbeat=heartbeat(swarm.heartbeat).removeprefix("heartbeat ") if swarm.heartbeat else "",
    )
    ref = Ref("swarm", swarm.name)
    robots = (_robot(swarm, role, robot) for role in swarm.roles for robot in role.robots)
    beat = swarm.heartbeat
    places = (("heartbeat", beat.origin),) if beat is not None else ()
    children = (*roles, *robots)
    element = Element("swarm", (swarm.name,), values, children, ref, swarm.origin, places)
    docs = swarm.docs if beat is None or not beat.doc else (*swarm.docs, ("heartbeat", beat.doc))
    return with_doc(element, swarm.doc, docs)


def _robot(swarm: Swarm, role: Role, robot: RobotValues) -> Element:
    name = (Ref(role_kind(swarm.name), role.name), f"[{robot.index}]")
    values = properties(start=start(robot.start).strip(), values=argument_values(robot.values))
    return with_doc(Element(ROBOT_KIND, name, values, origin=robot.origin), robot.doc, robot.docs)


def _input(each: FitnessInput, fitness: Fitness, system: System) -> Element:
    measured: Value = ()
    if each.measure is not None and fitness.subject is not None:
        parts = sentences.measure(each.measure)
        measured = sentence_value(parts, each.measure.each, fitness.subject, system)
    if each.space is not None:
        of = each.space.of
        role = fitness.subject is not None and each.space.quantity != "found"
        named = Ref(role_kind(fitness.subject or ""), of) if role else of
        measured = (f"{each.space.quantity}(", named, ")")
    values = properties(type=type_value(each.type), measure=measured)
    return with_doc(Element("input", (each.name,), values, origin=each.origin), each.doc)


def optimization_element(search: Optimization) -> Element:
    """Return an optimization with its ranges."""
    ranges = [
        with_doc(
            Element(
                "range",
                (f"{each.role}.{each.param}",),
                properties(values=_range(each.lower, each.upper), step=expression_value(each.step)),
                origin=each.origin,
            ),
            each.doc,
        )
        for each in search.params
    ]
    ranges += (
        with_doc(
            Element(
                "range",
                (f"number of {each.role}",),
                properties(values=_range(each.lower, each.upper)),
                origin=each.origin,
            ),
            each.doc,
        )
        for each in search.counts
    )
    ranges += (
        with_doc(
            Element("constraint", (Ref("property", each.property),), origin=each.origin), each.doc
        )
        for each in search.constraints
    )
    settings = tuple((name, expression_value(value)) for name, value in search.settings)
    element = Element(
        "optimization", (Ref("swarm", search.swarm),), settings, tuple(ranges), None, search.origin
    )
    return with_doc(element, search.doc, search.docs)


def _range(lower: Expression, upper: Expression) -> Value:
    return (*expression_value(lower), "..", *expression_value(upper))
