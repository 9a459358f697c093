"""Replay traces of robots on the model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Source, Span
from swarmdsl.base.suggest import suggest
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.machine_data import first_data
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.network.members import Roster, counting_neighbors
from swarmdsl.execution.simulate.replay.machine_replay import MachineReplay, Seen
from swarmdsl.execution.simulate.replay.trace_records import Record, find_loop, read_records
from swarmdsl.execution.simulate.scenario.scenario import Fault, Robot
from swarmdsl.execution.simulate.world.trace_line import is_beside_steps


@dataclass(frozen=True)
class Replayed:
    """Number of conforming lines and members of a trace, and the time of its last line.

    `left_out` are the lines that differ, follow a difference, or are of no member. The last `loop`
    lines repeat for ever; with 0, nothing happens after them. `over` is True if all machines have
    ended, and no robot comes back.
    """

    lines: int
    members: int
    end: int
    left_out: int = 0
    loop: int | None = None
    over: bool = False

    @property
    def repeated(self) -> int | None:
        """Number of last lines that repeat for ever, 0 after the end, None if it is not known."""
        if self.left_out:
            return None
        return 0 if self.loop is None and self.over else self.loop


def replay(
    source: Source,
    subject: Subject,
    cast: Sequence[Actor],
    report: Diagnostics,
    seen: Seen | None = None,
    faults: Sequence[Fault] = (),
) -> Replayed:
    """Replay a trace; report the first difference of each member.

    Times are since the first start. Listener `seen` gets the lines as in the model, those of one
    member after the other. A robot that has ended may be lost by one of the `faults` without a
    line, and come back.
    """
    records = list(read_records(source, report))
    end = max((record.time for record in records), default=0)
    loop = find_loop(records, report)
    by_member: dict[str | None, list[Record]] = {}
    for record in records:
        if not is_beside_steps(record.done):
            by_member.setdefault(record.done.get("member"), []).append(record)
    actors = {actor.name: actor for actor in cast}
    blind = counting_neighbors(subject.system)
    followed = ended = 0
    given = sum(map(len, by_member.values()))
    for member, records in by_member.items():
        actor = actors.get(member)
        if actor is None and len(by_member) == len(actors) == 1:
            # A single machine has no name, whoever ran it.
            (actor,) = actors.values()
            if member is not None:
                _impersonate(actor, member, subject)
        if actor is None:
            _report_member(member, records[0].place, actors, report)
            continue
        if actor.machine.name in blind:
            # A trace tells where this robot was when, and not where all others were.
            report.report("not-replayed", records[0].place, name=actor.name or actor.machine.name)
            continue
        roster = Roster(dict.fromkeys(each.robot for each in cast))
        replayed = MachineReplay(actor, subject, report, seen, roster)
        followed += replayed.replay(records)
        ended += replayed.has_ended
    lost = any(fault.may_keep(each.robot, end) for fault in faults for each in cast)
    over = ended == len(cast) and not lost
    return Replayed(followed, len(by_member), end, given - followed, loop, over)


def _impersonate(actor: Actor, member: str, subject: Subject) -> None:
    """Let a machine alone be that of a robot."""
    if subject.machine is not None and subject.system is not None:
        robot = Robot.called(member)
        # The params keep their values; what variables begin with may depend on the robot.
        actor.data = first_data(subject.machine, subject.system, actor.data, robot)


def _report_member(
    member: str | None, place: Span, actors: Mapping[str | None, Actor], report: Diagnostics
) -> None:
    known = [name for name in actors if name is not None]
    role = (member or "").partition("[")[0]
    if any(name.startswith(f"{role}[") for name in known):
        # Verified runs have the numbers of their scenario, and of `--size`.
        help_: str | None = (
            "the trace may be of more robots: name its scenario with `--scenario`, "
            f"or one with `{role}` in `[count]`"
        )
    else:
        help_ = suggest(member or "", known, "members") if known else None
    report.report("unresolved-name", place, kind="member", name=member or "", help=help_)
