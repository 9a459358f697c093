"""Print contracts of members."""

from __future__ import annotations

from swarmdsl.codegen.swarm_printer.expressions import expression
from swarmdsl.codegen.swarm_printer.layout import UnprintableError, documented
from swarmdsl.ir import Contract, Member


def own_contracts(member: Member, base: Member | None) -> list[Contract]:
    """Return the contracts that are new, or replace an inherited one."""
    inherited = base.contracts if base is not None else ()
    names = [each.name for each in inherited]
    if [each.name for each in member.contracts[: len(names)]] != names:
        raise UnprintableError(f"`{member.name}` lacks a contract of `{member.base}`")
    return [each for each in member.contracts if each not in inherited]


def print_contracts(member: Member, base: Member | None) -> list[str]:
    """Print the contracts of a member that are not inherited."""
    return [
        line
        for each in own_contracts(member, base)
        for line in documented(each.doc, [f"contract {each.name} : {contract_text(each)}"])
    ]


def contract_text(contract: Contract) -> str:
    """Return a contract without its name: `on Halt within 2 s reach Landed`."""
    if contract.function is not None:
        return f"when dead call {contract.function}"
    assert contract.within is not None
    guard = f" [{expression(contract.guard)}]" if contract.guard is not None else ""
    events, states = ", ".join(contract.events), ", ".join(contract.states)
    return f"on {events}{guard} within {expression(contract.within)} reach {states}"
