"""Timeline of a run: lanes of machines, bars of states, arrows of swarm events."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import groupby
from typing import NamedTuple

from swarmdsl.execution.engine import Machine
from swarmdsl.execution.monitor import LOST
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.network.packets import Transmission
from swarmdsl.execution.simulate.pictures.state_colours import state_colours
from swarmdsl.execution.simulate.pictures.svg import LETTER, Drawing
from swarmdsl.execution.simulate.pictures.timeline_arrows import Crossing, Fate, Scale, draw_arrows
from swarmdsl.execution.simulate.pictures.timeline_legend import HATCHED, MERGED, Legend, Shown
from swarmdsl.execution.simulate.scenario.durations import SECOND, format_duration
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.execution.simulate.world.line import Line

_WIDTH = 1200
"""Width of the time axis."""
_ROW = 18
_GAP = 6
_TOP = 78
_NARROWEST = 0.6
"""Minimum width of a bar; narrower ones are merged."""
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


_Arrival = tuple[str, Robot, int]
"""Event, receiver and time."""
Verdicts = Mapping[str, Sequence[tuple[int, str]]]
"""Verdicts so far of properties by name, each with the time from which on it held."""
# Green, amber and red: Paul Tol, Colour Schemes, as for states.
_VERDICTS = {"true": "#44bb99", "open": "#eedd88", "false": "#ee8866"}


class Timeline:
    """Collect the data of the timeline."""

    def __init__(self, title: str, cast: Iterable[Actor], conditions: str = "") -> None:
        self._title = title
        self._conditions = conditions
        self._lines: dict[Actor, list[Line]] = {actor: [] for actor in cast}
        self._transmissions: list[Transmission] = []
        self._ignored: set[_Arrival] = set()
        self._heeded: set[_Arrival] = set()

    def note(self, line: Line) -> None:
        """Keep a line that changes the configuration, and the fate of its event."""
        if line.event is not None:
            fates = self._ignored if line.ignored else self._heeded
            fates.add((line.event, line.actor.robot, line.time))
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
            (self._title, self._conditions),
            self._lines,
            [Crossing(each, self._fate(each)) for each in self._transmissions],
            max(end, 1),
            verdicts or {},
            remarks or {},
        ).draw()

    def _fate(self, sent: Transmission) -> Fate:
        """Return the fate of an event; it is ignored if all machines of the receiver ignore it."""
        if not sent.arrives:
            return Fate.LOST
        arrival = (sent.event, sent.target, sent.due)
        ignored = arrival in self._ignored and arrival not in self._heeded
        return Fate.IGNORED if ignored else Fate.TAKEN


class _Stay(NamedTuple):
    """Time interval in a state."""

    state: str
    start: int
    end: int


class _Picture:
    def __init__(
        self,
        titles: tuple[str, str],
        lines: dict[Actor, list[Line]],
        crossings: list[Crossing],
        end: int,
        verdicts: Verdicts,
        remarks: Mapping[str, str],
    ) -> None:
        self.verdicts = verdicts
        self.remarks = remarks
        self.title, self.conditions = titles
        self.lines = lines
        self.crossings = crossings
        self.labels: list[tuple[float, float, str]] = []
        self.is_merged = False
        self.end = end
        names = [*map(_name, lines), *verdicts]
        self.left = 32 + 1.15 * LETTER * max(map(len, names), default=0)
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
        drawing = Drawing(self.left + _WIDTH + 24, self.title, self.conditions)
        drawing.text(16, 26, self.title, "title")
        words = [self.conditions] if self.conditions else []
        words.append(format_duration(self.end))
        if len(self.robots) > 1:
            words.append(f"{len(self.robots)} members")
        drawing.text(16, 44, ", ".join(words), "note")
        self.axis(drawing)
        for actor in self.lines:
            self.lane(drawing, actor)
        self.property_lanes(drawing)
        edges = {
            robot: (self.tops[actor], self.tops[actor] + self.rows[actor] * _ROW)
            for robot, actor in self.robots.items()
        }
        bundled = draw_arrows(drawing, self.crossings, Scale(self.x, self.end, edges))
        for x, y, label in self.labels:
            drawing.text(x, y, label, "state")
        legend = Legend(self.shown(bundled), self.left + _WIDTH, self.bottom + 32)
        legend.draw(drawing)
        return drawing.finish(legend.bottom + 12)

    def shown(self, bundled: bool) -> Shown:
        """Return the contents for the legend."""
        entered: dict[Machine, set[str]] = {machine: set() for machine in self.colours}
        for actor, lines in self.lines.items():
            entered[actor.machine].update(*(line.configuration for line in lines))
        lost = any(line.event == LOST for of in self.lines.values() for line in of)
        fates = {each.fate for each in self.crossings}
        return Shown(entered, self.colours, fates, bundled, lost, self.is_merged)

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
                label = next((t for t in (said, verdict) if width > LETTER * (len(t) + 1)), "")
                if label:
                    self.labels.append((self.x(start) + 4, top + _ROW / 2 + 4, label))
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
        colour = HATCHED if lost else self.colours[actor.machine][stay.state]
        state = "lost" if lost else stay.state
        title = f"{_name(actor)}: {state}\n{_between(stay.start, stay.end)}"
        drawing.bar(x, top, width, height, colour, title)
        label = _shortened(state, width - 6)
        if label:
            self.labels.append((x + 4, top + height / 2 + 4, label))

    def blur(self, drawing: Drawing, stays: list[_Stay], top: float, height: float) -> None:
        """Draw several intervals that are too short to see."""
        self.is_merged = True
        start, end = stays[0].start, stays[-1].end
        title = f"{len(stays)} short stays\n{_between(start, end)}"
        width = max(self.x(end) - self.x(start), _NARROWEST)
        drawing.bar(self.x(start), top, width, height, MERGED, title)


def _name(actor: Actor) -> str:
    return actor.name or actor.machine.name


def _shortened(state: str, width: float) -> str:
    """Shorten a name to fit: the whole, its last segment, or its first letters."""
    room = int(width / LETTER)
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
