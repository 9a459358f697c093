"""Warnings about files that the user has edited, and notes written beside them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.source import Source, Span
from swarmdsl.base.suggest import suggest
from swarmdsl.codegen.api import OutputFile
from swarmdsl.codegen.user_code_marks import mark_in
from swarmdsl.output import line_ends
from swarmdsl.output.changes import PARKED
from swarmdsl.output.names import Names

if TYPE_CHECKING:
    from swarmdsl.output.merge import Merge

NEW = ".swarmc-new"
"""Suffix of the generated version of a file that it cannot be merged with."""

NOTE = ".swarmc-changes"
"""Suffix of the note about model changes that affect code of the user."""

_MOST_LINES = 10


def report_edited(
    place: Path, content: bytes, base: bytes, taken: int, report: Diagnostics
) -> None:
    """Report an edited generated file, into which `taken` changes were merged."""
    # Imported here, as below, because it is slow and most builds merge nothing.
    from swarmdsl.output.merge import first_difference

    source = _source(place, content)
    at = _line(source, first_difference(base, content))
    changes = "one change" if taken == 1 else f"{taken} changes"
    notes = (f"{changes} of the generator merged into it",) if taken else ()
    help_ = "put your lines in a region or a file of your own; `--force` discards the edit"
    report.report("edited-output", at, path=str(place), notes=notes, help=help_)


def report_conflict(place: Path, content: bytes, merge: Merge | None, report: Diagnostics) -> None:
    """Report a merge conflict; the generated version is beside the file."""
    source = _source(place, content)
    others: tuple[Label, ...] = ()
    at: Span | None = None
    notes: tuple[str, ...] = ("the version that it was generated from is unknown",)
    if merge is not None:
        spans = [_line(source, first) for first, _ in merge.conflicts]
        at, notes = spans[0], ()
        others = tuple(Label(span, "and here") for span in spans[1:])
    help_ = (
        f"merge what you need of `{place.name}{NEW}` beside it and delete that, "
        "or discard the edit with `--force`"
    )
    report.report("merge-conflict", at, related=others, path=str(place), notes=notes, help=help_)


def report_neighbour(place: Path, report: Diagnostics) -> None:
    """Report that the file beside another one was edited, and thus is not updated."""
    notes = ("it does not have the latest generated content",)
    help_ = "delete it or replace the file beside it with it, and build again"
    report.report("edited-output", path=str(place), notes=notes, help=help_)


def report_damaged(
    place: Path, content: bytes, line: int, fault: str, hint: str | None, report: Diagnostics
) -> None:
    """Report invalid region marks in a file."""
    at = _line(_source(place, content), line)
    help_ = hint or "fix the mark: until then all lines of the file are kept as an edit"
    report.report("damaged-region", at, path=str(place), fault=fault, help=help_)


def report_link(link: Path, path: str, report: Diagnostics) -> None:
    """Report a symbolic link that leads out of the output folder."""
    leads_to = os.path.realpath(link)
    target = path.removeprefix(f"{PARKED}/").partition("/")[0]
    notes = (f"it is a symbolic link to `{leads_to}`",)
    help_ = "remove the link; to write there, give that folder with `-o`"
    report.report("outside-output", target=target, path=str(link), notes=notes, help=help_)


def report_other_model(out: Path, model: str, gone: int, report: Diagnostics) -> None:
    """Report that files of a model with another name are removed."""
    files = "one file" if gone == 1 else f"{gone} files"
    help_ = (
        "build each model into a folder of its own, with `-o`, or all of them at once; "
        f"ignore this if `{model}` was renamed"
    )
    report.report("other-model", path=str(out), model=model, files=files, help=help_)


def report_parked(place: Path, aside: Path, report: Diagnostics) -> None:
    """Report an edited file that is put aside."""
    help_ = f"it is in `{aside}`, and is restored when the model has the element again"
    report.report("parked-code", path=str(place), help=help_)


def report_renamed(
    old: str, new: str, at: Span | None, command: Iterable[str], report: Diagnostics
) -> None:
    """Report a new element that looks like a removed one."""
    import shlex  # most builds do not need it

    help_ = f"if it is, `{shlex.join(command)} --rename {old}={new}` moves your files"
    report.report("renamed-element", at, old=old, new=new, help=help_)


def report_bad_rename(names: Names, made: Mapping[str, OutputFile], report: Diagnostics) -> None:
    """Report a rename without generated files for the old and the new name."""
    owners = {file.owner for file in made.values() if file.owner}
    if names.old in owners:
        fault, help_ = f"the model still has `{names.old}`", None
    elif names.new not in owners:
        fault = f"nothing is generated for `{names.new}`"
        help_ = suggest(names.new, owners, "elements")
    else:
        fault, help_ = f"nothing was generated for `{names.old}`", None
    report.report("bad-rename", old=names.old, new=names.new, fault=fault, help=help_)


def report_old_name(
    place: Path, content: bytes, lines: Sequence[int], names: Names, report: Diagnostics
) -> None:
    """Report a moved file of the user with lines that may name the old element."""
    if not lines:
        return
    source = _source(place, content)
    spans = [_name(source, line - 1, names) for line in lines[:_MOST_LINES]]
    others = tuple(Label(span, "and here") for span in spans[1:])
    more = len(lines) - len(spans)
    notes = (f"and in {more} more lines",) if more else ()
    help_ = f"write `{names.new}` where the element is meant; this is reported once"
    first, path = spans[0], str(place)
    report.report(
        "old-name", first, related=others, notes=notes, help=help_, path=path, name=names.old
    )


def report_outdated(
    place: Path,
    file: OutputFile,
    content: bytes,
    marks: tuple[str, str],
    facts: Sequence[str] | None,
    report: Diagnostics,
) -> None:
    """Report code of the user that was written for an earlier model."""
    help_ = f"adapt it, then {_write_mark(content, marks)}"
    notes = (*_differences(facts, file.facts), f"see `{place.name}{NOTE}` beside it for details")
    report.report("outdated-code", file.origin, path=str(place), notes=notes, help=help_)


def changed_below(
    path: str,
    file: OutputFile,
    content: bytes,
    marks: tuple[str, str],
    base: bytes | None,
    facts: Sequence[str] | None,
) -> bytes:
    """Return a note about the changes that the code in a file builds on.

    `base` is the generated content that the file was created from, `facts` are what its code was
    written for.
    """
    name = path.rpartition("/")[2]
    new = file.text.encode()
    lines = [
        f"`{name}` is yours, and was written for another state of the model.",
        f"Adapt it, and {_write_mark(content, marks)}:",
        "then this file goes.",
    ]
    differences = _differences(facts, file.facts)
    if differences:
        lines += ["", "What its code builds on:", "", *(f"    {line}" for line in differences)]
    elif facts is None:
        lines += ["", "What its code builds on now:", "", *(f"    {each}" for each in file.facts)]
    text = "\n".join([*lines, ""])
    if base is not None and base != new:
        from swarmdsl.base.unified_diff import unified_diff

        text += "\nWhat would be generated in its place, before and now:\n\n"
        text += unified_diff(base, new, name, name)
    return text.encode()


def report_changed_meanwhile(place: Path, report: Diagnostics) -> None:
    """Report a file that was changed while the build was running."""
    reason, help_ = "it was changed during the build", "build again: your change is kept"
    report.report("cannot-write", path=str(place), reason=reason, help=help_)


def _write_mark(content: bytes, marks: tuple[str, str]) -> str:
    """Return the instruction to mark a file as adapted."""
    if mark_in(content) is None:
        return f"write a comment with `swarmc:fits {marks[1]}` into it, where that was deleted"
    return f"write `swarmc:fits {marks[1]}` for `{marks[0]}` in it"


def _differences(before: Sequence[str] | None, now: Sequence[str]) -> list[str]:
    """Return removed and added facts."""
    if before is None:
        return []
    gone = [f"- {fact}" for fact in before if fact not in now]
    return gone + [f"+ {fact}" for fact in now if fact not in before]


def _source(place: Path, content: bytes) -> Source:
    return Source(str(place), line_ends.plain(content).decode(errors="replace"), place)


def _line(source: Source, number: int) -> Span:
    """Return the span of a line, from 0; the last line if there are fewer."""
    starts = [*source.line_starts, len(source.text)]
    number = min(number, len(starts) - 2)
    return Span(source, starts[number], max(starts[number], starts[number + 1] - 1))


def _name(source: Source, number: int, names: Names) -> Span:
    """Return the span of the old name in a line."""
    line = _line(source, number)
    start, end = names.place(line.text)
    return Span(source, line.start + start, line.start + end)
