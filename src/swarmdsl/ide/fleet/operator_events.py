"""Events that a person may send to the robots of a swarm."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from swarmdsl import ir
from swarmdsl.base.records import dataclass
from swarmdsl.codegen.shared.default_values import default_fields
from swarmdsl.execution.simulate.machines.subject import Subject

_HEADERS = ("std_msgs/Header", "swarmros/EventHeader")
"""Types of fields that say who sends a message, and when."""
_URGENT = "abort"
"""Part of the name of an event that comes before all others."""


@dataclass(frozen=True)
class OperatorEvent:
    """Event that a person may send; `blank` has default values of its fields, without headers."""

    event: ir.Event
    blank: Any

    @property
    def name(self) -> str:
        """Name of the event."""
        return self.event.name

    @property
    def is_urgent(self) -> bool:
        """Return True for an event that ends what the robots do."""
        return _URGENT in self.name.lower()

    def head(self) -> dict[str, Any]:
        """Return the event as plain data."""
        return {
            "name": self.name,
            "doc": self.event.doc,
            "blank": self.blank,
            "urgent": self.is_urgent,
        }


def operator_events(subject: Subject | None) -> list[OperatorEvent]:
    """Return the events that a person may send, those that abort first."""
    found = list(_events(subject)) if subject is not None else []
    return sorted(found, key=lambda each: not each.is_urgent)


def _events(subject: Subject) -> Iterator[OperatorEvent]:
    system = subject.system
    for event in system.events if system is not None else ():
        if system is not None and event.operator and event.swarm:
            message = system.known_interface(event.type)
            fields = message.fields if isinstance(message, ir.Message) else ()
            blank = default_fields(
                (each for each in fields if str(each.type) not in _HEADERS), system
            )
            yield OperatorEvent(event, blank)
