"""Environment of the robots of a proof: ends of functions, events from outside, and losses."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from swarmdsl import ir
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import COMMAND_LINE, Source, Span
from swarmdsl.base.suggest import suggest
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.scenario.scenario import (
    EVERY_FUNCTION,
    Fault,
    Message,
    Robot,
    Scenario,
    is_selected,
)
from swarmdsl.execution.verify.abstraction.demands import Demands
from swarmdsl.execution.verify.abstraction.doubt import Doubt
from swarmdsl.execution.verify.abstraction.representatives import Values
from swarmdsl.execution.verify.robot.timing import Timing

_MOST_ONCE = 4
"""Number of events that come once, up to which it is followed which of them have come."""
_NEARLY_SURE = 1 - 1e-9
"""Sum of probabilities from which on nothing else happens: they are rounded."""


@dataclass(frozen=True)
class Options:
    """Conditions of proofs: the network, losses of robots, silent functions, and a scenario.

    At most `faults` robots are lost; None is what the scenario says. Functions that are `silent`
    may never answer. Times count for `within`, and for all runs if time is `exact`: those of
    the scenario, or of one of which nothing else counts.
    """

    capacity: int = 2
    lossy: bool = False
    faults: int | None = None
    silent: tuple[str, ...] = ()
    scenario: Scenario | None = None
    times: Scenario | None = None
    exact: bool = False

    @property
    def timing(self) -> Timing:
        """Times that runs must fit where time counts."""
        return Timing(self.times or self.scenario or Scenario(), self.lossy, self.silent)


def check_silent(functions: Iterable[str], system: ir.System, report: Diagnostics) -> None:
    """Report names of functions that may never answer, but are not there."""
    known = [each.name for each in system.functions]
    for name in functions:
        if name not in known:
            text = f"--never {name}"
            place = Span(Source(COMMAND_LINE, text), len(text) - len(name), len(text))
            help_ = suggest(name, known, "functions")
            report.report("unresolved-name", place, kind="function", name=name, help=help_)


class Ends(NamedTuple):
    """Ends of a function: results of success, and other outcomes; one may never answer."""

    results: Sequence[Mapping[str, Any]]
    others: tuple[str, ...]
    is_silent: bool


@dataclass
class Arrivals:
    """Messages from outside by event, with the numbers of those that come once."""

    messages: dict[str, Sequence[Any]] = field(default_factory=dict)
    once: dict[str, frozenset[int]] = field(default_factory=dict)


class Environment:
    """Ends of functions, losses, and events that can reach the robots of a swarm from outside.

    `said` are conditions on data, `outside` the events from outside. Where robots have places,
    functions that move them end in any way, and are `moving`.
    """

    def __init__(
        self,
        system: ir.System,
        demands: Demands,
        options: Options,
        robots: Sequence[Robot],
        sends: Callable[[Iterable[str]], Iterable[ir.Send]],
        *,
        has_places: bool,
    ) -> None:
        self.said: dict[str, None] = {}
        self.outside: dict[str, None] = {}
        self.moving: dict[str, None] = {}
        self._has_places = has_places
        self._system = system
        self._demands = demands
        self._options = options
        self._scenario = options.scenario
        self._sends = sends
        lost = [each for each in self._faults if each.is_loss]
        self._losable: set[str | None] = {robot.name for robot in robots}
        self.faults = options.faults or 0
        """Number of robots that can be lost."""
        if options.faults is None:
            chosen = [r for r in robots if any(is_selected(r, each.of) for each in lost)]
            self._losable = {robot.name for robot in chosen}
            self.faults = len(chosen)
        self.guesses = any(each.apart for each in self._faults) or (
            options.faults is None and any(each.lasts is not None for each in lost)
        )
        """True if robots can lose sight of others that are there, or are there again."""
        self.is_deaf = self._scenario is not None and self._scenario.loss >= 1
        self.guesses |= self.is_deaf
        self.is_cut = self.is_deaf or any(f.apart and f.lasts is None for f in self._faults)
        """True if an event that is sent again and again may never arrive."""
        self.lossy = options.lossy or any(each.apart for each in self._faults)
        if self._scenario is not None:
            self.lossy |= self._scenario.loss > 0

    @property
    def _faults(self) -> Sequence[Fault]:
        return self._scenario.faults if self._scenario is not None else ()

    @property
    def named(self) -> set[str]:
        """Robots that a scenario treats otherwise than the rest of their role."""
        scenario = self._scenario
        if scenario is None:
            return set()
        words = [*scenario.params, *(word for _, word in scenario.functions)]
        for each in scenario.messages:
            words += each.to or ()
        for fault in scenario.faults:
            words += fault.of or ()
        return {word.partition(".")[0] for word in words if "[" in word}

    def can_be_lost(self, robot: Robot) -> bool:
        """Return True if a robot can be lost."""
        return self.faults > 0 and robot.name in self._losable

    def absences(self, robot: Robot) -> tuple[int, ...]:
        """Return how long a robot is lost each time; nothing if it does not come back."""
        if self._options.faults is not None:
            return ()
        mine = [each for each in self._losses_of(robot) if each.lasts is not None]
        return tuple(f.lasts for f in sorted(mine, key=lambda f: f.at.bounds[0]) if f.lasts)

    def key(self, robot: Robot, functions: Iterable[str], events: Iterable[str]) -> str:
        """Return what tells a robot from others: what can happen to it."""
        if self._scenario is None:
            return str(self.can_be_lost(robot))
        absences = self.absences(robot)
        behaviors = [
            (self._scenario.behavior(f, robot), self._falls_silent(f, robot)) for f in functions
        ]
        messages = [list(self._messages(event, robot)) for event in events]
        return repr((self.can_be_lost(robot), behaviors, messages, absences))

    def ends(self, function: str, robot: Robot, doubts: list[Doubt]) -> Ends:
        """Return how a function of a robot can end."""
        call = self._system.function(function).communication
        others: tuple[str, ...] = ("aborted",)
        if call.paradigm == "action":
            others = ("aborted", "preempted")
        silent = function in self._options.silent or self._falls_silent(function, robot)
        if self._scenario is None or self._is_moving(function, robot):
            return Ends(self.noted(self._demands.results(function), doubts), others, silent)
        behavior = self._scenario.behavior(function, robot)
        shares = {"aborted": behavior.aborted, "preempted": behavior.preempted}
        if sum(shares.values()) + behavior.never >= _NEARLY_SURE:
            results: Sequence[Mapping[str, Any]] = ()
        else:
            found = behavior.results
            results = found or self.noted(self._demands.results(function), doubts)
        others = tuple(outcome for outcome, share in shares.items() if share > 0)
        return Ends(results, others, silent or behavior.never > 0)

    def arrivals(self, cast: Sequence[Actor], doubts: list[Doubt], *, is_alone: bool) -> Arrivals:
        """Return the messages that a robot gets from outside."""
        found = Arrivals()
        from_inside = self._from_inside(cast, is_alone=is_alone)
        for event in self._system.events:
            name = event.name
            if not any(actor.listens(name) for actor in cast) or event.predefined:
                continue
            if self._scenario is not None:
                self._arrive(name, cast[0].robot, found)
            elif event.operator or name not in from_inside:
                found.messages[name] = self.noted(self._demands.messages(name), doubts)
            if name in found.messages:
                self.outside[name] = None
                doubts += self._demands.sender_of(name)
        return found

    def doubts(self, cast: Sequence[Actor]) -> Iterator[Doubt]:
        """Yield what a scenario says of a robot and proofs do not cover."""
        robot = cast[0].robot
        if self._scenario is None:
            return
        for message in self._scenario.messages:
            if message.sender and is_selected(robot, message.to):
                yield Doubt(f"`{message.event}` in the name of `{message.sender}` is not covered")
            elif self._system.event(message.event).predefined:
                yield Doubt(f"`{message.event}` from the scenario is not covered")
        absences = self.absences(robot)
        if not absences:
            return
        name = robot.name or "the robot"
        if len(absences) < len(list(self._losses_of(robot))):
            yield Doubt(f"`{name}` comes back from some losses only: give each of them `lasts`")
        _, most = self._options.timing.message(repeats=False)
        if most is None or most >= min(absences):
            # What is on its way to it arrives when it is back.
            yield Doubt(f"`{name}` is back before events arrive: shorten `latency`, or let it last")
        for event in self._system.events:
            is_kept = event.swarm and event.delivery is not None and event.delivery.latest
            if is_kept and any(actor.listens(event.name) for actor in cast):
                yield Doubt(f"`{event.name}` is sent again to robots that come back", event.origin)

    def noted(self, found: Values, doubts: list[Doubt]) -> Sequence[dict[str, Any]]:
        """Return representatives; keep what is said of them."""
        doubts += found.doubts
        self.said.update(dict.fromkeys(found.conditions))
        return found.values

    # ---- internal

    def _losses_of(self, robot: Robot) -> Iterator[Fault]:
        yield from (f for f in self._faults if f.is_loss and is_selected(robot, f.of))

    def _is_moving(self, function: str, robot: Robot) -> bool:
        """Return True if a function ends as its model does, which says how a robot moves."""
        if self._scenario is None or not self._has_places:
            return False
        said = self._scenario.model(function, robot)
        known = self._system.function(function).model if said is None else said.model
        if known is not None:
            self.moving[function] = None
        return known is not None

    def _falls_silent(self, function: str, robot: Robot) -> bool:
        return any(
            fault.function in (function, EVERY_FUNCTION) and is_selected(robot, fault.of)
            for fault in self._faults
            if fault.function is not None
        )

    def _messages(self, event: str, robot: Robot) -> Iterator[Message]:
        """Yield the messages of the scenario that a robot gets."""
        for message in self._scenario.messages if self._scenario is not None else ():
            is_for = is_selected(robot, message.to) and not message.sender
            if message.event == event and is_for:
                yield message

    def _arrive(self, event: str, robot: Robot, found: Arrivals) -> None:
        messages = list(self._messages(event, robot))
        if not messages:
            return
        found.messages[event] = [message.data for message in messages]
        once = frozenset(n for n, message in enumerate(messages) if message.every is None)
        if len(once) + sum(map(len, found.once.values())) <= _MOST_ONCE:
            found.once[event] = once

    def _from_inside(self, cast: Sequence[Actor], *, is_alone: bool) -> set[str]:
        """Return the events that a robot gets from its own machines, or from other robots.

        Other robots send the swarm events of a machine alone: for it, they come from outside.
        """
        system = self._system
        own = {send.event for send in self._sends(actor.machine.name for actor in cast)}
        others = {s.event for s in self._sends(()) if system.event(s.event).swarm}
        if is_alone:
            own, others = own - others, set()
        topics = {system.event(name).topic for name in own}
        return own | others | {e.name for e in system.events if e.incoming_topic in topics}
