"""Lower fitness and optimizations."""

from __future__ import annotations

from swarmdsl import ir
from swarmdsl.lowering.context import Context
from swarmdsl.lowering.docs import lower_docs
from swarmdsl.lowering.expressions import lower_expression, lower_optional
from swarmdsl.lowering.interfaces import lower_params
from swarmdsl.lowering.properties import lower_measure
from swarmdsl.syntax.ast import (
    CountRange,
    Fitness,
    FitnessInput,
    Objective,
    Optimization,
    ParamRange,
    Setting,
    SpaceMeasure,
    SubjectTo,
)


def lower_fitness(fitness: Fitness, context: Context) -> ir.Fitness:
    """Lower a fitness with its inputs and params."""
    objective = next(item for item in fitness.items if isinstance(item, Objective))
    return ir.Fitness(
        name=context.names[fitness],
        inputs=tuple(
            ir.FitnessInput(
                str(item.name),
                context.type_of(item.type),
                lower_measure(item.measure, context) if item.measure is not None else None,
                item.doc,
                item.name.span,
                _space(item.space),
            )
            for item in fitness.items
            if isinstance(item, FitnessInput)
        ),
        params=lower_params(fitness.items, context),
        goal=objective.goal,
        value=lower_expression(objective.value, context),
        doc=fitness.doc,
        docs=lower_docs(fitness.items),
        origin=fitness.name.span,
        subject=context.names[fitness.about] if fitness.about is not None else None,
    )


def _space(measure: SpaceMeasure | None) -> ir.SpaceMeasure | None:
    if measure is None:
        return None
    of = measure.target if measure.role is None else measure.role
    assert of is not None
    return ir.SpaceMeasure(measure.quantity, of.name)


def lower_optimization(optimization: Optimization, context: Context) -> ir.Optimization:
    """Lower an optimization with its search space."""
    return ir.Optimization(
        swarm=context.name(optimization.swarm),
        params=tuple(
            ir.ParamRange(
                item.role.name,
                item.param.name,
                lower_expression(item.lower, context, _type_of(item)),
                lower_expression(item.upper, context, _type_of(item)),
                lower_optional(item.step, context, _type_of(item)),
                item.doc,
                item.span,
            )
            for item in optimization.items
            if isinstance(item, ParamRange)
        ),
        counts=tuple(
            ir.CountRange(
                item.role.name,
                lower_expression(item.lower, context),
                lower_expression(item.upper, context),
                item.doc,
                item.span,
            )
            for item in optimization.items
            if isinstance(item, CountRange)
        ),
        settings=tuple(
            (item.name, lower_expression(item.value, context))
            for item in optimization.items
            if isinstance(item, Setting)
        ),
        doc=optimization.doc,
        docs=lower_docs(optimization.items),
        origin=optimization.swarm.span,
        constraints=tuple(
            ir.Constraint(context.name(item.property), item.doc, item.span)
            for item in optimization.items
            if isinstance(item, SubjectTo)
        ),
    )


def _type_of(item: ParamRange) -> ir.Type | None:
    """Return the type of the param of a range."""
    return item.param.target.type.type if item.param.target is not None else None
