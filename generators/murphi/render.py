"""Render the view: a file for each swarm, and for each property that rumur can decide."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

from swarmdsl.codegen import Diagnostics, OutputFile, Templates
from swarmdsl.ir import System

from ..composed.conditions import Operators, claims
from ..composed.options import Options
from ..composed.view import Change, Sent, SwarmView, TeamView, TurnView, WatchView
from ..composed.viewer import views

_OPERATORS = Operators(both="&", either="|", negated="!", equal="=", true="true")


def emit(system: System, options: Options, report: Diagnostics) -> list[OutputFile]:
    """Return the files."""
    made = []
    for view in views(system, options, "murphi", report):
        text = _templates().fill(
            "swarm.m.j2",
            swarm=view,
            watch=view.watch,
            claims=claims(view.watch, _OPERATORS),
            statements=_statements,
            receives=_receives,
        )
        made.append(OutputFile(f"{view.name}.m", text, origin=view.origin))
    return made


def _receives(swarm: SwarmView, sent: Sent, team: TeamView) -> str:
    """Return the condition that robot `other` of a team gets a letter of robot `me`."""
    conditions = ["other != me"] if team.name == sent.team else []
    conditions += [f"at_{team.name}[other] != in_{each}" for each in team.ended]
    same = (each for each in swarm.letters if each.event == sent.letter.event)
    waiting = " + ".join(f"inbox_{team.name}[other][letter_{each.name}]" for each in same)
    return " & ".join((*conditions, f"{waiting} < CAPACITY"))


def _statements(
    turn: TurnView, team: TeamView, watch: WatchView | None, *, letters: bool
) -> Iterator[str]:
    """Yield what robot `me` does in a turn."""
    if turn.hears is not None:
        inbox = f"inbox_{team.name}[me][letter_{turn.hears.name}]"
        yield f"{inbox} := {inbox} - 1"
    yield f"at_{team.name}[me] := in_{turn.target}"
    if turn.ends and letters:
        yield f"end_{team.name}(me)"
    yield from (f"send_{each.name}(me)" for each in turn.sends)
    for look in turn.looks:
        yield from _counted(look.changes, watch)
        yield "look()"
    yield from _counted(turn.last, watch)


def _counted(changes: Iterable[Change], watch: WatchView | None) -> Iterator[str]:
    for each in changes:
        names = [f"count_{each.term}"]
        if each.mine and watch is not None and each.term in watch.mine:
            names.append(f"my_count_{each.term}")
        yield from (f"{name} := {name} {'+' if each.more else '-'} 1" for name in names)


@cache
def _templates() -> Templates:
    return Templates(Path(__file__).parent / "templates")
