"""Units after `in`, and what is wrong with them."""

from __future__ import annotations

from swarmdsl.base.diagnostics.advice import write
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.suggest import did_you_mean
from swarmdsl.syntax.ast import Word
from swarmdsl.syntax.types import DURATION, FLOAT, Array, Type, declared_unit, unit_of, with_unit
from swarmdsl.syntax.units import UNITS, Unit, meant_unit


def find_unit(type_: Type, name: Word, report: Diagnostics) -> Unit | None:
    """Return the unit of a type by name; report one that there cannot be and return None."""
    unit = UNITS.get(name)
    if unit is None:
        meant = meant_unit(name)
        help_ = write(meant) if meant else did_you_mean(name, UNITS)
        if help_ is None:
            help_ = f"the units are {' '.join(f'`{known}`' for known in UNITS)}"
        report.report("unresolved-name", name.span, kind="unit", name=name, help=help_)
        return None
    if unit_of(with_unit(type_, unit)) is None:
        element = type_.element if isinstance(type_, Array) else type_
        help_ = f"only a number has a unit: `{FLOAT} in {unit}`"
        if element == DURATION:
            help_ = f"a duration has no unit; a number in `s` is `{FLOAT} in s`"
        report.report("wrong-unit", name.span, expected="a number", found=f"`{type_}`", help=help_)
        return None
    earlier = declared_unit(type_)
    if earlier is not None and earlier != unit:
        report.report(
            "wrong-unit",
            name.span,
            expected=f"`{earlier}`, the unit of the type",
            found=f"`{unit}`",
            help="delete `in " + f"{unit}`",
        )
        return None
    return unit
