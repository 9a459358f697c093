"""Search space for FREVO: integers, each with a scale for its unit."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.naming import snake_case
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.codegen.shared.constants import constant
from swarmdsl.ir import Expression, Optimization, ParamRange, Primitive, System
from swarmdsl.syntax.types import INTEGERS

# Range of a Java `int`.
LARGEST = 2**31 - 1


@dataclass(frozen=True)
class SearchParameter:
    """Parameter from `minimum` to `maximum`, times `scale`.

    `meta` is the destination of its value: the command line, or the parameter file of a package.
    """

    name: str
    meta: str
    minimum: int
    maximum: int
    scale: float


def search_parameters(
    optimization: Optimization, system: System, package: str, target: str, report: Diagnostics
) -> Iterator[SearchParameter]:
    """Return the parameters that can be expressed; report the others."""
    for kept in optimization.constraints:
        what = f"the constraint `{kept.property}`"
        note = "the search does not know of properties"
        report.report("no-place", kept.origin, target=target, what=what, notes=(note,))
    package = behaviour_package(system, package)
    owners: dict[str, str] = {}
    for range_ in optimization.params:
        owner = owners.setdefault(range_.param, range_.role)
        if owner != range_.role:
            note = f"it is the same param as that of role `{owner}` in the parameter file"
            _report(range_.param, range_.origin, target, report, note)
            continue
        scale = _scale(range_, optimization, system)
        if scale is None:
            note = "the range is continuous, and the optimiser needs discrete values"
            hint = "add a step: `step 0.1`"
            _report(range_.param, range_.origin, target, report, note, hint)
            continue
        lowest, highest = (_exact(end) / scale for end in (range_.lower, range_.upper))
        if lowest.denominator != 1 or max(-lowest, highest) > LARGEST:
            note = "a value is a 32-bit integer times the step"
            hint = "let the range begin at a multiple of the step"
            _report(range_.param, range_.origin, target, report, note, hint)
            continue
        meta = f"file:{package}"
        yield SearchParameter(range_.param, meta, int(lowest), int(highest // 1), float(scale))
    for count in optimization.counts:
        if count.role in owners:
            note = "another varied param has that name"
            _report(count.role, count.origin, target, report, note)
            continue
        fewest, most = int(number(count.lower)), int(number(count.upper))
        yield SearchParameter(count.role, "command_line", fewest, most, 1.0)


def behaviour_package(system: System, package: str) -> str:
    """Return the ROS package of the behaviours: the given one, or target smach's."""
    return package or f"{snake_case(system.name)}_behavior"


def number(expression: Expression) -> float:
    """Return the value of a number, or of a duration in seconds; it is known."""
    value = constant(expression, {})
    assert isinstance(value, (int, float))
    return value


def _exact(expression: Expression) -> Fraction:
    """Return the value as a decimal fraction: 0.1 is a tenth."""
    return Fraction(str(number(expression)))


def _scale(range_: ParamRange, optimization: Optimization, system: System) -> Fraction | None:
    """Return the step; without one it is 1 for integers and None for others."""
    if range_.step is not None:
        return _exact(range_.step)
    swarm = next(each for each in system.swarms if each.name == optimization.swarm)
    role = next(each for each in swarm.roles if each.name == range_.role)
    member = system.members_by_name[role.member]
    param = next(each for each in member.params if each.name == range_.param)
    whole = isinstance(param.type, Primitive) and param.type.name in INTEGERS
    return Fraction(1) if whole else None


def _report(
    name: str,
    at: Span | None,
    target: str,
    report: Diagnostics,
    note: str,
    hint: str | None = None,
) -> None:
    what = f"the range of `{name}`"
    report.report("no-place", at, target=target, what=what, notes=(note,), help=hint)
