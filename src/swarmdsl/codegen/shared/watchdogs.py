"""Contracts that call a function when the node of a robot has died."""

from __future__ import annotations

from collections.abc import Set

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.ir import System


def check_watchdogs(
    system: System, watched: Set[str], target: str, report: Diagnostics, note: str, way_out: str
) -> None:
    """Report contracts of members that no watchdog keeps; `watched` are the members with one.

    A contract that only an heir keeps is kept.
    """
    calls = [
        (member.name in watched, contract)
        for member in system.members
        for contract in member.contracts
        if contract.function is not None
    ]
    kept = {contract.origin for is_kept, contract in calls if is_kept}
    for contract in {c.origin: c for _, c in calls if c.origin not in kept}.values():
        report.report(
            "no-place",
            contract.origin,
            target=target,
            what=f"contract `{contract.name}`: nothing calls `{contract.function}`",
            notes=(note,),
            help=way_out,
        )
