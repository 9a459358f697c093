"""Verdicts on small swarms with times, by playing all runs on the engine second by second; slow.

As `slow`, with a clock: all lengths are whole seconds, and what is due happens before time passes.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.engine import Event, InstanceLike, Run
from swarmdsl.execution.simulate.evaluation.properties import watchable
from swarmdsl.execution.simulate.machines.actors import actors
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.execution.simulate.scenario.scenario import Scenario
from swarmdsl.ir import System

from .slow import Choice, Swarm

Bounds = tuple[int, int]
"""Least and greatest time in seconds."""


class _TimedSwarm(Swarm):
    """A swarm that runs choice by choice; `tick` lets a second pass."""

    def __init__(self, function: Bounds, latency: Bounds, *given: Any) -> None:
        self._function = function
        self._latency = latency
        self._due: dict[int, int] = {}
        self._began: dict[int, int] = {}
        self._sent: list[list[int]] = []
        super().__init__(*given)

    def pass_time(self) -> None:
        """Let no time pass at a choice."""

    def schedule(self, delay: int, action: Callable[[], None]) -> Any:
        made = super().schedule(delay, action)
        self._due[id(made.__self__)] = self.clock.now + delay
        return made

    def start(self, run: Run) -> None:
        super().start(run)
        self._began[id(run)] = self.clock.now

    def send(self, instance: InstanceLike, event: Event) -> None:
        super().send(instance, event)
        self._note_sent()

    def _note_sent(self) -> None:
        while len(self._sent) < len(self.bags):
            self._sent.append([])
        for bag, sent in zip(self.bags, self._sent, strict=True):
            sent += [self.clock.now] * (len(bag) - len(sent))

    def choices(self, outside: Sequence[str]) -> Iterator[Choice]:
        for each in super().choices(outside):
            match each:
                case ("end", number, *_) if not self._may_end(self.runs[number]):
                    continue
                case ("end", _, "preempted", _) | ("end", _, _, {"ok": True}):
                    continue
                case ("delay", number) if self._left(self.delays[number]):
                    continue
                case ("hear", number, message) if self._age(number, message) < self._latency[0]:
                    continue
            yield each
        if self._may_tick():
            yield ("tick",)

    def take(self, choice: Choice) -> None:
        match choice:
            case ("tick",):
                if not self.watch.has_begun:
                    # No line tells that all machines have started.
                    self.watch._begin()
                self.clock.now += SECOND
                self.watch.advance(self.clock.now)
                return
            case ("hear", number, message):
                self._note_sent()
                self._sent[number].pop(message)
        super().take(choice)
        for bag, sent in zip(self.bags, self._sent, strict=False):
            del sent[len(bag) :]
        self._note_sent()

    @property
    def place(self) -> str:
        """All that decides on what can happen from now on."""
        runs = sorted(
            (self._number(run.instance), run.state, self.clock.now - self._began[id(run)])
            for run in self.runs
        )
        delays = sorted(
            (self._number(d.__self__.instance), d.__self__.id, self._left(d)) for d in self.delays
        )
        ages = [sorted(self._age(n, m) for m in range(len(b))) for n, b in enumerate(self.bags)]
        return f"{super().place} {runs} {delays} {ages}"

    @property
    def memories(self) -> dict[str, list[Any]]:
        """Memory of the monitors of each property, with the time left of each clock."""
        found = super().memories
        for watched in self.watch._watched:
            left = [(name, due - self.clock.now) for name, due in watched._dues.items()]
            found[watched.rule.property.name].append(sorted(left, key=repr))
        return found

    def _number(self, instance: Any) -> int:
        return next(n for n, each in enumerate(self.instances) if each is instance)

    def _may_end(self, run: Run) -> bool:
        least, most = self._function
        return least * SECOND <= self.clock.now - self._began[id(run)] <= most * SECOND

    def _left(self, delay: Any) -> int:
        return self._due[id(delay.__self__)] - self.clock.now

    def _age(self, number: int, message: int) -> int:
        self._note_sent()
        return (self.clock.now - self._sent[number][message]) // SECOND

    def _may_tick(self) -> bool:
        most = self._function[1] * SECOND
        return (
            all(self.clock.now - self._began[id(run)] < most for run in self.runs)
            and all(self._left(delay) > 0 for delay in self.delays)
            and all(
                self._age(n, m) < self._latency[1]
                for n, bag in enumerate(self.bags)
                for m in range(len(bag))
            )
        )


def refuted_in_time(
    system: System, outside: Sequence[str], function: Bounds, latency: Bounds, most: int
) -> set[str] | None:
    """Return the properties that some run violates; None if there are more than `most` states."""
    swarm = system.swarms[0]
    subject = Subject(swarm.name, system, swarm)
    cast = actors(subject, subject.create_robots({}), Scenario(), Diagnostics())

    def play(path: Sequence[Choice]) -> _TimedSwarm:
        played = _TimedSwarm(function, latency, cast, watchable(subject), system, 2)
        for choice in path:
            played.take(choice)
        return played

    first = play(())
    seen = {first.key}
    found = set(first.violated(ended=False))
    queue: deque[tuple[Choice, ...]] = deque([()])
    while queue:
        path = queue.popleft()
        for choice in list(play(path).choices(outside)):
            after = play((*path, choice))
            found |= after.violated(ended=False)
            if after.key not in seen:
                seen.add(after.key)
                queue.append((*path, choice))
                if len(seen) > most:
                    return None
    return found
