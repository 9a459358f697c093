"""Swarms, environments, fitness and optimizations as text."""

from __future__ import annotations

from decimal import Decimal

from swarmdsl.ir import Environment, Fitness, Multiplicity, Optimization, Swarm
from swarmdsl.printer.expressions import expression
from swarmdsl.printer.interfaces import print_params
from swarmdsl.printer.layout import block, documented, quoted
from swarmdsl.printer.names import Names

_ONE = Multiplicity(1, 1)


def print_swarm(swarm: Swarm) -> list[str]:
    """A swarm with its roles."""
    roles = [
        line
        for role in swarm.roles
        for line in documented(
            role.doc,
            [
                f"{role.name} : {role.member}"
                + ("" if role.multiplicity == _ONE else f"[{role.multiplicity}]")
            ],
        )
    ]
    uses = {"environment": swarm.environment, "fitness": swarm.fitness}
    used = [f"{what} {name}" for what, name in uses.items() if name is not None]
    return documented(swarm.doc, block(f"swarm {swarm.name}", [*roles, *used]))


def print_environment(environment: Environment) -> list[str]:
    """An environment, lengths in metres."""
    lines = []
    if environment.world is not None:
        lines.append(f"world {quoted(environment.world)}")
    if environment.size is not None:
        lines.append("size " + " x ".join(map(_metres, environment.size)))
    return documented(environment.doc, block(f"environment {environment.name}", lines))


def print_fitness(fitness: Fitness, names: Names) -> list[str]:
    """A fitness with its inputs and params."""
    inputs = [
        line
        for each in fitness.inputs
        for line in documented(each.doc, [f"in {each.name} : {names.type(each.type)}"])
    ]
    goal = f"{fitness.goal} {expression(fitness.value)}"
    lines = [*inputs, *print_params(fitness.params, names), goal]
    return documented(fitness.doc, block(f"fitness {fitness.name}", lines))


def print_optimization(optimization: Optimization) -> list[str]:
    """What an optimiser may vary."""
    settings = [f"{name} {expression(value)}" for name, value in optimization.settings]
    counts = [
        f"count of {each.role} in {expression(each.lower)} .. {expression(each.upper)}"
        for each in optimization.counts
    ]
    params = [
        f"{each.role}.{each.param} in {expression(each.lower)} .. {expression(each.upper)}"
        + (f" step {expression(each.step)}" if each.step is not None else "")
        for each in optimization.params
    ]
    head = f"optimize {optimization.swarm}"
    return documented(optimization.doc, block(head, [*settings, *counts, *params]))


def _metres(length: float) -> str:
    """A length as a decimal number: without exponent, and without `.0`."""
    text = f"{Decimal(repr(length)):f}"
    return f"{text.removesuffix('.0')} m"
