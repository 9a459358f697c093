"""Diagnostics of names and paths of states that are not resolved, with hints."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.analysis.resolve.report_unresolved import report_missing
from swarmdsl.analysis.resolve.scopes import FileScope
from swarmdsl.analysis.resolve.states import Level
from swarmdsl.base.diagnostics.advice import Advice, write
from swarmdsl.base.diagnostics.collector import Diagnostics, Label, listed
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import Container, History, Initial, Node, Parallel, Ref, State, Vertex


def report_ambiguous_state(
    name: str, at: Span, found: Sequence[Vertex], report: Diagnostics
) -> None:
    """Report a name that states in several regions have."""
    report.report(
        "ambiguous-name",
        at,
        name=name,
        related=tuple(Label(state.name.span, "declared here") for state in found),
        help="give the states in the regions different names",
    )


def report_missing_state(
    name: str,
    at: Span,
    outer: Vertex | None,
    levels: Sequence[Level],
    scope: FileScope,
    report: Diagnostics,
) -> None:
    """Report a missing name of a state. `outer` is the state that a path leads into."""
    if name in scope.skipped_names:
        return
    kind = "state" if outer is None else f"state in `{outer.name}`"
    if not report.wants_hint("unresolved-name"):
        report.report("unresolved-name", at, kind=kind, name=name)
        return
    from swarmdsl.analysis.resolve.hints import path_to_state

    states = [state for level in levels for found in level.values() for state in found]
    paths = (path_to_state(name, state) for state in states)
    path = next((path for path in paths if path), None)
    if path:
        report.report(
            "unresolved-name",
            at,
            kind="state",
            name=name,
            related=(Label(path[-1].name.span, "declared here, inside another state"),),
            help=write(".".join(state.name for state in path)),
        )
        return
    report_missing(kind, name, at, [str(state.name) for state in states], report)


def report_region_in_path(
    index: int, at: Span, path: Sequence[str], outer: Vertex, report: Diagnostics
) -> None:
    """Report a region of `outer` as a name of a path to a state."""
    without = ".".join((*path[:index], *path[index + 1 :]))
    report.report(
        "unresolved-name",
        at,
        kind=f"state in `{outer.name}`",
        name=path[index],
        help=write(without, before="paths leave out regions: "),
    )


def report_state_outside(
    arrow: Initial | History,
    target: Ref[Vertex],
    container: Container,
    outside: Vertex,
    report: Diagnostics,
) -> None:
    """Report an initial state or a history whose target is not inside its container."""
    what = "`initial` names" if isinstance(arrow, Initial) else f"history `{arrow.name}` leads to"
    report.report(
        "unresolved-name",
        target.span,
        kind=f"state in `{container.name}`",
        name=target.name,
        related=(Label(outside.name.span, "this state is not inside"),),
        help=Advice(f"{what} a state inside `{container.name}`", "state inside"),
    )


def report_state_not_around(ref: Ref[Vertex], around: Sequence[Node], report: Diagnostics) -> None:
    """Report a state that is not always active where its time is asked for."""
    names = [str(each.name) for each in around if isinstance(each, (State, Parallel))]
    written = listed([f"elapsed({name})" for name in names], "or")
    report.report(
        "state-not-around",
        ref.span,
        name=ref.name,
        help=Advice(f"write {written}", "state around", *names) if names else None,
    )
