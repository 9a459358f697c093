"""Key of the state of a robot: equal for bodies that do the same from now on."""

from __future__ import annotations

from typing import Any

from swarmdsl.execution.engine import NO_ENVELOPE, Event
from swarmdsl.execution.monitor import LOST
from swarmdsl.execution.simulate.machines.expressions import SELF
from swarmdsl.execution.verify.abstraction.alphabet import Alphabet, frozen
from swarmdsl.execution.verify.robot.body import Body


class StateKey:
    """Keys of bodies, by the data that decide on anything."""

    def __init__(self, alphabet: Alphabet) -> None:
        self._alphabet = alphabet

    def kept(self, body: Body) -> tuple[tuple[str, Any], ...]:
        """Return the variables that decide on anything."""
        demands = self._alphabet.demands
        return tuple(
            (f"{instance.machine.name}.{name}", frozen(value))
            for instance in body.instances
            for name, value in instance.data.items()
            if name != SELF and demands.keeps(instance.machine.name, name)
        )

    def of(self, body: Body) -> Any:
        """Return what decides on everything that a body does from now on."""
        if body.is_lost:
            return LOST, len(body.absences), tuple(sorted(body.used)) if body.absences else ()
        machines = tuple(
            (
                instance.running,
                instance.final,
                instance.configuration.active,
                instance.configuration.histories,
                tuple(map(self.waiting, instance._deferred or ())),
            )
            for instance in body.instances
        )
        runs = tuple(sorted((number, run.state) for number, run in body.runs))
        delays = tuple(
            sorted(
                (d.actor, d.timer.id, repr(d.timer.message and self.waiting(d.timer.message)))
                for d in body.delays
            )
        )
        inside = tuple(map(self.waiting, body.inside))
        missing = self._missing(body) if body.running else ()
        kept = self.kept(body) if body.running else ()
        used = tuple(sorted(body.used)) if body.running else ()
        return machines, runs, delays, inside, kept, tuple(missing), used, len(body.absences)

    def _missing(self, body: Body) -> list[str]:
        """Return the roles of the robots that it takes for lost, or their names if these count."""
        if body.roster is None or body.crew is None:
            return []
        if body.crew.guesses and self._alphabet.demands.identity:
            return [each.name or "" for each in body.crew.robots if body.roster.misses(each)]
        return sorted(body.roster.missing)

    def waiting(self, event: Event) -> Any:
        """Return what decides of an event that waits."""
        envelope = event.envelope or NO_ENVELOPE
        sender = envelope.sender if self._alphabet.demands.identity else ""
        return (event.name, self._alphabet.shown(event), envelope.to or "", sender)
