"""Elements of the machines of a recording that coverage counts."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from swarmdsl.execution.engine import Machine
from swarmdsl.execution.simulate.evaluation.coverage import Coverage, Key, MachineCoverage
from swarmdsl.execution.simulate.machines.subject import Subject


def coverage_of(subject: Subject, machines: Iterable[Machine]) -> dict[str, Any]:
    """Return the elements that coverage counts, and those of each machine, by trace names.

        {"elements": [{"machine": "M", "kind": "state", "words": "Idle"}],
         "of": {"M": {"Idle": 0}}}

    They are the same as in the summary of a simulation.
    """
    coverage = Coverage()
    coverage.expect(subject)
    named = {machine.name: coverage.elements(machine) for machine in machines}
    numbers: dict[tuple[str, str, Key], int] = {}
    elements: list[dict[str, Any]] = []
    for row in coverage.machines:
        for kind, words in (("state", row.states), ("transition", row.transitions)):
            for key, said in words.items():
                numbers[kind, row.name, key] = len(elements)
                elements.append({"machine": row.name, "kind": kind, "words": said})

    def number(id_: str, row: MachineCoverage, key: Key) -> int:
        return numbers["transition" if "->" in id_ else "state", row.name, key]

    of = {
        name: {id_: number(id_, *element) for id_, element in found.items()}
        for name, found in named.items()
    }
    return {"elements": elements, "of": of}
