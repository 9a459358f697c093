"""Checks of fitness, optimizations and constants."""

from __future__ import annotations

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.types import is_number
from swarmdsl.base.diagnostics.advice import Advice, edits
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.base.source import Span
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    Constant,
    CountRange,
    Expression,
    Fitness,
    FitnessUse,
    MessageType,
    Objective,
    Optimization,
    Param,
    ParamRange,
    Setting,
    SubjectTo,
    Swarm,
)
from swarmdsl.syntax.types import INT, Type


def check_fitness(fitness: Fitness, context: Context) -> None:
    """Check that a fitness has one objective, which is a number."""
    objectives = [item for item in fitness.items if isinstance(item, Objective)]
    if not objectives:
        context.report.report(
            "missing-objective",
            fitness.name.span,
            name=fitness.name,
            help="add `maximize ...` or `minimize ...`",
        )
    context.check_single([item.span for item in objectives], "the objective")
    for item in fitness.items:
        match item:
            case Param():
                context.check_default(item, item.default)
            case Objective():
                context.check_number(item.value)


def check_optimizations(project: Project, context: Context) -> None:
    """Check that each swarm has at most one optimization."""
    places: dict[Swarm, list[Span]] = {}
    for _, optimization in project.optimizations():
        if optimization.swarm.target is not None:
            places.setdefault(optimization.swarm.target, []).append(optimization.swarm.span)
    for swarm, found in places.items():
        context.check_single(found, f"the optimization of swarm `{swarm.name}`")


def check_optimization(optimization: Optimization, context: Context) -> None:
    """Check the fitness, the settings and the ranges of an optimization."""
    _check_worth(optimization, context)
    _check_settings(optimization, context)
    _check_ranges(optimization, context)
    _check_constraints(optimization, context)


def _check_worth(optimization: Optimization, context: Context) -> None:
    swarm = optimization.swarm.target
    if swarm is None or not context.incomplete.isdisjoint({swarm, optimization}):
        return
    at = optimization.swarm.span
    if not any(isinstance(item, FitnessUse) for item in swarm.items):
        context.report.report(
            "missing-fitness",
            at,
            name=swarm.name,
            related=(Label(swarm.name.span, "declared here"),),
            help=Advice(
                f"add `fitness Name` to swarm `{swarm.name}`: it says which runs are better",
                "add fitness",
                swarm.name,
            ),
        )
    if not any(isinstance(item, (ParamRange, CountRange)) for item in optimization.items):
        context.report.report(
            "empty-optimization",
            at,
            name=swarm.name,
            help=Advice(
                "add `role.param in 1.0 .. 5.0` or `count of role in 1 .. 5`",
                "vary",
                str(swarm.name),
            ),
        )


def _check_settings(optimization: Optimization, context: Context) -> None:
    settings = [item for item in optimization.items if isinstance(item, Setting)]
    for name in ("steps", "evaluations", "seed"):
        places = [item.span for item in settings if item.name == name]
        context.check_single(places, f"setting `{name}`")
    for setting in settings:
        context.check_constant(setting.value, INT)
        value, least = _number(setting.value, context), 0 if setting.name == "seed" else 1
        if value is not None and value < least:
            context.report.report(
                "impossible-setting", setting.value.span, name=setting.name, least=least
            )


def _check_constraints(optimization: Optimization, context: Context) -> None:
    """Check that one run of the swarm can violate the properties that candidates must keep."""
    places: dict[str, list[Span]] = {}
    for item in optimization.items:
        found = item.property.target if isinstance(item, SubjectTo) else None
        if not isinstance(item, SubjectTo) or found is None:
            continue
        places.setdefault(f"constraint `{found.name}`", []).append(item.property.span)
        swarm, help_ = optimization.swarm.target, None
        if found.about is not None and swarm is not None and found.about is not swarm:
            fault = f"is about `{found.about.name}`, not about `{swarm.name}`"
        elif found.chance is not None:
            fault = "has a chance, which is about many runs"
            help_ = "name a property without `at least` or `at most` and a probability"
        else:
            continue
        context.report.report(
            "unfit-constraint",
            item.property.span,
            name=found.name,
            fault=fault,
            related=(Label(found.name.span, "declared here"),),
            help=help_,
        )
    for what, spans in places.items():
        context.check_single(spans, what)


def _check_ranges(optimization: Optimization, context: Context) -> None:
    varied: dict[str, list[ParamRange | CountRange]] = {}
    for item in optimization.items:
        match item:
            case ParamRange():
                varied.setdefault(f"the range of `{item.role.name}.{item.param.name}`", []).append(
                    item
                )
                param = item.param.target
                type_ = param.type.type if param is not None else None
                _check_range(item.lower, item.upper, item.step, type_, context)
                _check_default_inside(item, context)
            case CountRange():
                varied.setdefault(f"the count of `{item.role.name}`", []).append(item)
                _check_range(item.lower, item.upper, None, INT, context)
    for what, items in varied.items():
        context.check_single([item.span for item in items], what)


def check_constant(declared: Constant, context: Context) -> None:
    """Check that the value of a constant is constant and of its type."""
    context.check_constant(declared.value, declared.type.type)


def check_message_constants(message: MessageType, context: Context) -> None:
    """Check the constants of a message."""
    for constant in message.constants:
        check_constant(constant, context)


def _check_default_inside(item: ParamRange, context: Context) -> None:
    """Check that the value of a param in the model is in its range."""
    param, role = item.param.target, item.role.target
    if param is None or role is None:
        return
    value = next((v.value for v in role.values if v.name == param.name), param.default)
    if value is None:
        return
    low, high = _number(item.lower, context), _number(item.upper, context)
    default = _number(value, context)
    if default is None or low is None or high is None or low > high or low <= default <= high:
        return
    end = item.lower if default < low else item.upper
    bounds = [value if each is end else each for each in (item.lower, item.upper)]
    range_ = " .. ".join(each.span.text for each in bounds)
    context.report.report(
        "default-outside",
        Span(item.span.source, item.lower.span.start, item.upper.span.end),
        name=f"{item.role.name}.{item.param.name}",
        related=(Label(value.span, "this is the default"),),
        help=edits(
            f"let the range include {value.span.text}, or change the default",
            f"Change to `{range_}`",
            (end.span, value.span.text),
        ),
    )


def _check_range(
    lower: Expression,
    upper: Expression,
    step: Expression | None,
    type_: Type | None,
    context: Context,
) -> None:
    if type_ is not None and not is_number(type_) and str(type_) != "duration":
        context.report.report(
            "empty-range",
            lower.span,
            fault=f"has values of type `{type_}`",
            help="a range has numbers or durations",
        )
        return
    for value in (lower, upper, step):
        if value is not None:
            context.check_constant(value, type_)
    low, high = _number(lower, context), _number(upper, context)
    if low is not None and high is not None and low > high:
        context.report.report("empty-range", upper.span, fault="ends below its start")
    width = _number(step, context) if step is not None else None
    if step is not None and width is not None and width <= 0:
        context.report.report("empty-range", step.span, fault="has a step that is not positive")
    elif step is not None and _is_wider(width, low, high):
        context.report.report("empty-range", step.span, fault="is narrower than its step")


def _is_wider(step: float | None, low: float | None, high: float | None) -> bool:
    if step is None or low is None or high is None:
        return False
    return step > high - low >= 0


def _number(expression: Expression, context: Context) -> float | None:
    tree = expression.tree
    value = context.typing.folding.value(tree) if tree is not None else None
    return value if isinstance(value, (int, float)) else None
