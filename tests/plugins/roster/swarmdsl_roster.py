"""Target `roster`: members of a swarm, as text."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from swarmdsl.codegen import Diagnostics, Feature, Generator, OutputFile, option
from swarmdsl.ir import System


def _indent_fault(indent: int) -> str | None:
    return None if 0 <= indent <= 40 else f"{indent} is no number of spaces: 0 to 40"


@dataclass(frozen=True)
class Options:
    """Options of target `roster`."""

    style: str = option("plain", "How a role is written.", choices=("plain", "markdown"))
    title: str = option("", "A first line.")
    indent: int = option(0, "Spaces before each role.", check=_indent_fault)
    count: bool = option(True, "Whether to say how many.")


def emit(system: System, options: Options, report: Diagnostics) -> Iterator[OutputFile]:
    """Yield a file for each swarm."""
    for swarm in system.swarms:
        lines = [options.title] if options.title else []
        for role in swarm.roles:
            mark = "- " if options.style == "markdown" else ""
            many = f" [{role.multiplicity}]" if options.count else ""
            lines.append(f"{' ' * options.indent}{mark}{role.name}{many}")
        yield OutputFile(f"{swarm.name}.txt", "".join(f"{line}\n" for line in lines))


generator = Generator(
    target="roster",
    summary="Who is in a swarm",
    emit=emit,
    options_type=Options,
    supports=frozenset(Feature) - {Feature.TIMEOUT},
)
