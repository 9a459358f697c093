"""Variables on both sides of the border of states that become a machine of their own.

A param of a submachine is evaluated each time it is used, so a variable that the states only read
can be passed to it. A variable of a composite state moves into the machine with its states.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import get_args

from swarmdsl.analysis.types import stored_name
from swarmdsl.syntax.ast import (
    NameUse,
    Node,
    Param,
    ResultMapping,
    State,
    StateMachine,
    Store,
    Variable,
    walk,
)

_STORING = (*get_args(Store), ResultMapping)


def own_variables(state: State | None) -> list[Variable]:
    """Return the variables of a composite state."""
    return [each for each in state.items if isinstance(each, Variable)] if state is not None else []


def why_not_shared(
    machine: StateMachine, state: State | None, moved: Collection[Node], subject: str
) -> str | None:
    """Return the reason why what moves cannot be separated from variables; None if it can be."""
    own = own_variables(state)
    for variable in own:
        if variable.initial is None:
            return (
                f"the variable `{variable.name}` of {subject} starts with zero on each entry:"
                " give it an initial value"
            )
    for node in walk(machine):
        if isinstance(node, _STORING) and node in moved:
            stored = stored_name(node.target.tree)
            if stored is not None and isinstance(stored.target, Variable):
                variable = stored.target
                if variable not in moved:
                    return (
                        f"`{variable.name}` is set in {subject}, and a machine can only read"
                        f" variables around it: set `{variable.name}` in transitions that stay"
                    )
        elif isinstance(node, NameUse) and node.target in own and node not in moved:
            return f"the variable `{node.name}` of {subject} is used outside of its states"
    return None


def passed_values(machine: StateMachine, moved: Collection[Node]) -> list[Param | Variable]:
    """Return the params and variables around that are used in what moves, as they are declared."""
    used = {
        node.target
        for node in moved
        if isinstance(node, NameUse)
        and isinstance(node.target, (Param, Variable))
        and node.target not in moved
    }
    return [each for each in walk(machine) if isinstance(each, (Param, Variable)) and each in used]


def as_param(value: Param | Variable, text: str) -> str:
    """Return the declaration of a param for a value that is passed."""
    _, start, end = value.type.span.absolute
    return f"param {value.name} : {text[start:end]}"
