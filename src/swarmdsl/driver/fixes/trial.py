"""Trial of fixes: they are applied to a workspace, and undone if they do harm or do not help."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostic, Fix, Severity
from swarmdsl.base.records import dataclass
from swarmdsl.base.text_edits import Edits
from swarmdsl.driver.workspace import Workspace

Proposal = tuple[Diagnostic, Fix]
Kind = tuple[str, str]

SYNTAX = "SW01"
_UNRESOLVED = "unresolved-name"
_STAYS = "the problem would stay"


@dataclass(frozen=True)
class Refused:
    """Fix that was undone, and the reason."""

    found: Diagnostic
    fix: Fix
    reason: str


def texts_with(fixes: Sequence[Fix]) -> dict[Path, str]:
    """Return the texts of files after fixes that do not overlap."""
    edits: dict[Path, Edits] = {}
    for fix in fixes:
        for span, text in fix.edits:
            path = span.source.path
            assert path is not None  # sources of a workspace are files
            edits.setdefault(path, Edits(span.source)).replace(span, text)
    return {path: made.text() for path, made in edits.items()}


def texts_of(workspace: Workspace) -> Iterator[tuple[Path, str]]:
    """Yield the files of a workspace that may be changed, with their texts."""
    for file in workspace.project.files:
        if file.source.path is not None and not file.library:
            yield file.source.path, file.source.text


def try_fixes(workspace: Workspace, chosen: Sequence[Proposal]) -> str | None:
    """Apply fixes; undo them and return the reason if they do harm or do not help."""
    old = dict(texts_of(workspace))
    new = texts_with([fix for _, fix in chosen])
    before = list(workspace.report)
    workspace.update(new)
    reason = _fault(chosen, before, list(workspace.report))
    if reason is not None:
        workspace.update({path: old[path] for path in new})
    return reason


def _fault(
    chosen: Sequence[Proposal], before: Sequence[Diagnostic], after: Sequence[Diagnostic]
) -> str | None:
    """Return the reason against fixes, from the diagnostics before and after them."""
    errors, errors_after = _errors(before), _errors(after)
    syntax_only = all(found.code.startswith(SYNTAX) for found, _ in chosen)
    if syntax_only:
        # Where a syntax error is gone, other errors can be seen.
        errors_after = [each for each in errors_after if each.code.startswith(SYNTAX)]
        errors = [each for each in errors if each.code.startswith(SYNTAX)]
    there, there_after = _kinds(before), _kinds(after)
    cured = _kinds(found for found, _ in chosen)
    if any(there_after[kind] > there[kind] - number for kind, number in cured.items()):
        return _STAYS
    come = _kinds(errors_after) - _kinds(errors)
    new = [each for each in errors_after if (each.code, each.message) in come]
    if not new or (
        all(_hides(*each) for each in chosen)
        and len(errors_after) <= len(errors)
        and not _inside(new, chosen)
    ):
        return None
    place = new[0].primary
    where = f" in line {place.span.line}" if place is not None else ""
    return f"{new[0].code} would come{where}: {new[0].message}"


def _errors(found: Iterable[Diagnostic]) -> list[Diagnostic]:
    return [each for each in found if each.severity is Severity.ERROR]


def _kinds(found: Iterable[Diagnostic]) -> Counter[Kind]:
    return Counter((each.code, each.message) for each in found)


def _hides(found: Diagnostic, fix: Fix) -> bool:
    """Return True for a wrong text that may hide mistakes elsewhere, and its replacement."""
    replaces = all(span.start < span.end for span, _ in fix.edits)
    return found.code.startswith(SYNTAX) or (found.name == _UNRESOLVED and replaces)


def _inside(new: Iterable[Diagnostic], chosen: Iterable[Proposal]) -> bool:
    """Return True if one of the new errors is about a text that a fix has written."""
    edits = sorted(
        ((span, text) for _, fix in chosen for span, text in fix.edits),
        key=lambda each: each[0].start,
    )
    moved: Counter[Path | None] = Counter()
    written = []
    for span, text in edits:
        path = span.source.path
        start = span.start + moved[path]
        written.append((path, start, start + len(text)))
        moved[path] += len(text) - (span.end - span.start)
    for each in new:
        if each.primary is None:
            return True
        span = each.primary.span.absolute
        if any(
            span.source.path == path and start <= span.start and span.end <= end
            for path, start, end in written
        ):
            return True
    return False
