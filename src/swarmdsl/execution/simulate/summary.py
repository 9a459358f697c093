"""Summary of a run: state times, function outcomes, coverage."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from swarmdsl.base.diagnostics.render import counted
from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.execution.engine import Kind, Machine
from swarmdsl.execution.simulate.actors import Actor
from swarmdsl.execution.simulate.coverage import Coverage
from swarmdsl.execution.simulate.durations import format_duration
from swarmdsl.execution.simulate.subject import Subject
from swarmdsl.execution.simulate.trace import Line
from swarmdsl.execution.simulate.world import LOST, World

_MOST = 20
_OUTCOMES = ("succeeded", "aborted", "preempted", "cancelled")
Row = Sequence[str]


class Summary:
    """Collect statistics from trace lines."""

    def __init__(self, subject: Subject, cast: Iterable[Actor]) -> None:
        self._subject = subject
        self._cast = list(cast)
        self._machines = list(dict.fromkeys(actor.machine for actor in self._cast))
        self._last: dict[Actor, Line] = {}
        self._since: dict[Actor, int] = {}
        self._running: Counter[Machine] = Counter()
        self._times: Counter[tuple[Machine, str]] = Counter()
        self._entered: Counter[tuple[Machine, str]] = Counter()
        self._coverage = Coverage()
        for machine in self._machines:
            self._coverage.count(machine)
        self._called: Counter[str] = Counter()
        self._sent: Counter[str] = Counter()

    def note(self, line: Line) -> None:
        """Process a trace line."""
        actor = line.actor
        before = self._last.get(actor)
        if before is not None:
            self._pass(before, line.time)
        self._last[actor] = line
        if before is None or line.entered or line.exited or line.event == LOST:
            self._since[actor] = line.time
        for state in line.entered:
            self._entered[actor.machine, state] += 1
        self._coverage.see(line)
        self._called.update(line.started)
        self._sent.update(line.sent)

    def _pass(self, line: Line, until: int) -> None:
        if not _is_over(line):
            self._running[line.actor.machine] += until - line.time
            for state in line.configuration:
                self._times[line.actor.machine, state] += until - line.time

    def text(self, world: World, ending: str) -> Iterator[str]:
        """Yield the lines of the summary."""
        now = world.clock.now
        for line in self._last.values():
            self._pass(line, now)
        members = counted(len(world.robots), "member") if self._subject.swarm else "one machine"
        time = f"{format_duration(now)} of virtual time"
        yield f"{printable(self._subject.name)}, {members}: {time}, {ending}"
        yield ""
        yield from _table(("member", "in the end", "since"), self._members(), left=2)
        yield from _table(("state", "time", "entered"), self._states())
        yield from _table(("function", "called", *_OUTCOMES, "unfinished"), self._functions(world))
        nobody = ("to nobody",) if world.nobody else ()
        yield from _table(("event", "sent", "heard", "lost", *nobody), self._events(world))
        yield from self._unseen()

    @property
    def awaited(self) -> list[str]:
        """Model events that the active states wait for."""
        found: dict[str, None] = {}
        for line in self._last.values():
            machine = line.actor.machine
            numbers = [] if _is_over(line) else [machine.numbers[s] for s in line.configuration]
            while numbers:
                number = numbers.pop()
                found.update((name, None) for e in machine.edges[number] for name in e.events)
                if number:
                    numbers.append(machine.parents[number])
        # Events with a dot are of activities, delays and final states.
        return [name for name in found if not {".", "*"} & set(name)]

    def _members(self) -> Iterator[Row]:
        lines = list(self._last.values())
        for line in lines[:_MOST]:
            who = line.actor.name or line.actor.machine.name
            where = "lost" if line.event == LOST else ", ".join(line.configuration)
            yield who, where, format_duration(self._since[line.actor])
        if len(lines) > _MOST:
            yield f"and {len(lines) - _MOST} more", "", ""

    def _states(self) -> Iterator[Row]:
        for machine in self._machines:
            together = self._running[machine]
            for state in machine.states[1:]:
                entered, time = self._entered[machine, state.id], self._times[machine, state.id]
                if entered and (time or not state.states):
                    share = f"{100 * time / together:.1f} %" if together else "-"
                    yield f"{machine.name}: {state.id}", share, str(entered)

    def _functions(self, world: World) -> Iterator[Row]:
        for function, called in self._called.items():
            ends = [world.outcomes[function, outcome] for outcome in _OUTCOMES]
            counts = (*ends, called - sum(ends))
            yield function, str(called), *(str(count or "-") for count in counts)

    def _events(self, world: World) -> Iterator[Row]:
        for event, sent in self._sent.items():
            counts = [sent, world.delivered[event], world.lost[event]]
            if world.nobody:
                counts.append(world.nobody[event])
            yield event, *(str(count or "-") for count in counts)

    def _unseen(self) -> Iterator[str]:
        """Yield the coverage and the unreached elements."""
        machines = self._coverage.machines
        states = counted(sum(len(each.states) for each in machines), "state")
        transitions = counted(sum(len(each.transitions) for each in machines), "transition")
        yield f"coverage: {int(self._coverage.percentage)} % of {states} and {transitions}"
        unseen = [found for machine in machines for found in machine.unreached]
        for origin, words in unseen[:_MOST]:
            place = self._subject.place(origin)
            where = f"{place.source.name}:{place.line}: " if place is not None else ""
            yield f"  {printable(f'{where}{words}')}"
        if len(unseen) > _MOST:
            yield f"  and {len(unseen) - _MOST} more"


def _is_over(line: Line) -> bool:
    machine = line.actor.machine
    numbers = [machine.numbers[state] for state in line.configuration]
    ended = [n for n in numbers if machine.parents[n] == 0 and machine.states[n].kind is Kind.FINAL]
    return line.event == LOST or bool(ended)


def _table(head: Row, rows: Iterable[Row], left: int = 1) -> Iterator[str]:
    """Format a table with left- and right-aligned columns; empty without rows."""
    lines = [head, *([printable(cell) for cell in row] for row in rows)]
    if len(lines) == 1:
        return
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    for line in lines:
        cells = [
            cell.ljust(width) if number < left else cell.rjust(width)
            for number, (cell, width) in enumerate(zip(line, widths, strict=True))
        ]
        yield "  ".join(cells).rstrip()
    yield ""
