"""Numbers of members that a proof is about."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import product

from swarmdsl import ir
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.numerals import integer
from swarmdsl.base.source import COMMAND_LINE, Source, Span
from swarmdsl.base.suggest import suggest
from swarmdsl.execution.simulate.subject import Subject

_WRITTEN = re.compile(r"([^=]+)=([0-9]{1,5})(?:\.\.([0-9]{1,5}))?")


def read_size(text: str) -> tuple[str, range] | None:
    """Parse `robot=3` or `robot=2..5`; None if it is neither."""
    found = _WRITTEN.fullmatch(text)
    if found is None:
        return None
    least = integer(found[2])
    most = integer(found[3]) if found[3] is not None else least
    return (found[1], range(least, most + 1)) if least <= most else None


def sizes(
    subject: Subject, asked: Sequence[tuple[str, range]], report: Diagnostics
) -> list[dict[str, int]]:
    """Return the numbers of members to look at, the smallest first; report impossible ones."""
    roles = subject.swarm.roles if subject.swarm is not None else ()
    by_name = {role.name: role for role in roles}
    wanted: dict[str, range] = {}
    for name, numbers in asked:
        if name not in by_name:
            text = f"--size {name}"
            place = Span(Source(COMMAND_LINE, text), len(text) - len(name), len(text))
            help_ = suggest(name, by_name, "roles")
            report.report("unresolved-name", place, kind="role", name=name, help=help_)
            continue
        for number in (numbers[0], numbers[-1]):
            if not _allows(by_name[name].multiplicity, number):
                _report(by_name[name], number, report)
                break
        wanted[name] = numbers
    found = [dict(zip(wanted, each, strict=True)) for each in product(*wanted.values())]
    if by_name and all(0 in wanted.get(name, ()) for name in by_name):
        # A swarm of nobody does nothing.
        found = [each for each in found if any(each.values())]
        if not found:
            name = next(iter(by_name))
            report.report("nothing-to-simulate", help=f"choose a member: `--size {name}=1`")
    return sorted(found, key=lambda each: sum(each.values()))


def _allows(multiplicity: ir.Multiplicity, number: int) -> bool:
    upper = multiplicity.upper
    return multiplicity.lower <= number and (upper is None or number <= upper)


def _report(role: ir.Role, number: int, report: Diagnostics) -> None:
    report.report(
        "size-not-allowed",
        role.origin,
        count=number,
        role=role.name,
        label=f"here there are {role.multiplicity}",
        help=f"change the multiplicity, such as `{role.member}[{number}]` or `[1..*]`",
    )


def shown(subject: Subject, every: Sequence[Mapping[str, int]]) -> str:
    """Describe numbers of members: `2 to 5 robot, 1 base`."""
    return ", ".join(_of_roles(subject, every)) or "one machine"


def whole(subject: Subject, counts: Mapping[str, int]) -> dict[str, int]:
    """Return the numbers of members of all roles."""
    roles = subject.swarm.roles if subject.swarm is not None else ()
    return {each.name: counts.get(each.name, max(each.multiplicity.lower, 1)) for each in roles}


def _of_roles(subject: Subject, every: Sequence[Mapping[str, int]]) -> Iterator[str]:
    every = [whole(subject, each) for each in every]
    for name in every[0] if every else ():
        least, most = min(each[name] for each in every), max(each[name] for each in every)
        yield f"{least} {name}" if least == most else f"{least} to {most} {name}"
