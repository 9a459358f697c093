"""What is told about files that the user has worked on, and what is written beside them."""

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
"""Ends the name of what would be generated in place of a file that it cannot be merged with."""

NOTE = ".swarmc-changes"
"""Ends the name of what says how a model has changed below code of the user."""

_MOST_LINES = 10


def report_edited(
    place: Path, content: bytes, base: bytes, taken: int, report: Diagnostics
) -> None:
    """A generated file has been edited, and `taken` changes were merged into it."""
    # Imported here because most builds merge nothing, and it is slow; so below.
    from swarmdsl.output.merge import first_difference

    source = _source(place, content)
    at = _line(source, first_difference(base, content))
    changes = "one change" if taken == 1 else f"{taken} changes"
    notes = (f"{changes} of what is generated merged into it",) if taken else ()
    help_ = "a region or a file of yours keeps lines for good; `--force` gives up the edit"
    report.report("edited-output", at, path=str(place), notes=notes, help=help_)


def report_conflict(place: Path, content: bytes, merge: Merge | None, report: Diagnostics) -> None:
    """A generated file has been edited where it changes; what would be there is beside it."""
    source = _source(place, content)
    others: tuple[Label, ...] = ()
    at: Span | None = None
    notes: tuple[str, ...] = ("what it was made from is not known",)
    if merge is not None:
        spans = [_line(source, first) for first, _ in merge.conflicts]
        at, notes = spans[0], ()
        others = tuple(Label(span, "and here") for span in spans[1:])
    help_ = (
        f"take over what you need of `{place.name}{NEW}` beside it and delete that, "
        "or give up the edit with `--force`"
    )
    report.report("merge-conflict", at, related=others, path=str(place), notes=notes, help=help_)


def report_neighbour(place: Path, report: Diagnostics) -> None:
    """What would be generated is not beside a file, since somebody has edited what is there."""
    notes = ("what is generated now is not in it",)
    help_ = "move it away or over the file that it is beside, and build again"
    report.report("edited-output", path=str(place), notes=notes, help=help_)


def report_damaged(
    place: Path, content: bytes, line: int, fault: str, hint: str | None, report: Diagnostics
) -> None:
    """The marks of the user's regions in a file are not as they were generated."""
    at = _line(_source(place, content), line)
    help_ = hint or "mend the mark: until then all lines of the file are kept as an edit"
    report.report("damaged-region", at, path=str(place), fault=fault, help=help_)


def report_link(link: Path, path: str, report: Diagnostics) -> None:
    """A symbolic link leads out of the output folder on the way to a file."""
    leads_to = os.path.realpath(link)
    target = path.removeprefix(f"{PARKED}/").partition("/")[0]
    notes = (f"it is a symbolic link to `{leads_to}`",)
    help_ = "remove the link; to write there, give that folder with `-o`"
    report.report("outside-output", target=target, path=str(link), notes=notes, help=help_)


def report_other_model(out: Path, model: str, gone: int, report: Diagnostics) -> None:
    """A folder has files of a model of another name, which go."""
    files = "one file" if gone == 1 else f"{gone} files"
    help_ = (
        "build each model into a folder of its own, with `-o`, or all of them at once; "
        f"where `{model}` has got another name, all is well"
    )
    report.report("other-model", path=str(out), model=model, files=files, help=help_)


def report_parked(place: Path, aside: Path, report: Diagnostics) -> None:
    """A file with lines of the user is put aside."""
    help_ = f"it is in `{aside}`, and comes back when the model has that again"
    report.report("parked-code", path=str(place), help=help_)


def report_renamed(
    old: str, new: str, at: Span | None, command: Iterable[str], report: Diagnostics
) -> None:
    """A new element is like one that is gone."""
    import shlex  # which most builds need not wait for

    help_ = f"if it is, `{shlex.join(command)} --rename {old}={new}` moves your files"
    report.report("renamed-element", at, old=old, new=new, help=help_)


def report_bad_rename(names: Names, made: Mapping[str, OutputFile], report: Diagnostics) -> None:
    """Nothing was generated under the old name that is generated under the new one."""
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
    """A file of the user was moved, in which some lines may still name the old element."""
    if not lines:
        return
    source = _source(place, content)
    spans = [_name(source, line - 1, names) for line in lines[:_MOST_LINES]]
    others = tuple(Label(span, "and here") for span in spans[1:])
    more = len(lines) - len(spans)
    notes = (f"and in {more} more lines",) if more else ()
    help_ = f"write `{names.new}` where the element is meant; this is told once"
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
    """Code of the user was written for what the model said before."""
    help_ = f"adapt it, and then {_write_mark(content, marks)}"
    notes = (*_differences(facts, file.facts), f"`{place.name}{NOTE}` beside it says more")
    report.report("outdated-code", file.origin, path=str(place), notes=notes, help=help_)


def changed_below(
    path: str,
    file: OutputFile,
    content: bytes,
    marks: tuple[str, str],
    base: bytes | None,
    facts: Sequence[str] | None,
) -> bytes:
    """A text for the person who adapts a file: what has changed that its code builds on.

    `base` is what was generated in its place, `facts` what the code was written for.
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
    """A file that the user has changed while the build decided what to do with it."""
    reason, help_ = "it was changed while swarmc was at work", "build again: it is as you left it"
    report.report("cannot-write", path=str(place), reason=reason, help=help_)


def _write_mark(content: bytes, marks: tuple[str, str]) -> str:
    """What says that a file is adapted; its mark may have been deleted."""
    if mark_in(content) is None:
        return f"write a comment with `swarmc:fits {marks[1]}` into it, where that was deleted"
    return f"write `swarmc:fits {marks[1]}` for `{marks[0]}` in it"


def _differences(before: Sequence[str] | None, now: Sequence[str]) -> list[str]:
    """The facts that are gone and those that are new."""
    if before is None:
        return []
    gone = [f"- {fact}" for fact in before if fact not in now]
    return gone + [f"+ {fact}" for fact in now if fact not in before]


def _source(place: Path, content: bytes) -> Source:
    return Source(str(place), line_ends.plain(content).decode(errors="replace"), place)


def _line(source: Source, number: int) -> Span:
    """A line of a source, counted from 0; the last where there are not so many."""
    starts = [*source.line_starts, len(source.text)]
    number = min(number, len(starts) - 2)
    return Span(source, starts[number], max(starts[number], starts[number + 1] - 1))


def _name(source: Source, number: int, names: Names) -> Span:
    """The old name in a line."""
    line = _line(source, number)
    start, end = names.place(line.text)
    return Span(source, line.start + start, line.start + end)
