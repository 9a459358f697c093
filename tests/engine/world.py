"""A world of tests: it does nothing of its own, and says what a machine asked of it."""

from __future__ import annotations

from collections.abc import Callable

from swarmdsl.execution.engine import Event, Instance, Machine, Observer, Run, State, Transition
from swarmdsl.execution.simulate.scenario.clock import Alarm, Clock


class StillWorld:
    """Activities neither start nor stop by themselves; what was asked is in `asked`."""

    def __init__(self) -> None:
        self.clock = Clock()
        self.asked: list[str] = []
        self.runs: dict[str, Run] = {}
        self.errors: list[str] = []

    @property
    def time(self) -> int:
        return self.clock.now

    def schedule(self, delay: int, action: Callable[[], None]) -> Alarm:
        return self.clock.schedule(delay, action)

    def unschedule(self, handle: Alarm) -> None:
        self.clock.unschedule(handle)

    def start(self, run: Run) -> None:
        self.runs[run.activity.name] = run
        self.asked.append(f"start {run.activity.name}")

    def cancel(self, run: Run) -> None:
        self.asked.append(f"cancel {run.activity.name}")

    def send(self, instance: Instance, event: Event) -> None:
        self.asked.append(f"send {event.name} {event.data}")

    def failed(self, instance: Instance, error: Exception) -> None:
        self.errors.append(str(error))


class Trace(Observer):
    """Trace of an instance, one short line per action."""

    def __init__(self) -> None:
        self.lines: list[str] = []

    def received(self, instance: Instance, event: Event) -> None:
        self.lines.append(f"? {event.name}")

    def exited(self, instance: Instance, state: State) -> None:
        self.lines.append(f"- {state.id}")

    def taken(self, instance: Instance, transition: Transition) -> None:
        self.lines.append(f"> {' '.join(transition.targets)}")

    def entered(self, instance: Instance, state: State) -> None:
        self.lines.append(f"+ {state.id}")

    def started(self, instance: Instance, run: Run) -> None:
        self.lines.append(f"start {run.activity.name}")

    def cancelled(self, instance: Instance, run: Run) -> None:
        self.lines.append(f"cancel {run.activity.name}")

    def sent(self, instance: Instance, event: Event) -> None:
        self.lines.append(f"send {event.name}")

    def logged(self, instance: Instance, text: str) -> None:
        self.lines.append(f"log {text}")


def started(machine: Machine, observer: Observer | None = None) -> Instance:
    """An instance in a world of its own."""
    instance = Instance(machine, StillWorld(), observer=observer)
    instance.start()
    return instance


def after(instance: Instance, *events: str) -> list[str]:
    """The innermost active states after some events."""
    for event in events:
        instance.receive(Event(event))
    return instance.configuration.innermost


def note(word: str) -> Callable[[Instance, Event], None]:
    """An effect that adds a word to the list in the instance's data."""

    def effect(instance: Instance, event: Event) -> None:
        instance.data.setdefault("notes", []).append(word)

    return effect


def on(events: str, *targets: str, **rest: object) -> Transition:
    """A transition on some events, written in one text."""
    return Transition(tuple(events.split()), targets, **rest)  # type: ignore[arg-type]
