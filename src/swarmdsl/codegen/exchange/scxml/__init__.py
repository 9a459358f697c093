"""Target `scxml`: state machines as portable SCXML and in the CPSwarm dialect."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics, Severity
from swarmdsl.base.records import dataclass
from swarmdsl.codegen.api import ALL_FEATURES, Feature, Generator, OutputFile, option
from swarmdsl.ir import StateMachine, System

if TYPE_CHECKING:
    from swarmdsl.codegen.xml_tree import Places

PROFILES = ("both", "portable", "cpswarm")


@dataclass(frozen=True)
class Options:
    """Options of target `scxml`."""

    profile: str = option(
        "both", "W3C SCXML (portable), the CPSwarm dialect (cpswarm) or both", PROFILES
    )


def emit(system: System, options: Options, report: Diagnostics) -> Iterator[OutputFile]:
    """Yield the files of each machine."""
    # Imported late: other targets use single modules of this package without XML.
    from swarmdsl.codegen.exchange.scxml.portable import portable
    from swarmdsl.codegen.xml_tree import document

    for machine in system.machines:
        if options.profile != "cpswarm":
            places: Places = {}
            text = document(portable(machine, system, places), places)
            yield OutputFile(f"{machine.name}.scxml", text, origin=machine.origin)
            _report_deferred(machine, report)
        if options.profile != "portable":
            yield from _in_dialect(machine, system, options, report)


def _report_deferred(machine: StateMachine, report: Diagnostics) -> None:
    """Warn of deferred events, which SCXML lacks."""
    for state in machine.walk():
        for trigger in state.deferred:
            report.report(
                "no-place",
                trigger.origin,
                target="scxml",
                what=f"deferred event `{trigger.event}` for other engines",
                notes=("`<sw:defer>` is read by swarmdsl; other engines discard the event",),
            )


def _in_dialect(
    machine: StateMachine, system: System, options: Options, report: Diagnostics
) -> Iterator[OutputFile]:
    from swarmdsl.codegen.exchange.scxml.cpswarm import cpswarm, file_name
    from swarmdsl.codegen.xml_tree import document

    found = Diagnostics()
    places: Places = {}
    tree = cpswarm(machine, system, found, places)
    if tree is not None:
        report.include(found)
        yield OutputFile(file_name(machine), document(tree, places), origin=machine.origin)
    elif options.profile == "cpswarm":
        report.include(found)
    else:
        _report_left_out(file_name(machine), machine, found, report)


def _report_left_out(
    path: str, machine: StateMachine, found: Diagnostics, report: Diagnostics
) -> None:
    """Warn that one of two files is missing, at the first cause."""
    from swarmdsl.codegen.exchange.scxml.cpswarm_messages import HELP

    first, *others = _errors(found)
    notes = [first.message]
    if others:
        notes.append(f"this is the first of {len(others) + 1} such places")
    report.report(
        "profile-left-out",
        first.primary.span if first.primary is not None else machine.origin,
        related=first.related,
        notes=tuple(notes),
        help=HELP,
        path=path,
    )


def _errors(found: Diagnostics) -> list[Diagnostic]:
    return [each for each in found if each.severity is Severity.ERROR]


generator = Generator(
    target="scxml",
    summary="each state machine as SCXML, for any engine and for the CPSwarm code generator",
    emit=emit,
    options_type=Options,
    supports=ALL_FEATURES - {Feature.NEIGHBORS, Feature.PRESENT},
)
