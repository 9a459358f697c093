"""Machines that read the identity of their robot."""

from __future__ import annotations

from swarmdsl.codegen.api import Feature
from swarmdsl.codegen.features import uses_in_machine
from swarmdsl.ir import StateMachine


def uses_self(machine: StateMachine) -> bool:
    """Return True if an expression of the machine reads a field of `self`."""
    return any(feature is Feature.SELF for feature, _ in uses_in_machine(machine))


def follows_members(machine: StateMachine) -> bool:
    """Return True if a machine handles events of members, or counts them."""
    followed = (Feature.MEMBER_EVENT, Feature.PRESENT)
    return any(feature in followed for feature, _ in uses_in_machine(machine))
