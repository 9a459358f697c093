"""Verdicts, measures and fitness of a run as JSON."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import Any

from swarmdsl.execution.monitor import PropertyResult
from swarmdsl.execution.simulate.evaluation.measures import FitnessResult, Measured
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND, SECOND


def as_document(
    head: Mapping[str, Any],
    properties: Iterable[PropertyResult],
    fitness: FitnessResult | None,
) -> str:
    """Return a document of JSON; it begins with the entries of `head`."""
    values = {
        **head,
        "properties": [_property(each) for each in properties],
        **(fitness_values(fitness) if fitness is not None else {}),
    }
    return f"{json.dumps(values, indent=2)}\n"


def fitness_values(result: FitnessResult) -> dict[str, Any]:
    """Return the measures and the fitness as plain data; times are in seconds."""
    reason = {"reason": result.reason} if result.reason else {}
    return {
        "measures": [_measure(each) for each in result.measures],
        "fitness": {
            "name": result.fitness.name,
            "goal": result.fitness.goal,
            "value": result.value,
            **reason,
        },
    }


def _measure(each: Measured) -> dict[str, Any]:
    value = each.reading.value
    unit = {"unit": "s"} if each.is_time else {}
    missed = {} if each.reading.reached else {"reached": False}
    if value is not None and each.is_time:
        value /= SECOND
    return {"name": each.input.name, "value": value, **unit, **missed}


def _property(each: PropertyResult) -> dict[str, Any]:
    violations = [{"t": v.time / MILLISECOND, "member": v.robot} for v in each.violations]
    robots = {"members": list(each.robots)} if each.property.each is not None else {}
    return {
        "name": each.property.name,
        "verdict": each.verdict,
        **robots,
        **({"violations": violations} if violations else {}),
        **({"remark": each.remark} if each.remark else {}),
    }
