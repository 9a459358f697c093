"""Timeline of a run: lanes of machines, bars of states, arrows of swarm events."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import groupby
from typing import NamedTuple

from swarmdsl.execution.engine import Machine
from swarmdsl.execution.monitor import LOST
from swarmdsl.execution.simulate.actors import Actor
from swarmdsl.execution.simulate.durations import SECOND, format_duration
from swarmdsl.execution.simulate.packets import Transmission
from swarmdsl.execution.simulate.scenario import Robot
from swarmdsl.execution.simulate.state_colours import state_colours
from swarmdsl.execution.simulate.svg import Drawing
from swarmdsl.execution.simulate.trace import Line

_WIDTH = 1200
"""Width of the time axis."""
_ROW = 18
_GAP = 6
_TOP = 78
_LETTER = 6.2
"""Average width of a letter."""
_NARROWEST = 0.6
"""Minimum width of a bar; narrower ones are merged."""
_MOST_ARROWS = 2000
_STEPS = tuple(
    SECOND * each
    for each in (
        0.1,
        0.2,
        0.5,
        1,
        2,
        5,
        10,
        15,
        30,
        60,
        120,
        300,
        600,
        900,
        1800,
        3600,
        7200,
        21600,
    )
)
_TICKS = 12


Verdicts = Mapping[str, Sequence[tuple[int, str]]]
"""Verdicts so far of properties by name, each with the time from which on it held."""
# Green, amber and red: Paul Tol, Colour Schemes, as for states.
_VERDICTS = {"true": "#44bb99", "open": "#eedd88", "false": "#ee8866"}


class Timeline:
    """Collect the data of the timeline."""

    def __init__(self, title: str, cast: Iterable[Actor]) -> None:
        self._title = title
        self._lines: dict[Actor, list[Line]] = {actor: [] for actor in cast}
        self._transmissions: list[Transmission] = []

    def note(self, line: Line) -> None:
        """Keep a line that changes the configuration."""
        lines = self._lines[line.actor]
        if not lines or line.event == LOST or line.configuration != lines[-1].configuration:
            lines.append(line)

    def transmitted(self, crossing: Transmission) -> None:
        """Keep a swarm event in transit."""
        self._transmissions.append(crossing)

    def svg(
        self,
        end: int,
        verdicts: Verdicts | None = None,
        remarks: Mapping[str, str] | None = None,
    ) -> str:
        """Draw a run of the given duration, with a lane for each property.

        `remarks` by property explain verdicts at the end.
        """
        return _Picture(
            self._title,
            self._lines,
            self._transmissions,
            max(end, 1),
            verdicts or {},
            remarks or {},
        ).draw()


class _Stay(NamedTuple):
    """Time interval in a state."""

    state: str
    start: int
    end: int


class _Picture:
    def __init__(
        self,
        title: str,
        lines: dict[Actor, list[Line]],
        transmissions: list[Transmission],
        end: int,
        verdicts: Verdicts,
        remarks: Mapping[str, str],
    ) -> None:
        self.verdicts = verdicts
        self.remarks = remarks
        self.title = title
        self.lines = lines
        self.transmissions = transmissions
        self.end = end
        names = [*map(_name, lines), *verdicts]
        self.left = 32 + 1.15 * _LETTER * max(map(len, names), default=0)
        self.rows = {
            actor: max((len(line.configuration) for line in of), default=1) or 1
            for actor, of in lines.items()
        }
        self.tops: dict[Actor, float] = {}
        top = float(_TOP)
        for robot, actors in groupby(lines, key=lambda actor: actor.robot):
            for actor in actors:
                self.tops[actor] = top
                top += self.rows[actor] * _ROW + (2 if actor.robot is robot else _GAP)
            top += _GAP
        self.properties_top = top
        self.bottom = top + len(verdicts) * (_ROW + 2) + (_GAP if verdicts else 0)
        self.robots: dict[Robot, Actor] = {}
        for actor in lines:
            self.robots.setdefault(actor.robot, actor)
        self.colours = {
            machine: state_colours(machine)
            for machine in dict.fromkeys(actor.machine for actor in lines)
        }

    def draw(self) -> str:
        drawing = Drawing(self.left + _WIDTH + 24, self.bottom + 40 + self.legend_height())
        drawing.text(16, 26, self.title, "title")
        words = [format_duration(self.end)]
        if len(self.robots) > 1:
            words.append(f"{len(self.robots)} members")
        if self.transmissions:
            words.append("arrows are swarm events, crosses are lost ones")
        if len(self.transmissions) > _MOST_ARROWS:
            words.append(f"the first {_MOST_ARROWS} of {len(self.transmissions)} are drawn")
        drawing.text(16, 44, ", ".join(words), "note")
        self.axis(drawing)
        for actor in self.lines:
            self.lane(drawing, actor)
        self.property_lanes(drawing)
        self.arrows(drawing)
        self.legend(drawing)
        return drawing.finish()

    def x(self, time: float) -> float:
        return self.left + _WIDTH * time / self.end

    def axis(self, drawing: Drawing) -> None:
        """Draw grid lines at round times, labelled above and below."""
        step = next((s for s in _STEPS if self.end / s <= _TICKS), self.end / _TICKS)
        number = 0
        while number * step <= self.end:
            x = self.x(number * step)
            drawing.line(x, _TOP - 8, x, self.bottom, "tick")
            label = _clock(number * step, step)
            drawing.text(x, _TOP - 13, label, "time")
            drawing.text(x, self.bottom + 13, label, "time")
            number += 1

    def lane(self, drawing: Drawing, actor: Actor) -> None:
        """Draw the name and the states of a machine."""
        top, height = self.tops[actor], self.rows[actor] * _ROW
        drawing.text(self.left - 8, top + height / 2 + 4, _name(actor), "member")
        drawing.rect(self.left, top, _WIDTH, height, "lane")
        for (number, count), stays in self.stays(actor).items():
            slot = height / count
            narrow: list[_Stay] = []
            for stay in stays:
                if self.x(stay.end) - self.x(stay.start) < _NARROWEST:
                    narrow.append(stay)
                    if self.x(stay.end) - self.x(narrow[0].start) < _NARROWEST:
                        continue
                if narrow:
                    self.blur(drawing, narrow, top + number * slot, slot)
                if not narrow or narrow[-1] is not stay:
                    self.bar(drawing, actor, stay, top + number * slot, slot)
                narrow = []
            if narrow:
                self.blur(drawing, narrow, top + number * slot, slot)

    def property_lanes(self, drawing: Drawing) -> None:
        """Draw the verdicts so far on each property."""
        top = self.properties_top
        for name, changes in self.verdicts.items():
            drawing.text(self.left - 8, top + _ROW / 2 + 4, name, "member")
            drawing.rect(self.left, top, _WIDTH, _ROW, "lane")
            ends = [*(time for time, _ in changes[1:]), self.end]
            for (start, verdict), end in zip(changes, ends, strict=True):
                width = max(self.x(end) - self.x(start), _NARROWEST)
                remark = self.remarks.get(name) if end == self.end else None
                said = f"{verdict}, but {remark}" if remark else verdict
                title = f"{name}: {said}\n{_between(start, end)}"
                drawing.bar(self.x(start), top, width, _ROW, _VERDICTS[verdict], title)
                label = next((t for t in (said, verdict) if width > _LETTER * (len(t) + 1)), "")
                if label:
                    drawing.text(self.x(start) + 4, top + _ROW / 2 + 4, label, "state")
            top += _ROW + 2

    def stays(self, actor: Actor) -> dict[tuple[int, int], list[_Stay]]:
        """Return the intervals by row of the lane: one row per parallel state.

        A row is the index of the state and the number of parallel states.
        """
        found: dict[tuple[int, int], list[_Stay]] = {}
        lines = self.lines[actor]
        for number, line in enumerate(lines):
            end = lines[number + 1].time if number + 1 < len(lines) else self.end
            states = [LOST] if line.event == LOST else line.configuration
            for place, state in enumerate(states):
                stays = found.setdefault((place, len(states)), [])
                if stays and (stays[-1].end, stays[-1].state) == (line.time, state):
                    stays[-1] = _Stay(state, stays[-1].start, end)
                else:
                    stays.append(_Stay(state, line.time, end))
        return found

    def bar(self, drawing: Drawing, actor: Actor, stay: _Stay, top: float, height: float) -> None:
        """Draw one interval in a state."""
        x, width = self.x(stay.start), self.x(stay.end) - self.x(stay.start)
        lost = stay.state == LOST
        colour = "url(#lost)" if lost else self.colours[actor.machine][stay.state]
        state = "lost" if lost else stay.state
        title = f"{_name(actor)}: {state}\n{_between(stay.start, stay.end)}"
        drawing.bar(x, top, width, height, colour, title)
        label = _shortened(state, width - 6)
        if label:
            drawing.text(x + 4, top + height / 2 + 4, label, "state")

    def blur(self, drawing: Drawing, stays: list[_Stay], top: float, height: float) -> None:
        """Draw several intervals that are too short to see."""
        start, end = stays[0].start, stays[-1].end
        title = f"{len(stays)} short stays\n{_between(start, end)}"
        width = max(self.x(end) - self.x(start), _NARROWEST)
        drawing.bar(self.x(start), top, width, height, "#8a8f98", title)

    def arrows(self, drawing: Drawing) -> None:
        """Draw swarm events between robots."""
        for each in self.transmissions[:_MOST_ARROWS]:
            if each.source not in self.robots or each.target not in self.robots:
                continue
            source, target = self.robots[each.source], self.robots[each.target]
            down = self.tops[target] > self.tops[source]
            start = self.tops[source] + (self.rows[source] * _ROW if down else 0)
            end = self.tops[target] + (0 if down else self.rows[target] * _ROW)
            time = format_duration(each.sent)
            address = f" to {each.to}" if each.to is not None else ""
            words = f"{each.event}{address}: {each.source.name} -> {each.target.name}, {time}"
            x, to = self.x(each.sent), self.x(min(each.due, self.end))
            if each.arrives:
                drawing.arrow(x, start, to, end, words)
            else:
                drawing.lost(x, start, to, end, f"{words}, lost")

    def legend(self, drawing: Drawing) -> None:
        """Draw the legend, at least one line per machine."""
        for x, y, machine, state in self.legend_items():
            if state is None:
                drawing.text(16, y + 10, machine.name, "machine")
                continue
            drawing.bar(x, y, 11, 11, self.colours[machine][state], state)
            drawing.text(x + 16, y + 10, state, "legend")

    def legend_items(self) -> list[tuple[float, float, Machine, str | None]]:
        """Lay out the legend: machines and their entered states."""
        seen = {
            (actor.machine, state)
            for actor, lines in self.lines.items()
            for line in lines
            for state in line.configuration
        }
        indent = 32 + 1.15 * _LETTER * max((len(of.name) for of in self.colours), default=0)
        found: list[tuple[float, float, Machine, str | None]] = []
        y = self.bottom + 32
        for machine in self.colours:
            found.append((16, y, machine, None))
            x = indent
            for state in self.colours[machine]:
                if (machine, state) not in seen:
                    continue
                width = 34 + _LETTER * len(state)
                if x + width > self.left + _WIDTH and x > indent:
                    x, y = indent, y + _ROW
                found.append((x, y, machine, state))
                x += width
            y += _ROW + 4
        return found

    def legend_height(self) -> float:
        items = self.legend_items()
        return items[-1][1] - self.bottom if items else 0.0


def _name(actor: Actor) -> str:
    return actor.name or actor.machine.name


def _shortened(state: str, width: float) -> str:
    """Shorten a name to fit: the whole, its last segment, or its first letters."""
    room = int(width / _LETTER)
    last = state.rpartition(".")[2]
    if len(last) <= room:
        return last
    return f"{last[: room - 1]}\N{HORIZONTAL ELLIPSIS}" if room >= 4 else ""


def _clock(time: float, step: float) -> str:
    """Format a time of the axis."""
    if step < SECOND:
        return f"{time / SECOND:.1f} s"
    seconds = round(time / SECOND)
    if step < 60 * SECOND and seconds < 60:
        return f"{seconds} s"
    hours, minutes, seconds = seconds // 3600, seconds // 60 % 60, seconds % 60
    return f"{hours}:{minutes:02}:{seconds:02}" if hours else f"{minutes}:{seconds:02}"


def _between(start: int, end: int) -> str:
    return f"{format_duration(start)} to {format_duration(end)}: {format_duration(end - start)}"
