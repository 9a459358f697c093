"""Runs as text: a line a step, with the data that matter, and the place in the model."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence

from swarmdsl.base.diagnostics.collector import Label, listed
from swarmdsl.base.diagnostics.render import counted
from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.base.source import Span
from swarmdsl.execution.monitor import LOST
from swarmdsl.execution.simulate.world.line import Line, as_text
from swarmdsl.execution.verify.findings.reached import transitions_of
from swarmdsl.execution.verify.search.run import Run

_MOST_LINES = 40
"""Maximum number of lines of a run in a diagnostic."""
_MOST_FIELDS = 4
"""Maximum number of fields of a message on a line."""

Fields = Callable[[str], Sequence[tuple[str, ...]]]
"""The fields of an event that decide on anything, as paths."""


def run_text(run: Run, size: str, fields: Fields) -> Iterator[str]:
    """Yield the lines of a run of a swarm of some size."""
    yield _head(run, size)
    yield from _lines(run, fields)


def _head(run: Run, size: str) -> str:
    if run.loop:
        return f"a run that goes on for ever, of {size}:"
    return f"a shortest run, of {size}:" if run.shortest else f"a run, of {size}:"


def _lines(run: Run, fields: Fields) -> Iterator[str]:
    """Format the steps of a run, with the places of their transitions."""
    width = max((len(line.actor.name or "") for line in run.lines), default=0)
    again = len(run.lines) - run.loop if run.loop else None
    told = list(enumerate(run.lines))
    if len(told) > _MOST_LINES:
        busy = {line.actor.robot for line in run.lines if line.event is not None or line.sent}
        told = [each for each in told if each[1].actor.robot in busy]
        rest = len({line.actor.robot for line in run.lines} - busy)
        if rest:
            yield f"{counted(rest, 'robot')} only start, and are left out here"
    for number, line in told[:_MOST_LINES]:
        if number == again:
            yield "from here on, again and again:"
        yield from _losses(run, number)
        yield from _quiet_losses(run, number)
        place = _place_of(line)
        about = list(_data(line, fields))
        if line.envelope.sender:
            about.append(f"from {line.envelope.sender}")
        if place is not None:
            about.append(f"{printable(place.source.name)}:{place.line}")
        where = f"  ({', '.join(about)})" if about else ""
        yield f"{as_text(line, width)}{where}"
    if len(told) > _MOST_LINES:
        yield f"... and {len(told) - _MOST_LINES} more"
    else:
        yield from _losses(run, len(run.lines))
        yield from _quiet_losses(run, len(run.lines))
        if run.loop == 0:
            yield f"nothing happens{_to_whom(run)} any more"


def _data(line: Line, fields: Fields) -> Iterator[str]:
    """Format the numbers, texts and truth values of an event that decide on anything."""
    shown = []
    for path in fields(line.event) if line.event and line.data else ():
        value = line.data
        for name in path:
            value = value.get(name) if isinstance(value, dict) else None
        match value:
            case bool() | str():
                shown.append(f"{'.'.join(path)} = {json.dumps(value, ensure_ascii=False)}")
            case int() | float():
                shown.append(f"{'.'.join(path)} = {value:g}")
    yield from shown[:_MOST_FIELDS]
    if len(shown) > _MOST_FIELDS:
        yield "..."


def _to_whom(run: Run) -> str:
    """Name the robots of a run: others, of which these hear nothing, may go on."""
    names = [name for name in dict.fromkeys(line.actor.robot.name for line in run.lines) if name]
    if not names:
        return ""
    return f" to {listed(names, 'and') if len(names) <= 3 else 'these robots'}"


def _quiet_losses(run: Run, number: int) -> Iterator[str]:
    """Format the losses of robots that have no line: of those whose machines have ended."""
    for loss in run.gone:
        lines = run.lines[loss.at : loss.at + 1]
        is_told = any(each.event == LOST and each.actor.robot.name == loss.robot for each in lines)
        if loss.at == number and not is_told:
            yield f"{loss.robot or 'the robot'} is lost"


def _losses(run: Run, number: int) -> Iterator[str]:
    """Format the messages that are lost after some lines of a run."""
    return (f"{event} to {robot} is lost" for at, event, robot in run.lost if at == number)


def _place_of(line: Line) -> Span | None:
    """Return the place of the first transition of a line."""
    known = transitions_of(line.actor.machine)
    called = line.actor.machine.called
    found = (known[called(each)].origin for each in line.taken if called(each) in known)
    return next(found, None)


def last_taken(run: Run, told: Span | None = None, robot: str | None = None) -> Iterator[Label]:
    """Yield the place of the last transition of a run, of the given robot if it has taken one."""
    taken = [
        (line, place) for line in reversed(run.lines) if (place := _place_of(line)) is not None
    ]
    own = [each for each in taken if each[0].actor.robot.name == robot]
    for _, place in (own or taken)[:1]:
        if place != told:
            whose = f"of `{robot}` in" if robot is not None and own else "of"
            yield Label(place, f"the last transition {whose} the run")
