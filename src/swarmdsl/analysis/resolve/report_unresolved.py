"""Diagnostics of names that are not resolved, with hints.

The linkers bind names and pass on what they could not bind. Hints are computed here, so that
a correct model does not pay for them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TypeVar

from swarmdsl.analysis.node_kinds import kind_of
from swarmdsl.analysis.resolve.scopes import Ambiguous, FileScope, Missing, Unresolved, WrongKind
from swarmdsl.base.diagnostics.advice import Advice, add_import, meant, write
from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import closest
from swarmdsl.syntax.ast import (
    Constant,
    Declaration,
    EventTrigger,
    Function,
    Node,
    Operation,
    Part,
    Port,
    Ref,
    StateMachine,
    Swarm,
    TypeRef,
    Vertex,
)
from swarmdsl.syntax.types import PRIMITIVES

D = TypeVar("D", bound=Declaration)
Kinds = tuple[type[Node], ...]
Hint = Callable[[], str | None]


def resolve_or_report(
    scope: FileScope,
    name: str,
    at: Span,
    kinds: type[D] | tuple[type[D], ...],
    report: Diagnostics,
    *,
    built_in: Iterable[str] = (),
) -> D | None:
    """Return the declaration that a name means; report a failure and return None.

    `built_in` are names without a declaration that may be meant.
    """
    found = scope.resolve(name, kinds)
    if not isinstance(found, Unresolved):
        return found
    several = kinds if isinstance(kinds, tuple) else (kinds,)
    report_declaration(found, name, at, several, scope, report, built_in=built_in)
    return None


def report_missing(
    kind: str,
    name: str,
    at: Span,
    candidates: Iterable[str],
    report: Diagnostics,
    *,
    hint: Hint | None = None,
) -> None:
    """Report a missing name and suggest the most similar candidate.

    `hint` is used if no candidate is similar.
    """
    close = closest(name, candidates) if report.wants_hint("unresolved-name") else None
    other = hint() if hint is not None and not close else None
    help_ = meant(close) if close else other
    report.report("unresolved-name", at, kind=kind, name=name, help=help_)


def report_missing_inside(
    kind: str,
    name: str,
    at: Span,
    candidates: Iterable[str],
    scope: FileScope,
    report: Diagnostics,
    hint: Hint | None = None,
) -> None:
    """Report a missing name inside a declaration, unless skipped text may declare it."""
    if name not in scope.skipped_names:
        report_missing(kind, name, at, candidates, report, hint=hint)


# ---- declarations


def report_reference(
    found: Unresolved,
    ref: Ref[D],
    owner: Node,
    kind: type[D],
    scope: FileScope,
    report: Diagnostics,
) -> None:
    """Report a reference from `owner` to a declaration of a kind."""
    name = ref.name
    built_in: tuple[str, ...] = ()
    if isinstance(owner, EventTrigger) and isinstance(found, Missing):
        from swarmdsl.analysis.resolve.hints import misspelled_outcome, other_outcome

        outcome = other_outcome(name)
        if outcome is not None and name not in scope.skipped_names:
            help_ = Advice(f"for the outcome of an activity, write `{outcome}`", "propose", outcome)
            report.report("unresolved-name", ref.span, kind="event", name=name, help=help_)
            return
        built_in = tuple(filter(None, [misspelled_outcome(name)]))
    instead = None
    if isinstance(owner, Part) and isinstance(found, WrongKind):
        instead = (
            Advice(f"write `behavior {name}`", "replace part", f"behavior {name}")
            if type(found.node) is StateMachine
            else None
        )
    report_declaration(
        found, name, ref.span, (kind,), scope, report, built_in=built_in, instead=instead
    )


def report_activity(
    found: Unresolved,
    ref: Ref[Function | Operation],
    parts: Iterable[str],
    scope: FileScope,
    report: Diagnostics,
) -> None:
    """Report an activity that is neither a function nor an operation of a part."""
    before, _, name = ref.name.rpartition(".")
    part = closest(before, parts)
    similar = [f"{part}.{name}"] if part else []
    report_declaration(found, ref.name, ref.span, (Function,), scope, report, built_in=similar)


def report_declaration(
    found: Unresolved,
    name: str,
    at: Span,
    kinds: Kinds,
    scope: FileScope,
    report: Diagnostics,
    *,
    built_in: Iterable[str] = (),
    instead: str | None = None,
    hint: Hint | None = None,
) -> None:
    """Report a name that means no declaration of these kinds.

    `instead` is the help for a declaration of another kind, `hint` that for a missing one.
    """
    match found:
        case Ambiguous(candidates=candidates):
            report.report(
                "ambiguous-name",
                at,
                name=name,
                related=_declared_here(candidates.values()),
                help=write(*(f"{package}.{name}" for package in candidates)),
            )
        case WrongKind(node=node) if not may_be_skipped(name, scope):
            report.report(
                "wrong-kind",
                at,
                name=name,
                actual=kind_of(node),
                expected=_kind_of_any(kinds),
                related=_declared_here([node]),
                help=instead,
            )
        case Missing() if scope.imports_resolved and not may_be_skipped(name, scope):
            _report_missing_declaration(name, at, kinds, built_in, scope, report, hint)


def _report_missing_declaration(
    name: str,
    at: Span,
    kinds: Kinds,
    built_in: Iterable[str],
    scope: FileScope,
    report: Diagnostics,
    hint: Hint | None,
) -> None:
    """Report a missing declaration with the best hint.

    A declaration in another file is best, then an import from the library, a similar name, and
    a declaration to add.
    """
    kind = _kind_of_any(kinds).split(" ", 1)[1]
    if not report.wants_hint("unresolved-name"):
        report.report("unresolved-name", at, kind=kind, name=name)
        return
    key = (name, kinds, tuple(built_in))
    if key not in scope.suggestions:
        scope.suggestions[key] = _suggestion(*key, scope)
    related, help_ = scope.suggestions[key]
    if help_ is None and hint is not None and "." not in name:
        help_ = hint()
    report.report("unresolved-name", at, kind=kind, name=name, related=related, help=help_)


def _suggestion(
    name: str, kinds: Kinds, built_in: tuple[str, ...], scope: FileScope
) -> tuple[tuple[Label, ...], str | None]:
    """Return the place and the help of the best hint for a missing declaration."""
    from swarmdsl.analysis.resolve.hints import candidates_for, declared_elsewhere
    from swarmdsl.analysis.resolve.missing_declaration import (
        sibling_imports,
        suggest_declaration,
        suggest_import,
    )

    elsewhere = declared_elsewhere(name, kinds, scope)
    if elsewhere is not None:
        node, line = elsewhere
        label = Label(node.name.span, "declared in a file that is not imported")
        return (label,), add_import(line)
    qualified = "." in name
    if not qualified and (beside := sibling_imports(name, kinds, scope.file)):
        return (), add_import(*beside)
    if not qualified and (library := suggest_import(name, kinds, scope.project)) is not None:
        return (), add_import(library)
    nodes = candidates_for(name, kinds, scope)
    close = closest(name, [*built_in, *nodes])
    if close is None:
        return (), None if qualified else suggest_declaration(name, kinds)
    similar = nodes.get(close)
    label_of = (Label(similar.name.span, "this has a similar name"),) if similar else ()
    return label_of, meant(close)


def may_be_skipped(name: str, scope: FileScope) -> bool:
    """Return True if text that could not be parsed may declare a name."""
    return name.rpartition(".")[2] in scope.skipped_names


def _kind_of_any(kinds: Kinds) -> str:
    """Name of a group of kinds, with an article: what a property is about, types or values."""
    if len(kinds) == 1:
        return kind_of(kinds[0])
    if Swarm in kinds:
        return "a swarm or state machine"
    return "a value" if Constant in kinds else "a type"


def _declared_here(nodes: Iterable[Declaration | Vertex]) -> tuple[Label, ...]:
    return tuple(Label(node.name.span, "declared here") for node in nodes)


# ---- types


def report_type(
    found: Unresolved, ref: TypeRef, kinds: Kinds, scope: FileScope, report: Diagnostics
) -> None:
    """Report the name of a type that is not declared."""
    from swarmdsl.analysis.resolve.hints import type_hint, wants_interface

    help_ = type_hint(ref, scope, report) if isinstance(found, Missing) else None
    if help_ is not None:
        report.report("unresolved-name", ref.span, kind="type", name=ref.name, help=help_)
        return
    primitives = () if wants_interface(ref) else PRIMITIVES
    report_declaration(found, ref.name, ref.span, kinds, scope, report, built_in=primitives)


# ---- ports


def report_part_as_port(ref: Ref[Port], kind: str, report: Diagnostics) -> None:
    """Report a part at the end of a connector, without one of its ports."""
    help_ = Advice(f"it is a part: name one of its ports, `{ref.name}.port`", "name port", ref.name)
    report.report("unresolved-name", ref.span, kind=kind, name=ref.name, help=help_)
