"""Numbers of members that a proof is about."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import product

from swarmdsl import ir
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.numerals import integer
from swarmdsl.base.source import COMMAND_LINE, Source, Span
from swarmdsl.base.suggest import suggest
from swarmdsl.execution.simulate.machines.subject import Subject

_WRITTEN = re.compile(r"([^=]+)=([0-9]{1,5})(?:\.\.([0-9]{1,5}))?")


Size = tuple[str, range | None]
"""Role with its numbers of members, None for any number."""


def read_size(text: str) -> Size | None:
    """Parse `robot=3`, `robot=2..5` or `robot=any`; None if it is none of these."""
    if (role := text.removesuffix("=any")) != text and role and "=" not in role:
        return role, None
    found = _WRITTEN.fullmatch(text)
    if found is None:
        return None
    least = integer(found[2])
    most = integer(found[3]) if found[3] is not None else least
    return (found[1], range(least, most + 1)) if least <= most else None


def sizes(
    subject: Subject,
    asked: Sequence[Size],
    report: Diagnostics,
    known: Mapping[str, int] | None = None,
) -> list[dict[str, int]]:
    """Return the numbers of members to look at, the smallest first; report impossible ones.

    Of roles with any number there is the smallest one, but at least 1. The numbers of other roles
    may be `known`, from a scenario.
    """
    roles = subject.swarm.roles if subject.swarm is not None else ()
    by_name = {role.name: role for role in roles}
    wanted = {name: range(count, count + 1) for name, count in (known or {}).items()}
    for name, numbers in asked:
        if name not in by_name:
            text = f"--size {name}"
            place = Span(Source(COMMAND_LINE, text), len(text) - len(name), len(text))
            help_ = suggest(name, by_name, "roles")
            if subject.swarm is None:
                help_ = "sizes are for swarms: choose one with `--swarm`, or leave `--size` out"
            report.report("unresolved-name", place, kind="role", name=name, help=help_)
            continue
        multiplicity = by_name[name].multiplicity
        if numbers is None:
            if multiplicity.lower == multiplicity.upper:
                _report(by_name[name], "any number of", report)
            least = max(multiplicity.lower, 1)
            numbers = range(least, least + 1)
        for number in (numbers[0], numbers[-1]):
            if not _allows(multiplicity, number):
                _report(by_name[name], number, report)
                break
        wanted[name] = numbers
    found = [dict(zip(wanted, each, strict=True)) for each in product(*wanted.values())]
    if by_name and all(0 in wanted.get(name, ()) for name in by_name):
        # A swarm of nobody does nothing.
        found = [each for each in found if any(each.values())]
        if not found and not report.has_errors:
            name = next(iter(by_name))
            report.report("nothing-to-simulate", help=f"choose a member: `--size {name}=1`")
    return sorted(found, key=lambda each: sum(each.values()))


def _allows(multiplicity: ir.Multiplicity, number: int) -> bool:
    upper = multiplicity.upper
    return multiplicity.lower <= number and (upper is None or number <= upper)


def bounds(subject: Subject, asked: Sequence[Size]) -> dict[str, tuple[int, int | None]]:
    """Return the least and greatest numbers of members of roles with any number.

    There is one at least: events of robots that are not there would come from outside.
    """
    roles = subject.swarm.roles if subject.swarm is not None else ()
    free = {name for name, numbers in asked if numbers is None}
    return {
        role.name: (max(role.multiplicity.lower, 1), role.multiplicity.upper)
        for role in roles
        if role.name in free
    }


def _report(role: ir.Role, number: int | str, report: Diagnostics) -> None:
    example = number if isinstance(number, int) else "2..8"
    ways = f"`{role.member}[{example}]` or `[1..*]`" if number != 0 else f"`{role.member}[0..*]`"
    report.report(
        "size-not-allowed",
        role.origin,
        count=number,
        role=role.name,
        label=f"here there are {role.multiplicity}",
        help=f"change the multiplicity, such as {ways}",
    )


def shown(subject: Subject, every: Sequence[Mapping[str, int]], free: Collection[str] = ()) -> str:
    """Describe numbers of members: `2 to 5 robot, 1 base`; any number of some roles."""
    return ", ".join(_of_roles(subject, every, free)) or "one machine"


def whole(subject: Subject, counts: Mapping[str, int]) -> dict[str, int]:
    """Return the numbers of members of all roles."""
    roles = subject.swarm.roles if subject.swarm is not None else ()
    return {each.name: counts.get(each.name, max(each.multiplicity.lower, 1)) for each in roles}


def _of_roles(
    subject: Subject, every: Sequence[Mapping[str, int]], free: Collection[str]
) -> Iterator[str]:
    every = [whole(subject, each) for each in every]
    for name in every[0] if every else ():
        least, most = min(each[name] for each in every), max(each[name] for each in every)
        if name in free:
            yield f"any number of {name}"
        else:
            yield f"{least} {name}" if least == most else f"{least} to {most} {name}"
