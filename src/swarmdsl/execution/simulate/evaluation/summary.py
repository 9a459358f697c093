"""Summary of a run: state times, function outcomes, coverage."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from swarmdsl.base.diagnostics.render import counted
from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.execution.monitor import PropertyResult
from swarmdsl.execution.simulate.evaluation.coverage import Coverage
from swarmdsl.execution.simulate.evaluation.measures import FitnessResult, measure_rows
from swarmdsl.execution.simulate.evaluation.verdicts import rows
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.durations import format_duration
from swarmdsl.execution.simulate.world.statistics import Life
from swarmdsl.execution.simulate.world.world import World

_MOST = 20
_OUTCOMES = ("succeeded", "aborted", "preempted", "cancelled")
Row = Sequence[str]


class Summary:
    """Statistics of a run as text."""

    def __init__(self, subject: Subject, world: World) -> None:
        self._subject = subject
        self._world = world
        self._statistics = world.trace.statistics
        self._lives = list(world.trace.lives.values())

    def text(
        self,
        ending: str,
        properties: Iterable[PropertyResult] = (),
        fitness: FitnessResult | None = None,
        *,
        brief: bool = False,
    ) -> Iterator[str]:
        """Yield the lines of the summary, or only the verdicts; the run is over."""
        world = self._world
        now = world.clock.now
        for life in self._lives:
            life.close()
        members = counted(len(world.robots), "member") if self._subject.swarm else "one machine"
        time = f"{format_duration(now)} of virtual time"
        yield f"{printable(self._subject.name)}, {members}: {time}, {ending}"
        yield ""
        if brief:
            *table, _ = property_table(properties)
            yield from table
            return
        yield from format_table(("member", "in the end", "since"), self._members(), left=2)
        yield from format_table(("state", "time", "entered"), self._states())
        yield from format_table(("function", "called", *_OUTCOMES, "unfinished"), self._functions())
        yield from format_table(("event", "sent", *_counts(world)), self._events())
        head, *moved = world.space.rows() or ((),)
        yield from format_table(head, moved[:_MOST])
        yield from format_table(
            ("ignored event", "in state", "times"), self._ignored_events(), left=2
        )
        yield from property_table(properties)
        yield from measure_table(fitness)
        yield from self._unseen()

    @property
    def awaited(self) -> list[str]:
        """Model events that the active states wait for."""
        found: dict[str, None] = {}
        for life in self._lives:
            machine = life.actor.machine
            states = [] if life.is_over else life.instance.configuration.innermost
            numbers = [machine.numbers[state] for state in states]
            while numbers:
                number = numbers.pop()
                found.update((name, None) for e in machine.edges[number] for name in e.events)
                if number:
                    numbers.append(machine.parents[number])
        # Events with a dot are of activities, delays and final states.
        return [name for name in found if not {".", "*"} & set(name)]

    def _members(self) -> Iterator[Row]:
        for life in self._lives[:_MOST]:
            who = life.actor.name or life.actor.machine.name
            yield who, _place(life), format_duration(life.since)
        if len(self._lives) > _MOST:
            yield f"and {len(self._lives) - _MOST} more", "", ""

    def _states(self) -> Iterator[Row]:
        for machine, counts in self._statistics.machines.items():
            for state in machine.states[1:]:
                # Time passes in the innermost states.
                time = 0 if state.states else counts.times[state.id]
                entered = counts.entered[state.id]
                if entered and (time or not state.states):
                    share = f"{100 * time / counts.running:.1f} %" if counts.running else "-"
                    yield f"{machine.name}: {state.id}", share, str(entered)

    def _functions(self) -> Iterator[Row]:
        for function, called in self._statistics.called.items():
            ends = [self._world.activities.outcomes[function, outcome] for outcome in _OUTCOMES]
            counts = (*ends, called - sum(ends))
            yield function, str(called), *(str(count or "-") for count in counts)

    def _events(self) -> Iterator[Row]:
        system = self._subject.system
        for event, sent in self._statistics.sent.items():
            if system is not None and not system.event(event).swarm:
                continue  # the robot alone hears it
            counts = (sent, *(found[event] for found in _counts(self._world).values()))
            yield event, *(str(count or "-") for count in counts)

    def _ignored_events(self) -> Iterator[Row]:
        """Yield the events that enabled no transition, the most frequent first."""
        counts = self._statistics.ignored.most_common()
        for (event, where), count in counts[:_MOST]:
            yield event, where, str(count)
        if len(counts) > _MOST:
            yield f"and {len(counts) - _MOST} more", "", ""

    def _unseen(self) -> Iterator[str]:
        """Yield the coverage and the unreached elements."""
        coverage = Coverage()
        for machine, counts in self._statistics.machines.items():
            coverage.reach(machine, counts.entered, counts.taken.values())
        machines = coverage.machines
        states = counted(sum(len(each.states) for each in machines), "state")
        transitions = counted(sum(len(each.transitions) for each in machines), "transition")
        yield f"coverage: {int(coverage.percentage)} % of {states} and {transitions}"
        unseen = [found for machine in machines for found in machine.unreached]
        for origin, words in unseen[:_MOST]:
            place = self._subject.place(origin)
            where = f"{place.source.name}:{place.line}: " if place is not None else ""
            yield f"  {printable(f'{where}{words}')}"
        if len(unseen) > _MOST:
            yield f"  and {len(unseen) - _MOST} more"


def _place(life: Life) -> str:
    if life.lost:
        return "lost"
    return life.instance.final or ", ".join(life.instance.configuration.innermost)


def _counts(world: World) -> dict[str, Counter[str]]:
    """Return the numbers of swarm events by column; rare ones have a column if there are any."""
    network = world.network
    rare = {
        "to nobody": world.nobody,
        "sent again": network.repeated,
        "too old": network.expired,
        "waiting": network.waiting,
        "late": network.late,
    }
    found = {name: counts for name, counts in rare.items() if counts}
    return {"heard": network.delivered, "lost": network.lost, **found}


def property_table(results: Iterable[PropertyResult]) -> Iterator[str]:
    """Format the verdicts on properties."""
    yield from format_table(("property", "verdict", "where"), rows(results), left=3)


def measure_table(result: FitnessResult | None) -> Iterator[str]:
    """Format measures and fitness."""
    rows = measure_rows(result) if result is not None else ()
    yield from format_table(("measure", "value", ""), rows, left=3)


def format_table(head: Row, rows: Iterable[Row], left: int = 1) -> Iterator[str]:
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
