"""Fitness and what may be changed to better it; constants."""

from __future__ import annotations

from swarmdsl.inference import is_number
from swarmdsl.ir.types import INT, Type
from swarmdsl.syntax import (
    Constant,
    CountRange,
    Expression,
    Fitness,
    Objective,
    Optimization,
    Param,
    ParamRange,
    Setting,
)
from swarmdsl.validate.context import Context


def check_fitness(fitness: Fitness, context: Context) -> None:
    """A fitness is one number to make as great or as small as possible."""
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


def check_optimization(optimization: Optimization, context: Context) -> None:
    """The ranges hold values, and each thing is varied once."""
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
            case CountRange():
                varied.setdefault(f"the count of `{item.role.name}`", []).append(item)
                _check_range(item.lower, item.upper, None, INT, context)
    for what, items in varied.items():
        context.check_single([item.span for item in items], what)


def check_constant(declared: Constant, context: Context) -> None:
    """The value of a constant is known and of its type."""
    context.check_constant(declared.value, declared.type.type)


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
            fault=f"is of values of type `{type_}`",
            help="a range is one of numbers or durations",
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
