"""Render the view: a file for each swarm, and for each property that SPIN can decide."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

from swarmdsl.codegen import Diagnostics, OutputFile, Templates
from swarmdsl.ir import System

from ..composed.conditions import Operators, claims
from ..composed.options import Options
from ..composed.view import Change, TurnView, WatchView
from ..composed.viewer import views

_BYTE = 255
_OPERATORS = Operators(both="&&", either="||", negated="!", equal="==", true="true")


def emit(system: System, options: Options, report: Diagnostics) -> list[OutputFile]:
    """Return the files."""
    made = []
    for view in views(system, options, "promela", report):
        text = _templates().fill(
            "swarm.pml.j2",
            swarm=view,
            watch=view.watch,
            claims=claims(view.watch, _OPERATORS),
            statements=_statements,
            local="short" if max(len(team.states) for team in view.teams) > _BYTE else "byte",
            at_first=", ".join(f"at_{team.start}" for team in view.teams for _ in range(team.size)),
            inboxes=[each for team in view.teams for _ in range(team.size) for each in team.inbox],
        )
        made.append(OutputFile(f"{view.name}.pml", text, origin=view.origin))
    return made


def _statements(turn: TurnView, watch: WatchView | None, *, letters: bool) -> str:
    """Return what a robot does in a turn."""
    made = [f"inbox(_pid, letter_{turn.hears.name})--"] if turn.hears is not None else []
    made.append(f"at[_pid] = at_{turn.target}")
    if turn.ends and letters:
        made.append("end(_pid)")
    made += [f"send_{each.name}(_pid)" for each in turn.sends]
    for look in turn.looks:
        made += [*_counted(look.changes, watch), "look()"]
    return "; ".join((*made, *_counted(turn.last, watch)))


def _counted(changes: Iterable[Change], watch: WatchView | None) -> Iterator[str]:
    for each in changes:
        step = "++" if each.more else "--"
        yield f"count_{each.term}{step}"
        if each.mine and watch is not None and each.term in watch.mine:
            yield f"my_count_{each.term}{step}"


@cache
def _templates() -> Templates:
    return Templates(Path(__file__).parent / "templates")
