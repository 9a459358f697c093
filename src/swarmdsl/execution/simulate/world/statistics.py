"""Statistics of a run: time in states, coverage, calls and events."""

from __future__ import annotations

from collections import Counter

from swarmdsl.base.records import dataclass, field
from swarmdsl.execution.engine import (
    Event,
    Instance,
    InstanceLike,
    LoopError,
    Machine,
    Observer,
    Run,
    State,
    Transition,
)
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.scenario.clock import Clock

_LIMIT = 10_000
"""Maximum number of events that a machine may process at one point in time."""


@dataclass
class MachineStatistics:
    """Counts of all instances of a machine; times are in nanoseconds, states are given as ids."""

    running: int = 0
    times: Counter[str] = field(default_factory=Counter)
    entered: Counter[str] = field(default_factory=Counter)
    taken: dict[int, Transition] = field(default_factory=dict)
    """Transitions that were taken, by identity."""


class Statistics:
    """Counts of a run, by machine, function and event."""

    def __init__(self) -> None:
        self.machines: dict[Machine, MachineStatistics] = {}
        self.called: Counter[str] = Counter()
        self.sent: Counter[str] = Counter()
        self.ignored: Counter[tuple[str, str]] = Counter()
        """Numbers of events that enabled no transition, by event and states."""
        self.active: Life | None = None
        """The instance that processed the last event."""

    def of(self, machine: Machine) -> MachineStatistics:
        """Return the counts of a machine."""
        return self.machines.setdefault(machine, MachineStatistics())


class Life(Observer):
    """Statistics of one instance, which it observes.

    `since` is the time at which its states last changed.
    """

    __slots__ = (
        "_began",
        "_busy",
        "_clock",
        "_count",
        "_counted",
        "_entries",
        "_whole",
        "actor",
        "instance",
        "lost",
        "since",
    )

    def __init__(self, instance: Instance, actor: Actor, clock: Clock, whole: Statistics) -> None:
        self.instance = instance
        self.actor = actor
        self.since = 0
        self.lost = False
        self._clock = clock
        self._whole = whole
        self._counted = whole.of(actor.machine)
        self._entries: dict[str, int] = {}
        self._began = 0
        self._busy = -1
        self._count = 0

    def arrives(self) -> None:
        """Count an event from outside.

        Raises LoopError if this repeats too often at one point in time.
        """
        self._whole.active = self
        now = self._clock.now
        if self._busy != now:
            self._busy, self._count = now, 1
            return
        self._count += 1
        if self._count > _LIMIT:
            raise LoopError(self.actor.machine.name, self.instance.configuration.innermost)

    def count_anew(self) -> None:
        """Forget how many events have come at this point in time."""
        self._busy = -1

    def close(self) -> None:
        """Add the time in the states that are still active; do it once, at the end."""
        now = self._clock.now
        for state, entered in self._entries.items():
            self._counted.times[state] += now - entered
        self._entries.clear()
        if not self.is_over:
            self._counted.running += now - self._began

    def lose(self) -> None:
        """Record that the robot is lost."""
        self.close()
        self.lost = True
        self.since = self._clock.now

    def revive(self, instance: Instance) -> None:
        """Go on with another instance, after a loss."""
        if not self.is_over:
            self.close()
        self.instance = instance
        self.lost = False
        self.since = self._began = self._clock.now

    @property
    def is_over(self) -> bool:
        """True if the machine has ended or its robot is lost."""
        return self.lost or self.instance.final is not None

    # ---- called by the instance

    def received(self, instance: InstanceLike, event: Event) -> None:
        """Count a delay or an activity; the world counts other events."""
        if event.origin is not None:
            self.arrives()

    def ignored(self, instance: InstanceLike, event: Event) -> None:
        """Count it."""
        where = f"{instance.machine.name}: {', '.join(instance.configuration.innermost)}"
        self._whole.ignored[event.name, where] += 1

    def dropped(self, instance: InstanceLike, event: Event) -> None:
        """Count it."""
        where = f"{instance.machine.name}: (more than {instance.machine.most_deferred} deferred)"
        self._whole.ignored[event.name, where] += 1

    def recalled(self, instance: InstanceLike, event: Event) -> None:
        """Count it like an event from outside."""
        self.arrives()

    def entered(self, instance: InstanceLike, state: State) -> None:
        """Begin the time in a state."""
        self.since = self._entries[state.id] = self._clock.now
        self._counted.entered[state.id] += 1

    def exited(self, instance: InstanceLike, state: State) -> None:
        """End the time in a state, and that of the machine with its final state."""
        now = self._clock.now
        self._counted.times[state.id] += now - self._entries.pop(state.id, now)
        if self.instance.final is None:
            self.since = now
        elif state.id == self.instance.final:
            self._counted.running += now - self._began

    def taken(self, instance: InstanceLike, transition: Transition) -> None:
        """Record it."""
        self._counted.taken[id(transition)] = transition

    def started(self, instance: InstanceLike, run: Run) -> None:
        """Count it."""
        self._whole.called[run.activity.name] += 1

    def sent(self, instance: InstanceLike, event: Event) -> None:
        """Count it."""
        self._whole.sent[event.name] += 1
