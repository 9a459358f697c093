"""Cycles of constants that are defined by each other."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.graphs import cycles
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import Constant, NameUse, nodes_of


def open_cycles(project: Project, report: Diagnostics) -> None:
    """Report each cycle of constants and unbind the use that closes it."""
    constants = [node for _, node in project.declarations() if isinstance(node, Constant)]

    def used(constant: Constant) -> Iterator[tuple[NameUse, Constant]]:
        for node in nodes_of(constant, NameUse):
            if isinstance(node.target, Constant):
                yield node, node.target

    for constant, uses in cycles(constants, used):
        *earlier, last = uses
        report.report(
            "constant-cycle",
            last.span,
            name=constant.name,
            related=tuple(Label(use.span, "through this") for use in earlier),
            help="write the value of one of them" if earlier else "write its value",
        )
        last.target = None
