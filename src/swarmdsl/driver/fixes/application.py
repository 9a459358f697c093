"""Apply fixes to a workspace until nothing changes."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import accumulate
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics, Fix, Severity
from swarmdsl.base.line_matching import line_matcher
from swarmdsl.base.records import dataclass
from swarmdsl.base.rewriting import Change, Layout
from swarmdsl.base.source import Source
from swarmdsl.base.text_edits import Edits
from swarmdsl.driver.edit_files import edited
from swarmdsl.driver.fixes import fixes_of
from swarmdsl.driver.workspace import Workspace
from swarmdsl.syntax.formatter import format_source

# A fix can cause a problem with a fix of its own, but not for ever.
_MOST_ROUNDS = 500
_SYNTAX = "SW01"

Proposal = tuple[Diagnostic, Fix]
Kind = tuple[str, str]


@dataclass(frozen=True)
class Fixed:
    """Fixes that were applied, and the texts of the changed files before and after."""

    applied: Sequence[Proposal]
    before: dict[Path, str]
    after: dict[Path, str]


def fix_all(workspace: Workspace, *, unsafe: bool = False, only: Path | None = None) -> Fixed:
    """Apply the best fix of each diagnostic, and leave the workspace with the new texts.

    With `only`, no other file is changed.

    A fix is undone if its diagnostic stays or if another error comes. In a file with syntax errors,
    only these are fixed. Files that were formatted stay so.
    """
    before = dict(_texts(workspace))
    applied: list[Proposal] = []
    refused: set[tuple[str, str, str, int]] = set()
    for _ in range(_MOST_ROUNDS):
        chosen = without_overlaps(
            (found, fix)
            for found, fix in _proposals(workspace, only, unsafe=unsafe)
            if _identity(found, fix) not in refused
        )
        if not chosen:
            break
        while chosen and not _apply(workspace, chosen):
            # Together they do harm: the first half can be good.
            if len(chosen) == 1:
                refused.add(_identity(*chosen[0]))
            chosen = chosen[: len(chosen) // 2]
        applied += chosen
        # A fix of an import brings in other files.
        before = {**dict(_texts(workspace)), **before}
    changed = {path: text for path, text in _texts(workspace) if before[path] != text}
    texts = {path: _as_formatted(path, before[path], text) for path, text in changed.items()}
    if texts != changed:
        workspace.update(texts)
    return Fixed(applied, {path: before[path] for path in texts}, texts)


def _texts(workspace: Workspace) -> Iterator[tuple[Path, str]]:
    for file in workspace.project.files:
        if file.source.path is not None and not file.library:
            yield file.source.path, file.source.text


def _proposals(workspace: Workspace, only: Path | None, *, unsafe: bool) -> Iterator[Proposal]:
    report = list(workspace.report)
    broken = {
        each.primary.span.source.path
        for each in report
        if each.code.startswith(_SYNTAX) and each.primary
    }
    for found in report:
        fix = next(iter(fixes_of(found, workspace, unsafe=unsafe)), None)
        if fix is None:
            continue
        touched = {span.source.path for span, _ in fix.edits}
        if only is not None and touched != {only}:
            continue
        if found.code.startswith(_SYNTAX) or touched.isdisjoint(broken):
            yield found, fix


def _identity(found: Diagnostic, fix: Fix) -> tuple[str, str, str, int]:
    place = found.primary.span.start if found.primary is not None else 0
    return found.code, found.message, fix.title, place


def without_overlaps(proposals: Iterable[Proposal]) -> list[Proposal]:
    """Return the proposals whose edits are apart from those of earlier ones."""
    taken: dict[Source, list[tuple[int, int]]] = {}
    chosen = []
    for found, fix in proposals:
        spans = [(span.source, span.start, span.end) for span, _ in fix.edits]
        if any(
            start <= other_end and other_start <= end
            for source, start, end in spans
            for other_start, other_end in taken.get(source, ())
        ):
            continue
        for source, start, end in spans:
            taken.setdefault(source, []).append((start, end))
        chosen.append((found, fix))
    return chosen


def texts_with(fixes: Sequence[Fix]) -> dict[Path, str]:
    """Return the texts of files after fixes that do not overlap."""
    edits: dict[Path, Edits] = {}
    for fix in fixes:
        for span, text in fix.edits:
            path = span.source.path
            assert path is not None  # sources of a workspace are files
            edits.setdefault(path, Edits(span.source)).replace(span, text)
    return {path: made.text() for path, made in edits.items()}


def _apply(workspace: Workspace, chosen: Sequence[Proposal]) -> bool:
    """Apply fixes; undo them and return False if they do harm or do not help."""
    old = dict(_texts(workspace))
    new = texts_with([fix for _, fix in chosen])
    before, errors = _counts(workspace)
    workspace.update(new)
    after, errors_after = _counts(workspace)
    # Where a syntax error is gone, other errors can be seen.
    syntax_only = all(found.code.startswith(_SYNTAX) for found, _ in chosen)
    harm = [
        kind for kind in errors_after - errors if not syntax_only or kind[0].startswith(_SYNTAX)
    ]
    cured = Counter((found.code, found.message) for found, _ in chosen)
    if not harm and all(after[kind] <= before[kind] - number for kind, number in cured.items()):
        return True
    workspace.update({path: old[path] for path in new})
    return False


def _counts(workspace: Workspace) -> tuple[Counter[Kind], Counter[Kind]]:
    """Return how often each diagnostic and each error is there."""
    report = list(workspace.report)
    errors = (each for each in report if each.severity is Severity.ERROR)
    every = Counter((each.code, each.message) for each in report)
    return every, Counter((each.code, each.message) for each in errors)


def _as_formatted(path: Path, before: str, after: str) -> str:
    """Format a text if the one before was formatted."""
    if format_source(Source(str(path), before), Diagnostics()) != before:
        return after
    return format_source(Source(str(path), after), Diagnostics()) or after


def layouts_of(fixed: Fixed, report: Diagnostics) -> list[Layout] | None:
    """Return the changed files, in which the lines that stay keep their bytes.

    One that is no longer what was read is reported; None is returned then.
    """
    changes = {path: _changes(fixed.before[path], text) for path, text in fixed.after.items()}
    return edited(changes, fixed.before, report)


def _changes(before: str, after: str) -> Iterator[Change]:
    old, new = (re.findall(r"[^\n]*\n|[^\n]+\Z", text) for text in (before, after))
    starts = [0, *accumulate(map(len, old))]
    for kind, i, j, k, end in line_matcher(old, new).get_opcodes():
        if kind != "equal":
            yield starts[i], starts[j], "".join(new[k:end])
