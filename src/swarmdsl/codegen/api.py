"""What the author of a generator needs, and nothing else.

A generator is data and one pure function: from the IR of a system to files. It never
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

    The value is how a diagnostic names the construct. What every target must express
    (simple and final states, transitions on outcomes and events) is not listed.
    """

    COMPOSITE = "a composite state"
    PARALLEL = "a parallel state"
    CHOICE = "a choice"
    GUARD = "a guard"
    ASSIGNMENT = "an assignment"
    SEND = "the sending of an event"
    TIMEOUT = "a transition after a time"
    VARIABLE = "a variable"
    PARAM = "a param of a state machine"
    RESULT = "a stored result"
    CALLBACK = "a callback"
    EVENT_DATA = "the data of an event"
    CROSS_LEVEL = "a transition out of the state around its own"
    INTO_STATE = "a transition into the inside of a state"
    HISTORY = "a history"
    ENTRY = "an effect on entry"
    EXIT = "an effect on exit"
    INTERNAL = "an internal transition"
    TARGETLESS = "a transition without a target"
    EVENTLESS = "a transition without a trigger"


ALL_FEATURES = frozenset(Feature)


class Support(Enum):
    """How a target has a construct: it has the like, it is made of others, or it is reported."""

    EXACT = "exact"
    EMULATED = "emulated"
    REJECTED = "rejected"


@dataclass(frozen=True, slots=True)
class Mapped:
    """What becomes of a construct in a target, or why it is rejected and with which code."""

    construct: str
    support: Support
    means: str


@dataclass(frozen=True, slots=True)
class OutputFile:
    """A file to be written below the target's output folder.

    `path` is relative, with `/` and no `..`. A file with `keep` is there to be filled in: once
    somebody has written in it, it is left as it is. `owner` is the element of the model that it
    is for, whose name is in its path. `facts` are what code in it builds on, a fact a line; the
    mark of them (`fits`) is in the text. `origin` is the place in the model that gave the file
    its name: where a clash of two names is shown, and where lines come from of which nothing
    else is known; a `MappedText` knows more (see `swarmdsl.codegen.source_map`).
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
    """The options of a generator that has none."""


def option(
    default: V,
    text: str,
    choices: tuple[str, ...] = (),
    check: Callable[[V], str | None] | None = None,
    beside: str = "",
    only: str = "",
) -> Any:
    """A field of an options class: its default, what it is for, the values it may take.

    `beside` is for one that is true where nothing else is said and another target is built too:
    `skeleton.ros=1` is target `skeleton` with its option `ros` at 1. `only` is for one that counts
    only where another of the same target has a value, as `ros=1`.

    `check` is called with a value of the option's type that somebody gave, and returns what
    is wrong with it, in words, or None. It is reported where the value stands.
    """
    about = {"help": text, "choices": choices, "check": check, "beside": beside, "only": only}
    # The data classes of Python, which are slow to import, take no fields but their own.
    python = sys.modules.get("dataclasses")
    return (python.field if python is not None else field)(default=default, metadata=about)


def all_machines(system: System) -> tuple[StateMachine, ...]:
    """Every state machine of the system."""
    return system.machines


def chosen_machines(system: System) -> list[StateMachine]:
    """The machines that get a node: the behaviours there are, or all when there is none."""
    used = {member.behavior for member in system.members}
    used |= {component.behavior for component in system.components}
    used.discard(None)
    return [machine for machine in system.machines if not used or machine.name in used]


Emit = Callable[[System, Any, Diagnostics], Iterable[OutputFile]]


def emit_of(module: str) -> Emit:
    """The function `emit` of a module that is imported when it is called.

    Whoever checks the options of a project needs no more than these.
    """

    def emit(system: System, options: Any, report: Diagnostics) -> Iterable[OutputFile]:
        found: Emit = import_module(module).emit
        return found(system, options, report)

    return emit


@dataclass(frozen=True)
class Generator:
    """One target.

    `emit(system, options, report)` returns the files; `options` is an instance of
    `options_type`, a frozen dataclass of str, bool and int fields made with `option`.
    What it finds wrong with the model goes to `report`. Before it is called the core has
    reported every construct outside `supports` in the machines that `machines(system)`
    names, those it writes, and does not call it when there is one. `mapping` says what becomes
    of each construct, for `swarmc targets`; `mapping_with` the same by the value of an option, as
    `ros=2`, with which that is something else.
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
