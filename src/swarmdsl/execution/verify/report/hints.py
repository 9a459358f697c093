"""Hints at what could prevent a run: only where the run itself shows what is missing."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl import ir
from swarmdsl.execution.engine import Activity, Kind, Machine, State
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.network.members import DEPARTED, JOINED
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.verify.search.run import Run


def hint(run: Run) -> str | None:
    """Return a hint at a function that does not answer, an ignored event, or a loss unnoticed.

    In a run that goes on for ever, an ignored event may matter to nobody; in one after which
    nothing happens, any of several may. News of who is there matter more than other events.
    """
    if run.loop:
        return None
    unanswered = _unanswered(run) if run.loop is not None else None
    if unanswered is not None:
        return unanswered
    ignored = [each for each in reversed(run.lines) if each.ignored]
    news = [each for each in ignored if each.event in (DEPARTED, JOINED)]
    ignored = news or [each for each in ignored if each.envelope.sender]
    if run.loop is not None and len({(each.actor, each.event) for each in ignored}) > 1:
        return None
    return _handling(ignored[0]) if ignored else _repeating(run)


def _unanswered(run: Run) -> str | None:
    """Return the hint for a function that is called when nothing happens any more."""
    gone = {loss.robot for loss in run.gone}
    last = {line.actor: line for line in run.lines if line.actor.robot.name not in gone}
    for actor, line in last.items():
        for state in _active(line):
            if state.activity is not None and not _ended(run, actor, state.activity):
                who = f"`{actor.name}` waits" if actor.name else "it waits"
                what = f"for `{state.activity.name}`, which may never end"
                return f"{who} in `{state.id}` {what}: add `after` a time there"
    return None


def _ended(run: Run, actor: Actor, activity: Activity) -> bool:
    """Return True if the last call of a function has ended."""
    ended = False
    for line in run.lines:
        if line.actor is actor:
            ended |= line.event in activity.events.values()
            ended &= activity.name not in line.started
    return ended


def _handling(line: Line) -> str:
    """Return the hint for an event of another robot that is ignored."""
    event, where = line.event or "", line.configuration[-1]
    told = f"`{line.actor.name}` ignores `{event}` in `{where}`"
    for state in _active(line):
        for edge in state.transitions:
            origin = edge.origin
            if event in edge.events and isinstance(origin, ir.Transition) and origin.origin:
                place = origin.origin
                return f"{told}: the guard in {place.source.name}:{place.line} is false then"
    return f"{told}: handle it there with `on {event}`, or keep it with `defer {event}`"


def _repeating(run: Run) -> str | None:
    """Return the hint for a lost event whose sender waits without an end."""
    if not run.lost:
        return None
    at, event, receiver = run.lost[-1]
    senders = [line.actor for line in run.lines[:at] if event in line.sent]
    losses = sum(each[1:] == (event, receiver) for each in run.lost)
    if len(set(senders)) not in (1, losses):
        return None
    sender = senders[-1]
    last = next(line for line in reversed(run.lines) if line.actor is sender)
    states = list(_active(last))
    if any(state.kind is Kind.FINAL or _goes_on(state) for state in states):
        return None
    waits = last.configuration[-1]
    return f"`{sender.name}` waits in `{waits}`, though `{event}` is lost: add `after` a time there"


def _active(line: Line) -> Iterator[State]:
    """Yield the states in which a machine is after a line, the inner ones first."""
    machine: Machine = line.actor.machine
    for name in line.configuration:
        place = machine.numbers[name]
        for each in (place, *machine.ancestors(place)):
            yield machine.states[each]


def _goes_on(state: State) -> bool:
    """Return True if something happens by itself in a state."""
    edges = (edge.origin for edge in state.transitions)
    return state.activity is not None or any(
        isinstance(trigger, ir.TimeTrigger)
        for edge in edges
        if isinstance(edge, ir.Transition)
        for trigger in edge.triggers
    )
