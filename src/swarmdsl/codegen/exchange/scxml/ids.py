"""Ids of states and data in a portable SCXML document.

All ids of an XML document share one namespace. Ids of states have no dots: SCXML matches event
names by their dotted prefixes, so `done.state.A` would also match a state `A.B`.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable

from swarmdsl.ir import StateMachine

# Reserved words of ECMAScript, SCXML's own variables, and the identity of the robot.
RESERVED = re.compile(
    "arguments|await|break|case|catch|class|const|continue|debugger|default|"
    "delete|do|else|enum|eval|export|extends|false|finally|for|function|"
    "if|implements|import|in|instanceof|interface|let|new|null|package|"
    "private|protected|public|return|static|super|switch|this|throw|true|"
    "try|typeof|undefined|var|void|while|with|yield|In|Date|Math|NaN|Infinity|self|_.*"
)


def data_ids(machine: StateMachine) -> dict[str, str]:
    """Return the `<data>` id of each variable and param: its name if possible."""
    names = [param.name for param in machine.params]
    names += [variable.name for variable in machine.variables]
    ids: dict[str, str] = {}
    given, taken = set(names), set[str]()
    for name in names:
        candidate = f"data_{name}" if RESERVED.fullmatch(name) else name
        while candidate in taken or (candidate != name and candidate in given):
            candidate += "_"
        ids[name] = candidate
        taken.add(candidate)
    return ids


def entry_ids(states: Iterable[str], taken: Iterable[str]) -> dict[str, str]:
    """Return the `<data>` id of the time at which each of some states was entered."""
    ids: dict[str, str] = {}
    used = set(taken)
    for state in states:
        # States called `A.B_C` and `A_B.C` have one candidate.
        candidate = f"since_{state.replace('.', '_')}"
        while candidate in used:
            candidate += "_"
        ids[state] = candidate
        used.add(candidate)
    return ids


def state_ids(machine: StateMachine, taken: set[str]) -> dict[str, str]:
    """Return the XML id of each state: its name if unique, else its path."""
    named = Counter(state.name for state in machine.walk())
    ids: dict[str, str] = {}
    for state in machine.walk():
        path = state.id.replace(".", "-")
        candidate = state.name if named[state.name] == 1 else path
        # No name of the model has a `-`, and no state is called `state`.
        ids[state.id] = f"{path}-state" if candidate in taken else candidate
    return ids
