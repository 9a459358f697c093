"""Types that a generator is made of.

A generator is data and one pure function, from the IR of a system to files. It never
touches the disk; the core checks the paths, finds collisions and writes.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Mapping
from enum import Enum
from importlib import import_module
from typing import Any, TypeVar

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span
from swarmdsl.codegen.user_code_marks import fits
from swarmdsl.ir import StateMachine, System

API_VERSION = 1

V = TypeVar("V", str, bool, int)


class Feature(Enum):
    """Constructs of state machines that a target may be unable to express.

    The value names the construct in diagnostics. Simple and final states, and transitions on
    outcomes and events, are not listed: every target must express them.
    """

    COMPOSITE = "a composite state"
    PARALLEL = "a parallel state"
    CHOICE = "a choice"
    GUARD = "a guard"
    ASSIGNMENT = "an assignment"
    SEND = "the sending of an event"
    DELAYED_SEND = "the delayed sending of an event"
    DEFER = "a deferred event"
    TIMEOUT = "a transition after a time"
    VARIABLE = "a variable"
    PARAM = "a param of a state machine"
    RESULT = "a stored result"
    CALLBACK = "a callback"
    EVENT_DATA = "the data of an event"
    SENDER = "the sender of an event"
    ADDRESS = "an address"
    SELF = "the identity of the robot"
    IN_STATE = "a test of the active states"
    MEMBER_EVENT = "an event of the members of a swarm"
    PRESENT = "the number of robots that are there"
    NEIGHBORS = "the number of robots nearby"
    ELAPSED = "the time in a state"
    CROSS_LEVEL = "a transition out of the enclosing state"
    INTO_STATE = "a transition into a nested state"
    HISTORY = "a history"
    ENTRY = "an effect on entry"
    EXIT = "an effect on exit"
    INTERNAL = "an internal transition"
    TARGETLESS = "a transition without a target"
    EVENTLESS = "a transition without a trigger"


ALL_FEATURES = frozenset(Feature)


class Support(Enum):
    """Support of a construct: native, made of other constructs, or reported."""

    EXACT = "exact"
    EMULATED = "emulated"
    REJECTED = "rejected"


@dataclass(frozen=True, slots=True)
class Mapped:
    """Translation of a construct in a target, or the reason and code of its rejection."""

    construct: str
    support: Support
    means: str


@dataclass(frozen=True, slots=True)
class OutputFile:
    """File to write below the target's output folder.

    `path` is relative, with `/` and no `..`. A file with `keep` is a stub for the user to fill in:
    once edited, it is not overwritten. `owner` is the element of the model that the file is for,
    whose name is in its path. `facts` are the facts of the model that code in it relies on, one a
    line; the text contains their mark (`fits`). `origin` is the place in the model that gave the
    file its name: it is shown if two paths clash, and it is the origin of lines without one of
    their own. A `MappedText` knows more (see `swarmdsl.codegen.source_map`).
    """

    path: str
    text: str
    executable: bool = False
    keep: bool = False
    owner: str = ""
    facts: tuple[str, ...] = ()
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True)
class NoOptions:
    """Options of a generator that has none."""


def option(
    default: V,
    text: str,
    choices: tuple[str, ...] = (),
    check: Callable[[V], str | None] | None = None,
    beside: str = "",
    only: str = "",
) -> Any:
    """Return a field of an options class: default, help text, and the values allowed.

    `beside` makes the default true if another target is built too: `skeleton.ros=1` is target
    `skeleton` with its option `ros` at 1. An option with `only`, such as `ros=1`, counts only if
    that option of the same target has that value.

    `check` is called with a given value of the option's type. It returns an error message, which
    is reported where the value is given, or None.
    """
    about = {"help": text, "choices": choices, "check": check, "beside": beside, "only": only}
    # Python's dataclasses, slow to import, accept only their own fields.
    python = sys.modules.get("dataclasses")
    return (python.field if python is not None else field)(default=default, metadata=about)


def all_machines(system: System) -> tuple[StateMachine, ...]:
    """Return every state machine of the system."""
    return system.machines


def chosen_machines(system: System) -> list[StateMachine]:
    """Return the machines that get a node: the behaviours, or all if there is none."""
    used = {member.behavior for member in system.members}
    used |= {component.behavior for component in system.components}
    used.discard(None)
    return [machine for machine in system.machines if not used or machine.name in used]


Emit = Callable[[System, Any, Diagnostics], Iterable[OutputFile]]


def emit_of(module: str) -> Emit:
    """Return function `emit` of a module that is imported on the first call.

    Checking the options of a project then needs no more than the registration.
    """

    def emit(system: System, options: Any, report: Diagnostics) -> Iterable[OutputFile]:
        found: Emit = import_module(module).emit
        return found(system, options, report)

    return emit


@dataclass(frozen=True)
class Generator:
    """Target: its name, options, constructs and function.

    `emit(system, options, report)` returns the files; `options` is an instance of
    `options_type`, a frozen dataclass of str, bool and int fields made with `option`.
    Problems of the model go to `report`. `machines(system)` are the machines that the target
    writes: if one of them uses a construct outside `supports`, the core reports it and does not
    call `emit`. `mapping` is the table of constructs that `swarmc targets` prints; `mapping_with`
    gives other tables by the value of an option, such as `ros=2`.
    """

    target: str
    summary: str
    emit: Emit
    options_type: type = NoOptions
    supports: frozenset[Feature] = ALL_FEATURES
    api_version: int = API_VERSION
    machines: Callable[[System], Iterable[StateMachine]] = all_machines
    mapping: tuple[Mapped, ...] = ()
    mapping_with: Mapping[str, tuple[Mapped, ...]] = field(default_factory=dict)


__all__ = [
    "ALL_FEATURES",
    "API_VERSION",
    "Feature",
    "Generator",
    "Mapped",
    "NoOptions",
    "OutputFile",
    "Support",
    "emit_of",
    "fits",
    "option",
]
