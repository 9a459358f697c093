"""Apply fixes to a workspace until nothing changes."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import accumulate
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics, Fix
from swarmdsl.base.line_matching import line_matcher
from swarmdsl.base.records import dataclass
from swarmdsl.base.rewriting import Change, Layout
from swarmdsl.base.source import Source
from swarmdsl.driver.edit_files import edited
from swarmdsl.driver.fixes import SLOW, fixes_of
from swarmdsl.driver.fixes.trial import SYNTAX, Proposal, Refused, texts_of, try_fixes
from swarmdsl.driver.workspace import Workspace
from swarmdsl.syntax.formatter import format_source

# A fix can cause a problem with a fix of its own, but not for ever.
_MOST_ROUNDS = 500
_Identity = tuple[str, str, str, int]


@dataclass(frozen=True)
class Fixed:
    """Fixes that were applied, and the texts of the changed files before and after.

    `refused` are those that were undone, of diagnostics that remain. If not `complete`, more fixes
    could have been tried.
    """

    applied: Sequence[Proposal]
    before: dict[Path, str]
    after: dict[Path, str]
    refused: Sequence[Refused] = ()
    complete: bool = True


def fix_all(
    workspace: Workspace,
    *,
    unsafe: bool = False,
    only: Path | None = None,
    slow: bool = True,
    trials: int | None = None,
) -> Fixed:
    """Apply the best fix of each diagnostic, and leave the workspace with the new texts.

    With `only`, no other file is changed; without `slow`, slow fixes are left out. After so many
    `trials`, no further one is made.

    A fix is undone if its diagnostic stays or if another error comes, unless the wrong text has
    hidden that one. In a file with syntax errors, only these are fixed. Files that were formatted
    stay so.
    """
    before = dict(texts_of(workspace))
    applied: list[Proposal] = []
    refused: dict[_Identity, Refused] = {}
    tried, applied_before = 0, 0
    for _ in range(_MOST_ROUNDS):
        chosen = without_overlaps(
            (found, fix)
            for found, fix in _proposals(workspace, only, unsafe=unsafe, slow=slow)
            if _identity(found, fix) not in refused
        )
        if not chosen:
            if not refused or len(applied) == applied_before:
                break
            # What did harm may help now.
            applied_before = len(applied)
            refused.clear()
            continue
        while chosen and tried != trials:
            tried += 1
            reason = try_fixes(workspace, chosen)
            if reason is None:
                break
            # Together they do harm: the first half can be good.
            if len(chosen) == 1:
                refused[_identity(*chosen[0])] = Refused(*chosen[0], reason)
            chosen = chosen[: len(chosen) // 2]
        else:
            if tried == trials:
                break
        applied += chosen
        # A fix of an import brings in other files.
        before = {**dict(texts_of(workspace)), **before}
    changed = {path: text for path, text in texts_of(workspace) if before[path] != text}
    texts = {path: _as_formatted(path, before[path], text) for path, text in changed.items()}
    if texts != changed:
        workspace.update(texts)
    remain = {(each.code, each.message) for each in workspace.report}
    left = [each for each in refused.values() if (each.found.code, each.found.message) in remain]
    if only is None:
        left += _waiting(workspace, unsafe=unsafe)
    return Fixed(
        applied, {path: before[path] for path in texts}, texts, left, complete=tried != trials
    )


def _proposals(
    workspace: Workspace, only: Path | None, *, unsafe: bool, slow: bool
) -> Iterator[Proposal]:
    broken = _broken(workspace)
    for found in list(workspace.report):
        if found.name == SLOW and not slow:
            continue
        fix = next(iter(fixes_of(found, workspace, unsafe=unsafe)), None)
        if fix is None:
            continue
        touched = {span.source.path for span, _ in fix.edits}
        if only is not None and touched != {only}:
            continue
        if found.code.startswith(SYNTAX) or touched.isdisjoint(broken):
            yield found, fix


def _waiting(workspace: Workspace, *, unsafe: bool) -> Iterator[Refused]:
    """Yield the fixes of files with syntax errors, which come first."""
    broken = _broken(workspace)
    for found in workspace.report if broken else ():
        if found.name == SLOW or found.code.startswith(SYNTAX):
            continue
        for fix in fixes_of(found, workspace, unsafe=unsafe)[:1]:
            if not broken.isdisjoint(span.source.path for span, _ in fix.edits):
                yield Refused(found, fix, "the file has syntax errors")


def _broken(workspace: Workspace) -> set[Path | None]:
    return {
        each.primary.span.source.path
        for each in workspace.report
        if each.code.startswith(SYNTAX) and each.primary
    }


def _identity(found: Diagnostic, fix: Fix) -> _Identity:
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
