"""Make recordings: of a run while it goes on, or of traces."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics
from swarmdsl.base.numerals import integer
from swarmdsl.base.records import replace
from swarmdsl.base.source import Source, Span
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.run.prepare import Prepared
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND
from swarmdsl.execution.simulate.world.trace_line import is_beside_steps
from swarmdsl.execution.simulate.world.world import World
from swarmdsl.tools.player.engine_world import written_world
from swarmdsl.tools.player.follow_model import follow
from swarmdsl.tools.player.model import Model
from swarmdsl.tools.player.recording import Machine, Member, Note, Recording, Step
from swarmdsl.tools.player.trace_lines import read_steps

_MOST_NOTES = 50
"""Diagnostics that a page tells."""


class RunRecorder:
    """Keeps the lines of a run in memory: a `Recorder` of the simulator."""

    def __init__(self) -> None:
        self._lines: list[str] = []
        self._members: list[Member] = []
        self._subject: Subject | None = None
        self._scenario: Path | None = None
        self._seed = 0
        self._tables: dict[str, Any] = {}
        self._end = 0

    def begin(
        self, subject: Subject, cast: Sequence[Actor], scenario: Path | None, world: World
    ) -> None:
        """Note who runs, in which scenario and world, before the world begins."""
        self._subject, self._scenario, self._seed = subject, scenario, world.seed
        self._tables = written_world(subject, cast, world)
        self._members = [
            Member(each.name or each.machine.name, each.role, each.machine.name, each.robot.index)
            for each in cast
        ]

    def write(self, text: str, /) -> None:
        """Keep a line."""
        self._lines.append(text)

    def end(self, time: int) -> None:
        """Note when the run was over."""
        self._end = time

    def recording(self, notes: Iterable[Diagnostic] = ()) -> Recording | None:
        """Return the recording; None if the run has not begun."""
        if self._subject is None:
            return None
        report = Diagnostics()
        source = Source("", "".join(self._lines))
        model = Model(self._subject)
        return _recording(
            [named(step, model.alone) for step, _ in read_steps([source], report)],
            self._members,
            model,
            notes,
            end=self._end,
            scenario=self._scenario.name if self._scenario is not None else "",
            seed=self._seed,
            tables=self._tables,
        )


def record_traces(
    sources: Sequence[Source],
    prepared: Prepared | None,
    report: Diagnostics,
) -> Recording | None:
    """Return the recording of traces, of a model if it is known; None if they have no line.

    It tells what is in `report`. Members that the model does not have, or that leave it, are
    reported and shown all the same.
    """
    steps = read_steps(sources, report)
    if not any("configuration" in step for step, _ in steps):
        return None
    model = Model(prepared.subject) if prepared is not None else None
    alone = model.alone if model is not None else None
    names = [step["member"] for step, _ in steps if step.get("member") is not None]
    followed = None
    if prepared is not None:
        subject, scenario = prepared.subject, prepared.scenario
        followed = follow(sources, dict.fromkeys(names), subject, scenario, report)
    lines = []
    first: dict[str, Span] = {}
    for step, place in steps:
        line = named(step, alone)
        changed = followed.variables.get((place.source.name, place.start)) if followed else None
        lines.append(line if changed is None else {**line, "variables": changed})
        if not is_beside_steps(line):
            first.setdefault(line["member"], place)
    if followed is not None and not any("property" in line for line in lines):
        lines = sorted([*lines, *followed.judged], key=lambda line: int(line["t"]))
    own = report if followed is None else Diagnostics()  # else they are told already
    members = [member_of(name, place, model, own) for name, place in first.items()]
    return _recording(lines, members, model, report)


def record_nothing(prepared: Prepared | None, live: str) -> Recording:
    """Return the recording of a trace whose lines are to come, of a model if it is known."""
    model = Model(prepared.subject) if prepared is not None else None
    # Robots may be anywhere in the environment.
    has_places = prepared is not None and prepared.subject.environment is not None
    places = [{"moved": {"": [0, 0]}}] if has_places else []
    return replace(
        _recording([], [], model, ()),
        machines=list(_machines(model).values()),
        views=model.view_data(places) if model is not None else {},
        live=live,
    )


def named(line: Step, alone: str | None) -> Step:
    """Return a line with the name of its member; a machine `alone` has its own."""
    if is_beside_steps(line) or line.get("member") is not None:
        return line
    return {
        "t": line["t"],
        "member": alone or "machine",
        **{k: v for k, v in line.items() if k != "member"},
    }


def member_of(name: str, place: Span | None, model: Model | None, report: Diagnostics) -> Member:
    """Return a member of a trace; report one whose role the model does not have."""
    robot, bracket, rest = name.partition("[")
    number, _, part = rest.partition("]")
    role = f"{robot}{part}" if bracket else name
    index = integer(number) if number.isdecimal() and number.isascii() else 0
    if model is None:
        return Member(name, role, role, index)
    machine = model.alone or model.machine_of(role)
    if machine is None:
        report.report(
            "unresolved-name",
            place,
            kind="member",
            name=name,
            help=f"`{model.name}` has no role `{role}`: name the model of this trace",
        )
    return Member(name, role, machine or role, index)


def _recording(
    lines: Sequence[Step],
    members: Sequence[Member],
    model: Model | None,
    notes: Iterable[Diagnostic],
    *,
    end: int = 0,
    scenario: str = "",
    seed: int | None = None,
    tables: Mapping[str, Any] | None = None,
) -> Recording:
    last = lines[-1]["t"] * MILLISECOND if lines else 0
    return Recording(
        title=model.name if model is not None else "Run",
        lines=lines,
        members=members,
        machines=_with_seen_states(_machines(model), members, lines),
        end=max(end, last),
        model=model.name if model is not None else "",
        scenario=scenario,
        seed=seed,
        sources=model.sources if model is not None else {},
        views=model.view_data(lines) if model is not None else {},
        tables=tables or {},
        notes=list(_notes(notes)),
    )


def _machines(model: Model | None) -> dict[str, Machine]:
    return dict(model.machines()) if model is not None else {}


def _with_seen_states(
    machines: Mapping[str, Machine], members: Sequence[Member], lines: Sequence[Step]
) -> list[Machine]:
    """Return the machines of the members, with states that only the lines have."""
    found = dict(machines)
    of = {each.name: each.machine for each in members}
    seen: dict[str, dict[str, None]] = {}
    for line in lines:
        if "configuration" in line and line.get("member") in of:
            states = seen.setdefault(of[line["member"]], {})
            states |= dict.fromkeys(line["configuration"])
    for name, states in seen.items():
        known = found.get(name, Machine(name, ()))
        if not states.keys() <= set(known.states):
            found[name] = known.with_states(states)
        else:
            found[name] = known
    return list(found.values())


def _notes(found: Iterable[Diagnostic]) -> Iterator[Note]:
    """Yield what the page tells: the first ones of many, and how many there are."""
    for number, each in enumerate(told := list(found)):
        if number == _MOST_NOTES:
            count = len(told) - number
            yield Note("warning", "", f"{count} more diagnostics are in the output of the command")
            return
        yield note_of(each)


def note_of(found: Diagnostic) -> Note:
    """Return what a page tells of a diagnostic."""
    place = ""
    if found.primary is not None:
        span = found.primary.span.absolute
        line, column = span.source.line_column(span.start)
        place = f"{span.source.name}:{line}:{column}"
    label = found.primary.message if found.primary is not None else ""
    message = f"{found.message}: {label}" if label else found.message
    return Note(found.severity.value, found.code, message, place, found.help or "")
