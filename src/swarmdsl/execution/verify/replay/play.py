"""Runs of real robots that a search has found: who does what, and when.

A search knows only how many robots are in which state. Here each gets a name, its machines run on
the engine, and times are found that fit all delays.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from swarmdsl.execution.engine import Envelope, Event
from swarmdsl.execution.monitor import FALSE, LOST, Watch
from swarmdsl.execution.simulate.evaluation.properties import plan
from swarmdsl.execution.simulate.evaluation.properties import watch as watched
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.network.members import DEPARTED
from swarmdsl.execution.simulate.scenario.clock import Clock
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.verify.abstraction.alphabet import Alphabet, Message
from swarmdsl.execution.verify.automata.labels import Move
from swarmdsl.execution.verify.replay.absences import absences
from swarmdsl.execution.verify.replay.copies import Copy, Robot, precedes
from swarmdsl.execution.verify.replay.spurious import ELSEWHERE, NEAR, VIEWS, exceeding
from swarmdsl.execution.verify.replay.times import Beats, Constraint, fitting, in_step, limits
from swarmdsl.execution.verify.robot.body import Body
from swarmdsl.execution.verify.robot.timing import AT_ONCE, Bounds
from swarmdsl.execution.verify.search.run import Loss, Run
from swarmdsl.execution.verify.swarm.groups import Step
from swarmdsl.execution.verify.swarm.network import Network
from swarmdsl.ir import Property


def play(
    network: Network,
    steps: Sequence[Step],
    property_: Property | None = None,
    *,
    is_whole: bool = False,
    ended: bool = True,
) -> Run:
    """Run the steps of a network on the engine.

    The run shows the property, if one is given, to be violated; otherwise that is a flaw. With
    `is_whole`, nothing more is on its way at its end. Unless it has `ended`, it must do so whatever
    follows.
    """
    timeless = Play(network, [0] * (len(steps) + 1), None)
    timeless.run(steps)
    if timeless.departs:
        return Run((), flaw=timeless.departs)
    if timeless.exceeds or (is_whole and timeless.late):
        return Run((), flaw=exceeding(network.capacity, timeless.exceeds or timeless.late))
    if timeless.overtakes:
        return Run((), flaw=f"an event overtakes an earlier one on `{timeless.overtakes}`")
    times = in_step(
        lambda more: fitting(len(steps), [*timeless.constraints(), *more]), timeless.beats()
    )
    if times is None:
        return Run((), flaw=timeless.misfit)
    watch: Watch | None = None
    if property_ is not None:
        watch = watched(plan([property_]), lambda actor: timed.data(actor))
    timed = Play(network, times, watch)
    timed.run(steps)
    if timed.departs:
        return Run((), flaw=timed.departs)
    if watch is not None:
        if not watch.violations and timed.late:
            return Run((), flaw=exceeding(network.capacity, timed.late))
        (result,) = watch.results(times[-1], ended=ended)
        if result.verdict != FALSE:
            return Run((), flaw="the monitor does not see a violation in it")
    return Run(tuple(timed.lines), tuple(timed.lost), tuple(timed.gone), causes=timed.causes)


class Play:
    """The robots of a run, at given times."""

    def __init__(self, network: Network, times: Sequence[int], watch: Watch | None) -> None:
        self.lines: list[Line] = []
        self.lost: list[tuple[int, str, str]] = []
        self.gone: list[Loss] = []
        self.causes: dict[int, int] = {}
        self._arrivals: list[tuple[int, Copy]] = []
        """Messages that arrived, with the numbers of the steps."""
        self._missed: list[tuple[int, Copy]] = []
        """Messages on their way to robots when these stopped, with the numbers of the steps."""
        self.overtakes = ""
        """Topic on which a message overtakes an earlier one."""
        self.exceeds = ""
        """Event of a message beyond the capacity that a later one overtakes."""
        self.departs = ""
        """Reason why robots cannot take the steps that were found, if they cannot."""
        self.misfit = "a delay ends too early or too late in it"
        """Flaw of a run that no times fit."""
        if network.timing is not None:
            self.misfit = "no times of it fit all functions, delays and events"
        self.network = network
        self._alphabet: Alphabet = network.alphabet
        self._times = times
        self._watch = watch
        self.now = 0
        self._sent = 0
        self.robots: list[Robot] = []
        self._bodies: dict[Actor, Body] = {}
        for group in network.groups:
            whole = group.automaton.whole
            for name in group.robots:
                cast = group.cast(name)
                kind = whole.kind
                system = self._alphabet.system
                body = Body(
                    cast, system, Clock(), kind.crew, kind.silent, kind.others, kind.absences
                )
                body.seen = self.see
                self._bodies.update(dict.fromkeys(cast, body))
                first = whole.first.target
                self.robots.append(Robot(name, group, first, body, moments=[0]))
        self.robots.sort(key=lambda robot: robot.order)

    def run(self, steps: Sequence[Step]) -> None:
        """Start all robots and take the steps."""
        for robot in self.robots:
            robot.body.start()
        for robot in self.robots:
            self._send(robot, list(robot.body.sent))
        self.go_on(steps)

    def go_on(self, steps: Sequence[Step]) -> None:
        """Take more steps."""
        for step in steps:
            self.now += 1
            self.take(step)
            if self.departs:
                return

    @property
    def late(self) -> str:
        """Event of a message that has not arrived for lack of capacity, or an empty string."""
        return next((copy.event.name for robot in self.robots for copy in robot.late), "")

    def data(self, actor: Actor) -> Any:
        """Return the variables of a machine."""
        body = self._bodies[actor]
        return body.instances[list(body.cast).index(actor)].data

    def constraints(self, *, slow: bool = False) -> list[Constraint]:
        """Return those of the times of steps; with `slow`, functions may take longer."""
        found: list[Constraint] = []
        last = self.now
        timing = self.network.timing
        for robot in self.robots:
            at = robot.moments
            for delay in robot.body.every_delay:
                began = at[delay.began]
                ended = at[delay.ended] if delay.ended is not None else last
                found.append((began, ended, -delay.length))
                if delay.fired:
                    found.append((ended, began, delay.length))
            for wait in robot.body.waits if timing is not None else ():
                bounds = AT_ONCE
                if timing is not None and wait.function is not None:
                    bounds = timing.function(wait.function, robot.body.cast[0].robot)
                    bounds = (bounds[0], None) if slow else bounds
                ended = at[wait.ended] if wait.ended is not None else last
                found += limits(bounds, at[wait.began], ended, is_over=wait.fired)
            found += absences(robot, self.network.heartbeat, last)
            for copy in (*robot.bag, *robot.late):
                found += limits(self._bounds(copy), copy.sent, last, is_over=False)
        for step, copy in self._missed:
            found += limits(self._bounds(copy), copy.sent, step, is_over=False)
        for step, copy in self._arrivals:
            found += limits(self._bounds(copy), copy.sent, step, is_over=True)
        return found

    def beats(self) -> Beats | None:
        """Return the steps at which robots are lost while others wait for their heartbeats."""
        copies = [copy for _, copy in self._arrivals] + [c for r in self.robots for c in r.bag]
        steps = {c.sent for c in copies if self._message(c).is_heartbeat}
        heartbeat = self.network.heartbeat
        if heartbeat is None or not steps:
            return None
        return Beats(tuple(sorted(steps)), heartbeat.period)

    def _bounds(self, copy: Copy) -> Bounds:
        """Return the times after which a message can arrive."""
        network, message = self.network, self._message(copy)
        if message.is_heartbeat:
            assert network.heartbeat is not None
            return network.heartbeat.timeout, network.heartbeat.timeout
        if network.latencies is None:
            return 0, None
        return network.latencies.message(repeats=message.repeats)

    def take(self, step: Step) -> None:
        """Take a step."""
        group_number, state, bag = self.network.places[step.place]
        group = self.network.groups[group_number]
        robots = [r for r in self.robots if r.group is group and r.is_at(state, bag)]
        if not robots:
            self.departs = ELSEWHERE
            return
        if step.move is None:
            robot = self.chosen(robots)
            lost = self._dropped(robot, step.lost)
            if lost is None:
                self.departs = ELSEWHERE
                return
            robot.bag.remove(lost)
            self.lost.append((len(self.lines), lost.event.name, robot.name or ""))
            return
        given = step.move.given
        event: Event | None = None
        if given.kind == "hear":
            number = given.choice if step.lost is None else step.lost
            robot, copy = self._heard(robots, number)
            robot.bag.remove(copy)
            oldest = self._oldest(robot, copy)
            event = oldest.event
            self._arrivals.append((self.now, oldest))
            if oldest.line is not None:
                self.causes[len(self.lines)] = oldest.line
        else:
            robot = self.chosen(robots)
        self._move(robot, step.move, event)

    def _dropped(self, robot: Robot, number: int | None) -> Copy | None:
        """Return the message that is lost; a reliable one only if its sender is."""
        copies = (
            copy
            for copy in robot.bag
            if copy.number == number
            and (copy.source.body.is_lost or not self._message(copy).reliable)
        )
        return next(copies, None)

    def _message(self, copy: Copy) -> Message:
        return self._alphabet.messages[self._alphabet.number(copy.event)]

    def chosen(self, robots: Sequence[Robot]) -> Robot:
        """Return the robot that takes a step, of those that can."""
        return robots[0]

    def _heard(self, robots: Sequence[Robot], number: int) -> tuple[Robot, Copy]:
        """Return a copy of a message and who hears it; none overtakes another if possible."""
        choices = [(r, c) for r in robots for c in r.bag if c.number == number]
        choices.sort(key=lambda choice: choice[1].order)
        for robot, copy in choices:
            if not self._is_before(robot, copy):
                return robot, copy
        self.overtakes = choices[0][1].topic
        return choices[0]

    def _oldest(self, robot: Robot, copy: Copy) -> Copy:
        """Return the first message of an equal kind, which arrives instead of a later one."""
        equal = [each for each in robot.late if each.number == copy.number]
        found = min((copy, *equal), key=lambda each: each.order)
        if found is not copy:
            robot.late[robot.late.index(found)] = copy
        if any(precedes(each, found) for each in robot.late):
            self.exceeds = self.exceeds or found.event.name
        return found

    def _is_before(self, robot: Robot, copy: Copy) -> bool:
        """Return True if an earlier message of the same channel is still on its way."""
        return any(precedes(other, copy) for other in robot.bag)

    def _move(self, robot: Robot, move: Move, event: Event | None) -> None:
        automaton = robot.group.automaton
        kind = automaton.whole.kind
        found = automaton.follow(robot.state, move)
        robot.moments.append(self.now)
        robot.body.clock.now = self._times[self.now]
        if found.given.kind == "lose":
            self.gone.append(Loss(len(self.lines), robot.name or "", self._times[self.now]))
            if robot.body.crew is not None and robot.body.crew.guesses and not kind.absences:
                self.departs = VIEWS  # All others must take it for lost some time later.
        automaton.whole.apply(robot.body, found.given, event)
        shown = tuple((m.event, m.taken, m.sent) for m in found.moments)
        called = [line.actor.machine.called for line in robot.body.lines]
        real = tuple(
            (line.event, tuple(dict.fromkeys(map(name, line.taken))), tuple(line.sent))
            for line, name in zip(robot.body.lines, called, strict=True)
        )
        if shown != real:
            self.departs = ELSEWHERE
        elif found.supposes:
            self.departs = self.departs or (VIEWS if found.given.kind == "view" else NEAR)
        robot.state = found.target
        if not robot.body.running:
            self._missed += [(self.now, copy) for copy in (*robot.bag, *robot.late)]
            robot.bag.clear()
            robot.late.clear()
        self._send(robot, list(robot.body.sent))

    def _send(self, source: Robot, sent: Sequence[Event]) -> None:
        assert self._alphabet.system is not None
        for event in sent:
            self._sent += 1
            number = self._alphabet.number(event)
            is_heartbeat = self._alphabet.messages[number].is_heartbeat
            topic = "" if is_heartbeat else self._alphabet.system.event(event.name).topic
            for robot in self.robots:
                if robot is source or not robot.body.running:
                    continue
                if not robot.group.hears(number, source.group) and not (
                    robot.group is source.group and robot.group.automaton.whole.listens(number)
                ):
                    continue
                to = event.envelope.to
                if not (to is None or to in (robot.name, robot.group.role)):
                    continue
                real = event
                if not is_heartbeat:
                    envelope = Envelope(source.name or "", event.envelope.sent, to)
                    real = Event(event.name, event.data, envelope=envelope)
                line = self._sending(source, event)
                copy = Copy(number, real, topic, self._sent, line, self.now, source)
                same = [c for c in robot.bag if c.event.name == event.name]
                if is_heartbeat or len(same) < self.network.capacity:
                    robot.bag.append(copy)
                elif self.network.lossy and not self._alphabet.messages[number].reliable:
                    self.lost.append((len(self.lines), event.name, robot.name or ""))
                else:
                    robot.late.append(copy)

    def _sending(self, source: Robot, event: Event) -> int | None:
        """Return the number of the last line on which a robot has sent an event, or was lost."""
        mine = (
            number
            for number in range(len(self.lines) - 1, -1, -1)
            if self.lines[number].actor.robot.name == source.name
        )
        if event.name == DEPARTED:
            return next((n for n in mine if self.lines[n].event == LOST), None)
        return next(n for n in mine if event.name in self.lines[n].sent)

    def see(self, line: Line) -> None:
        """Keep a line, and show it to the monitor."""
        self.lines.append(line)
        if self._watch is not None:
            self._watch.see(line)
