"""Checks of the models that functions have in space."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.resolve.report_unresolved import report_missing
from swarmdsl.analysis.resolve.space import areas_of, target_counts
from swarmdsl.analysis.space_shapes import number_of
from swarmdsl.analysis.types.space_types import argument_type
from swarmdsl.base.suggest import suggest
from swarmdsl.ir.function_models import ANY_TARGET, MODELS, Argument
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import Environment, Expression, Function, ModelUse, nodes_of
from swarmdsl.syntax.types import Named

_SECOND = 1_000_000_000


def check_model(function: Function, context: Context) -> None:
    """Check that a function has one model, and that the model exists and has the arguments."""
    uses = nodes_of(function, ModelUse)
    context.check_single([use.span for use in uses], "the model")
    for use in uses:
        context.check_repeated((argument.name for argument in use.arguments), "argument")
        model = MODELS.get(str(use.name))
        if str(use.name) in context.models:
            continue  # its arguments are known when a run loads it
        if model is None:
            context.report.report(
                "unknown-model",
                use.name.span,
                name=use.name,
                help=suggest(use.name, [*MODELS, *sorted(context.models)], "models"),
            )
            continue
        for given in use.arguments:
            argument = model.argument(str(given.name))
            if argument is not None:
                _check_value(given.value, argument, context)
                continue
            names = [each.name for each in model.arguments]
            context.report.report(
                "unknown-argument",
                given.name.span,
                model=model.name,
                name=given.name,
                help=suggest(given.name, names, "arguments") if names else "it has none",
            )


def _check_value(value: Expression, argument: Argument, context: Context) -> None:
    expected = argument_type(argument.kind)
    if expected is not None:
        reported = len(context.report)
        context.expect(value, expected, context.typing)
        if len(context.report) > reported:
            return
        number = number_of(value, context.typing.folding)
        scale = 1 / _SECOND if argument.kind == "time" else 1
        limits = argument.limits(number * scale) if number is not None else None
        if limits is not None:
            name = argument.name
            context.report.report("setting-range", value.span, name=name, expected=limits)
        return
    found = context.typing.infer(value.tree) if value.tree is not None else None
    if found is not None and not isinstance(found, Named):
        context.report.report(
            "type-mismatch",
            value.span,
            expected="a message with a position",
            found=f"`{found}`",
        )


def check_model_names(project: Project, context: Context) -> None:
    """Check the names of areas and targets that are given to models as strings.

    A model without areas or targets is a part of others: they have the environment.
    """
    areas = {
        name
        for _, node in project.declarations()
        if isinstance(node, Environment)
        for name in areas_of(node)
    }
    known: dict[str, Collection[str]] = {"area": areas, "target": target_counts(project)}
    for _, node in project.declarations():
        for use in nodes_of(node, ModelUse) if isinstance(node, Function) else ():
            model = MODELS.get(str(use.name))
            for given in use.arguments if model is not None else ():
                argument = model.argument(str(given.name)) if model is not None else None
                if argument is not None and argument.kind in known:
                    _check_name(given.value, argument.kind, known[argument.kind], context)


def _check_name(value: Expression, kind: str, known: Collection[str], context: Context) -> None:
    name = context.typing.folding.value(value.tree) if value.tree is not None else None
    if not known or not isinstance(name, str) or not name or name in known:
        return
    one = re.fullmatch(r"(\w+)\[([0-9]{1,9})\]", name)
    if kind == "target" and name == ANY_TARGET:
        return
    if one is not None and isinstance(known, Counter) and int(one[2]) < known[one[1]]:
        return  # one target of a kind: `person[0]`
    report_missing(kind, name, value.span, known, context.report)
