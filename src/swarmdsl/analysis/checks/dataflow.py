"""Checks of variables that are never read or never written."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.analysis.checks.accesses import storing_nodes
from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.types import stored_name
from swarmdsl.syntax.ast import (
    NameUse,
    StateMachine,
    Variable,
    nodes_of,
)
from swarmdsl.syntax.types import Named


def check_variables(machine: StateMachine, context: Context) -> None:
    """Report variables that are not both written and read."""
    stores = set(_stores(machine))
    written = {use.target for use in stores}
    read = {use.target for use in nodes_of(machine, NameUse) if use not in stores}
    for item in nodes_of(machine, Variable):
        if item not in read and item not in written:
            fault = "is never used"
        elif item not in read:
            fault = "is written and never read"
        elif item not in written and item.initial is None and not isinstance(item.type.type, Named):
            fault = "is read and never written"
        else:
            continue
        context.report.report("idle-variable", item.name.span, name=item.name, fault=fault)


def _stores(machine: StateMachine) -> Iterator[NameUse]:
    """Yield the names of variables that are written, not read."""
    for node in storing_nodes(machine):
        name = stored_name(node.target.tree)
        if name is not None:
            yield name
