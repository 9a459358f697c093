"""Machines that read the identity of their robot, or follow which others are there."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.codegen.api import Feature
from swarmdsl.codegen.features import Use, uses_in_machine
from swarmdsl.ir import StateMachine


def uses_self(machine: StateMachine) -> bool:
    """Return True if an expression of the machine reads a field of `self`."""
    return any(feature is Feature.SELF for feature, _ in uses_in_machine(machine))


def follows_members(machine: StateMachine) -> bool:
    """Return True if a machine handles events of members, or counts them."""
    return any(True for _ in member_uses(machine))


def counts_neighbors(machine: StateMachine) -> bool:
    """Return True if a machine asks how many robots are near."""
    return any(True for _ in neighbor_uses(machine))


def neighbor_uses(machine: StateMachine) -> Iterator[Use]:
    """Yield the uses of the number of robots nearby in a machine."""
    return (use for use in uses_in_machine(machine) if use[0] is Feature.NEIGHBORS)


def member_uses(machine: StateMachine) -> Iterator[Use]:
    """Yield the uses of events of members in a machine, and of their number."""
    followed = (Feature.MEMBER_EVENT, Feature.PRESENT)
    return (use for use in uses_in_machine(machine) if use[0] in followed)
