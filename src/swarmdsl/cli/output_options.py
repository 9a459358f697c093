"""Options for writing output: conflicts between them, and the report at the end."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from swarmdsl.base.errors import UsageError
from swarmdsl.base.records import dataclass
from swarmdsl.cli.exit_code import ERRORS, OK, conclude
from swarmdsl.cli.parameters import Option

if TYPE_CHECKING:
    from swarmdsl.driver.pipeline import Result
    from swarmdsl.output import WriteOptions

FORCE = Option(
    "force",
    ("--force",),
    "Discard edits of generated files, and overwrite other files in their place. Files to "
    "fill in stay as they are.",
)
CHECK = Option(
    "check",
    ("--check",),
    "Write nothing; fail if a build would change a file, or if one was edited.",
)
DRY_RUN = Option("dry_run", ("--dry-run",), "Print what would happen to each file; write nothing.")
DIFF = Option(
    "diff",
    ("--diff",),
    "Print the changes as a unified diff; write nothing, and fail if there are any.",
)

RENAME = Option(
    "renames",
    ("--rename",),
    "Move the files that you filled in for an element to its new name; may be repeated.",
    kind=str,
    metavar="OLD=NEW",
    repeated=True,
)
OPTIONS = (FORCE, CHECK, DRY_RUN, DIFF, RENAME)

_NOTHING_TO_FORCE = "a check finds what `--force` would overwrite"
# Conflicting options, and why they conflict.
_CONFLICTS = {
    ("check", "dry_run"): "a check writes nothing either, and reports what is stale",
    ("check", "force"): _NOTHING_TO_FORCE,
    ("check", "clean"): "a check compares the output, `--clean` removes it",
    ("check", "watch"): "a check runs once",
    ("check", "renames"): "a check reports files to move, and `--dry-run` shows them",
    ("clean", "force"): "edited files are never removed",
    ("clean", "diff"): "`--clean --dry-run` shows what would be removed",
    ("clean", "watch"): "output is removed once",
    ("clean", "renames"): "`--rename` builds, `--clean` does not",
    ("watch", "force"): "it would overwrite every edit: build once with `--force`, then watch",
    ("watch", "renames"): "files are moved once: build with `--rename`, then watch",
    ("watch", "dump_ir"): "it prints once",
}
_NO_OUTPUT = ("check", "clean", "dry_run", "diff", "force", "renames")
_CONFLICTS |= {(name, "dump_ir"): "it prints the model and makes no files" for name in _NO_OUTPUT}
_FLAGS = {"renames": "--rename"}


def writing(given: Mapping[str, Any]) -> Writing:
    """Combine the writing options, given by parameter.

    Raises UsageError for options that conflict.
    """
    for (one, other), reason in _CONFLICTS.items():
        if given.get(one) and given.get(other):
            raise UsageError(f"{_flag(one)} and {_flag(other)} conflict: {reason}")
    return Writing(
        given["force"], given["check"], given["dry_run"], given["diff"], _renames(given["renames"])
    )


def _renames(given: Iterable[str]) -> tuple[tuple[str, str], ...]:
    """Parse pairs OLD=NEW; raise UsageError for anything else."""
    found: list[tuple[str, str]] = []
    for text in given:
        old, equals, new = text.partition("=")
        if not (equals and _is_name(old) and _is_name(new) and old != new):
            raise UsageError(f"`--rename {text}` is not of the form OLD=NEW with two names")
        found.append((old, new))
    for side, word in enumerate(("renamed twice", "the new name of two")):
        names = [pair[side] for pair in found]
        for name in names:
            if names.count(name) > 1:
                raise UsageError(f"`--rename`: `{name}` is {word}")
    return tuple(found)


@dataclass(frozen=True)
class Writing:
    """Writing options of a command line."""

    force: bool
    check: bool
    dry_run: bool
    diff: bool
    renames: tuple[tuple[str, str], ...]

    def how(self, *command: object) -> WriteOptions:
        """Options for `output.write`; `command` are the words that a user would repeat."""
        from swarmdsl.output import WriteOptions

        dry = self.dry_run or self.diff
        return WriteOptions(self.force, dry, self.check, self.renames, tuple(map(str, command)))

    def conclude(self, result: Result, format_: str) -> int:
        """Print the result or the plan; return the exit code."""
        written = result.written
        if not (self.dry_run or self.diff):
            code = conclude(result, format_, sys.stdout, about_files=not self.check)
            if self.check and written is not None and code == OK:
                sys.stderr.write(f"{written.folder} is up to date\n")
            return code
        self.show(result, format_)
        code = conclude(result, format_, sys.stderr, about_files=False)
        changes = written is not None and bool(written.changes)
        return ERRORS if code == OK and self.diff and changes else code

    def show(self, result: Result, format_: str) -> None:
        """Print the plan of a dry run."""
        from swarmdsl.output.report_planned import render_diff, render_plan

        if result.written is not None and self.diff:
            render_diff(result.written, sys.stdout)
        elif result.written is not None:
            render_plan(result.written, format_, sys.stdout)
        sys.stdout.flush()


def _is_name(text: str) -> bool:
    return re.fullmatch("[A-Za-z][A-Za-z0-9_]*", text) is not None


def _flag(parameter: str) -> str:
    return f"`{_FLAGS.get(parameter, '--' + parameter.replace('_', '-'))}`"
