"""Checks of what robots and sensors are in space: body, battery, radio, and sight."""

from __future__ import annotations

from collections.abc import Iterable
from math import degrees, isinf, pi

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.analysis.resolve.linker import machines_of
from swarmdsl.analysis.space_shapes import number_of
from swarmdsl.analysis.types.space_types import setting_type
from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import suggest
from swarmdsl.ir.function_models import MODELS
from swarmdsl.ir.space_settings import SPACE_SETTINGS, SpaceSetting
from swarmdsl.syntax.ast import (
    Activity,
    Component,
    Equipment,
    Function,
    Member,
    ModelUse,
    PartValue,
    Sight,
    nodes_of,
)


def check_equipment(member: Member, context: Context) -> None:
    """Check the body, the battery and the radio of a member."""
    for kind in ("body", "battery", "radio"):
        own = [item for item in member.items if isinstance(item, Equipment) and item.kind == kind]
        context.check_single([item.span for item in own], f"the {kind}")
        for item in own:
            _check_settings(kind, item.values, f"this {kind}", item.span, context)
    _check_speed(member, context)


def check_sights(component: Component, context: Context) -> None:
    """Check how well a component finds targets."""
    sights = [item for item in component.items if isinstance(item, Sight)]
    for name in dict.fromkeys(sight.target.name for sight in sights):
        places = [sight.span for sight in sights if sight.target.name == name]
        context.check_single(places, f"the sight of `{name}`")
    for sight in sights:
        what = f"the sight of `{sight.target.name}`"
        _check_settings("senses", sight.values, what, sight.target.span, context)


def _check_settings(
    kind: str, values: Iterable[PartValue], owner: str, at: Span, context: Context
) -> None:
    known = SPACE_SETTINGS[kind]
    context.check_repeated((value.name for value in values), "setting")
    for value in values:
        setting = known.get(str(value.name))
        if setting is None:
            context.report.report(
                "unknown-setting",
                value.name.span,
                name=value.name,
                help=suggest(value.name, known, "settings"),
            )
            continue
        context.expect(value.value, setting_type(setting.unit), context.typing)
        _check_range(value, setting, context)
    given = {str(value.name) for value in values}
    for setting in known.values():
        if setting.required and setting.name not in given:
            line = f"{setting.name} = {_EXAMPLES[kind]}"
            help_ = Advice(f"add `{line}`", "add setting", line)
            context.report.report("missing-setting", at, owner=owner, name=setting.name, help=help_)


_EXAMPLES = {"battery": "60 Wh", "radio": "300 m", "senses": "20 m"}
"""Values of required settings, by the word before the block."""


def _check_range(value: PartValue, setting: SpaceSetting, context: Context) -> None:
    number = number_of(value.value, context.typing.folding)
    if number is None:
        return
    if number < 0 or (setting.positive and number == 0) or number > setting.most:
        context.report.report(
            "setting-range", value.value.span, name=setting.name, expected=_limits(setting)
        )


def _limits(setting: SpaceSetting) -> str:
    if isinf(setting.most):
        return "more than 0" if setting.positive else "0 or more"
    if setting.most == 2 * pi:
        return f"more than 0 and at most {degrees(setting.most):g} deg"
    return f"from 0 to {setting.most:g}"


def _check_speed(member: Member, context: Context) -> None:
    """Report a body without a speed of a member with a function whose model moves it."""
    body = next((item for item in all_items(member, Equipment) if item.kind == "body"), None)
    if body is None or any(value.name == "speed" for value in body.values):
        return
    if body not in member.items:
        return  # reported where it is declared
    for use in _models_of(member):
        model = MODELS.get(str(use.name))
        given = {str(argument.name) for argument in use.arguments}
        if model is not None and model.argument("speed") is not None and "speed" not in given:
            context.report.report(
                "missing-speed",
                body.span,
                member=member.name,
                model=use.name,
                related=(Label(use.name.span, "this model moves the robot"),),
                help=Advice("add `speed = 1 m/s` to the body", "add setting", "speed = 1 m/s"),
            )
            return


def _models_of(member: Member) -> Iterable[ModelUse]:
    """Yield the models of the functions that a member calls."""
    for machine in machines_of(member):
        for activity in nodes_of(machine, Activity):
            if isinstance(activity.function.target, Function):
                yield from nodes_of(activity.function.target, ModelUse)
