"""Verdicts on small swarms by playing all runs on the engine; slow.

Nothing is shared with the verifier: no symmetry, no automata, no packing. A state is what all
instances are in and what is on its way; each is reached by playing a whole run again, with the
watch of simulations beside it.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from copy import deepcopy
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.shared.default_values import default_result
from swarmdsl.execution.engine import Envelope, Event, Instance, InstanceLike, Run, Servers
from swarmdsl.execution.monitor import FALSE, LOST
from swarmdsl.execution.simulate.evaluation.properties import plan, watch, watchable
from swarmdsl.execution.simulate.machines.actors import Actor, actors
from swarmdsl.execution.simulate.machines.expressions import PRESENT
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.network.members import DEPARTED, Roster, following
from swarmdsl.execution.simulate.scenario.clock import Clock
from swarmdsl.execution.simulate.scenario.scenario import Scenario
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.simulate.world.trace import Trace
from swarmdsl.ir import Property, System

Choice = tuple[Any, ...]
_ASKING = ("eventually", "leads", "then", "again")
"""Kinds of sentences about what must happen."""


class Swarm:
    """A swarm that runs choice by choice."""

    def __init__(
        self, cast: Sequence[Actor], properties: Sequence[Property], system: System, capacity: int
    ) -> None:
        self.system = system
        self.capacity = capacity
        self.cast = cast
        self.clock = Clock()
        self.lines: list[Line] = []
        self.trace = Trace(self.clock, [self._see])
        self.watch = watch(plan(properties), self._data)
        self.runs: list[Run] = []
        self.delays: list[Any] = []
        self.bags: list[list[tuple[str, Any, str]]] = [[] for _ in self.cast]
        self.instances: list[Instance] = []
        self.rosters = [Roster([each.robot for each in cast]) for _ in cast]
        self.lost: list[str | None] = []
        for actor, roster in zip(self.cast, self.rosters, strict=True):
            data = {**deepcopy(actor.data), PRESENT: roster.count}
            instance = Instance(actor.machine, self, data=data, servers=Servers())
            self.trace.watch(instance, actor)
            self.instances.append(instance)
        for instance in self.instances:
            self.trace.begin(instance, None)
            instance.start()
            self.trace.flush()

    def _see(self, line: Line) -> None:
        self.lines.append(line)
        self.watch.see(line)

    def _data(self, actor: Any) -> Any:
        return self.instances[self.cast.index(actor)].data

    # ---- the world of the engine

    @property
    def time(self) -> int:
        return self.clock.now

    def schedule(self, delay: int, action: Callable[[], None]) -> Any:
        self.delays.append(action)
        return action

    def unschedule(self, handle: Any) -> None:
        self.delays.remove(handle)

    def start(self, run: Run) -> None:
        self.runs.append(run)

    def cancel(self, run: Run) -> None:
        self.runs.remove(run)
        run.end("preempted")

    def send(self, instance: InstanceLike, event: Event) -> None:
        at = next(n for n, each in enumerate(self.instances) if each is instance)
        source = self.cast[at].robot
        for number, other in enumerate(self.instances):
            robot = self.cast[number].robot
            if number == at or not robot.is_meant_by(event.envelope.to):
                continue
            ended = not other.running
            if ended or not self.cast[number].listens(event.name):
                continue
            if sum(name == event.name for name, _, _ in self.bags[number]) < self.capacity:
                self.bags[number].append((event.name, event.data, source.name or ""))

    def failed(self, instance: InstanceLike, error: Exception) -> None:
        pass

    # ---- choices

    def choices(self, outside: Sequence[str]) -> Iterator[Choice]:
        for number, run in enumerate(self.runs):
            for result in ({"ok": False}, {"ok": True}):
                yield ("end", number, "succeeded", result)
            yield ("end", number, "aborted", None)
            yield ("end", number, "preempted", None)
            del run
        for number in range(len(self.delays)):
            yield ("delay", number)
        for number, instance in enumerate(self.instances):
            if instance.running:
                for name in outside:
                    if self.cast[number].listens(name):
                        for data in ({},) if name in ("Go", "Tick") else ({"word": 0}, {"word": 1}):
                            yield ("outside", number, name, data)
                for message in range(len(self.bags[number])):
                    yield ("hear", number, message)

    def losses(self, faults: int) -> list[Choice]:
        if len(self.lost) >= faults:
            return []
        return [("lose", n) for n, a in enumerate(self.cast) if a.robot.name not in self.lost]

    def pass_time(self) -> None:
        """Let time pass at a choice."""
        self.clock.now += 1

    def take(self, choice: Choice) -> None:
        self.pass_time()
        match choice:
            case ("end", number, outcome, result):
                run = self.runs.pop(number)
                call = self.system.function(run.activity.name).communication
                data = None
                if outcome == "succeeded":
                    data = {**default_result(call, self.system), **(result or {})}
                run.end(outcome, data)
            case ("delay", number):
                self.delays.pop(number)()
            case ("outside", number, name, data):
                self._receive(number, name, data, "")
            case ("hear", number, message):
                name, data, sender = self.bags[number].pop(message)
                self._receive(number, name, data, sender)
            case ("lose", number):
                self._lose(number)
            case ("drop", number, message):
                self.bags[number].pop(message)
        self.trace.flush()
        for bag, instance in zip(self.bags, self.instances, strict=True):
            if not instance.running:
                bag.clear()

    def _receive(self, number: int, name: str, data: Any, sender: str) -> None:
        envelope = Envelope(sender)
        if name == DEPARTED:
            self.rosters[number].note(name, data)
        self.trace.begin(self.instances[number], name, data, envelope)
        self.instances[number].receive(Event(name, data, envelope=envelope))

    def _lose(self, number: int) -> None:
        """Stop a robot, as the world of simulations does."""
        instance, robot = self.instances[number], self.cast[number].robot
        self.lost.append(robot.name)
        self.runs = [run for run in self.runs if run.instance is not instance]
        self.delays = [d for d in self.delays if d.__self__.instance is not instance]
        if instance.running:
            self.trace.begin(instance, LOST)
            instance.running = False
            self.trace.flush()
        follows = following(self.system)
        for other, actor in enumerate(self.cast):
            if other != number and actor.machine.name in follows:
                told = {"id": robot.name, "role": robot.role}
                self.bags[other].append((DEPARTED, told, ""))

    @property
    def key(self) -> tuple[str, str]:
        """All that decides on what can happen from now on, and on what the monitors say."""
        return self.place, repr(self.memories)

    @property
    def memories(self) -> dict[str, list[Any]]:
        """Memory of the monitors of each property."""
        return {
            watched.rule.property.name: [
                (*state.monitor.memory[1:], state.is_violated) for state in watched.states.values()
            ]
            for watched in self.watch._watched
        }

    @property
    def place(self) -> str:
        """All that decides on what can happen from now on."""
        parts = []
        for number, instance in enumerate(self.instances):
            runs = sorted(run.state for run in self.runs if run.instance is instance)
            delays = sorted(
                d.__self__.event.name for d in self.delays if d.__self__.instance is instance
            )
            data = instance.data if instance.running else {}
            data = {name: value for name, value in data.items() if name != PRESENT}
            bag = sorted(repr(each[:2]) for each in self.bags[number])
            waiting = [each.name for each in instance._deferred or ()]
            config = instance.configuration
            parts.append(
                (config.active, config.histories, instance.final, runs, delays, bag, waiting)
            )
            roster = self.rosters[number]
            parts.append([each.robot.name for each in self.cast if roster.misses(each.robot)])
            parts.append(repr(sorted(data.items(), key=lambda item: item[0])))
        return repr((parts, sorted(map(str, self.lost))))

    def violated(self, *, ended: bool) -> set[str]:
        """Properties that the run violates; with `ended`, also if nothing happens any more."""
        found = {
            each.property.name
            for each in self.watch.violations
            if self._counts(each.property, [each.robot])
        }
        if ended:
            results = self.watch.results(self.clock.now, ended=True)
            found |= {
                each.property.name
                for each in results
                if each.verdict == FALSE and self._counts(each.property, each.robots)
            }
        return found

    def _counts(self, property_: Any, robots: Sequence[str | None]) -> bool:
        """Return False if a property asks only of lost robots what must happen."""
        if property_.each is None or property_.sentence.kind not in _ASKING:
            return True
        if property_.sentence.scope in ("before", "between"):
            return True
        return not set(robots) <= set(self.lost)


def refuted(
    system: System,
    outside: Sequence[str],
    capacity: int,
    most: int,
    *,
    lossy: bool = False,
    faults: int = 0,
) -> set[str] | None:
    """Return the properties that some run violates; None if there are more than `most` states."""
    swarm = system.swarms[0]
    subject = Subject(swarm.name, system, swarm)
    cast = actors(subject, subject.create_robots({}), Scenario(), Diagnostics())

    def play(path: Sequence[Choice]) -> Swarm:
        played = Swarm(cast, watchable(subject), system, capacity)
        for choice in path:
            played.take(choice)
        return played

    first = play(())
    seen = {first.key}
    found = set(first.violated(ended=False))
    queue: deque[tuple[Choice, ...]] = deque([()])
    while queue:
        path = queue.popleft()
        now = play(path)
        choices = list(now.choices(outside))
        if lossy:
            choices += [("drop", n, m) for n, bag in enumerate(now.bags) for m in range(len(bag))]
        losses = now.losses(faults)
        place, memories = now.place, now.memories
        happens = False
        # Properties that see something, though nothing else changes.
        seeing: set[str] = set()
        for choice in (*choices, *losses):
            after = play((*path, choice))
            if choice not in losses:
                ignored = all(line.ignored for line in after.lines[len(now.lines) :])
                happens |= not ignored or after.place != place
                seeing |= {name for name, each in after.memories.items() if each != memories[name]}
            found |= after.violated(ended=False)
            if after.key not in seen:
                seen.add(after.key)
                queue.append((*path, choice))
                if len(seen) > most:
                    return None
        if not happens:
            found |= now.violated(ended=True) - seeing
    return found
