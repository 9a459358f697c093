"""Senders and handlers of events and callers of functions, including submachines."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl import ir
from swarmdsl.base.records import dataclass, field
from swarmdsl.tools.document.elements import Element, Elements

States = dict[Element, None]
"""Elements in the order in which they were found."""


@dataclass(slots=True)
class EventTraffic:
    """States, by machine, that send an event, handle it, or call a function."""

    sent: dict[str, dict[Element, States]] = field(default_factory=dict)
    handled: dict[str, dict[Element, States]] = field(default_factory=dict)
    called: dict[str, dict[Element, States]] = field(default_factory=dict)

    def machines(self) -> list[Element]:
        """All machines that send or handle an event."""
        found = (self.sent, self.handled)
        return list(
            dict.fromkeys(each for by in found for states in by.values() for each in states)
        )


def collect_traffic(system: ir.System, elements: Elements) -> EventTraffic:
    """Collect the events and function calls of all machines by name."""
    found = EventTraffic()
    for machine in system.machines:
        top = elements.at(machine.origin)
        if top is None:
            continue
        for state in machine.walk():
            element = elements.at(state.origin) or top
            _record(found.sent, _sent(state), top, element)
            _record(found.handled, _handled(state), top, element)
            called = [state.activity.function] if state.activity is not None else []
            _record(found.called, called, top, element)
    return found


def _record(
    found: dict[str, dict[Element, States]], names: Iterable[str], machine: Element, state: Element
) -> None:
    for name in names:
        found.setdefault(name, {}).setdefault(machine, {})[state] = None


def _sent(state: ir.State) -> Iterable[str]:
    effects = [*state.entry, *state.exit]
    effects += (each for transition in state.transitions for each in transition.effects)
    return (each.event for each in effects if isinstance(each, ir.Send))


def _handled(state: ir.State) -> Iterable[str]:
    triggers = (each for transition in state.transitions for each in transition.triggers)
    return (each.event for each in triggers if isinstance(each, ir.EventTrigger))
