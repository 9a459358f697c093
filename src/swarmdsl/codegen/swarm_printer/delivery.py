"""Print the delivery of a swarm event."""

from __future__ import annotations

from swarmdsl.codegen.swarm_printer.expressions import duration
from swarmdsl.ir import Delivery


def delivery_settings(delivery: Delivery | None) -> list[str]:
    """Return the settings of a delivery: `reliable`, `keep 5`, `lifespan 5 s`."""
    if delivery is None:
        return []
    found = {True: ["reliable"], False: ["best effort"], None: []}[delivery.reliable]
    if delivery.latest:
        found.append("latest")
    if delivery.keep is not None:
        found.append(f"keep {delivery.keep}")
    for word, time in (("lifespan", delivery.lifespan), ("deadline", delivery.deadline)):
        if time is not None:
            found.append(f"{word} {duration(time)}")
    return found
