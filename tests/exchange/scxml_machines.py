"""Machines that target `scxml` can express."""

from __future__ import annotations

from dataclasses import replace

from swarmdsl.codegen.features import uses_in_machine
from swarmdsl.codegen.registry import load
from swarmdsl.ir import StateMachine, System


def with_documents(system: System) -> System:
    """The same with the machines that have a portable document."""
    return replace(system, machines=tuple(filter(_has_document, system.machines)))


def _has_document(machine: StateMachine) -> bool:
    supported = load("scxml").supports
    return all(feature in supported for feature, _ in uses_in_machine(machine))
