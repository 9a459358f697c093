"""Diagnostics and their collector.

A mistake of the user is a `Diagnostic` in a `Diagnostics` collector, never an exception: every
phase reports and continues.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from enum import Enum
from typing import TYPE_CHECKING

from swarmdsl.base.records import dataclass, replace
from swarmdsl.base.source import Span

if TYPE_CHECKING:
    from swarmdsl.base.diagnostics.catalog import Code


class Severity(Enum):
    """Severity; only errors stop a build."""

    ERROR = "error"
    WARNING = "warning"


class Level(Enum):
    """Lint level of a warning: ignored, reported, or an error."""

    ALLOW = "allow"
    WARN = "warn"
    DENY = "deny"


ALL_WARNINGS = "warnings"
"""Stands for every warning whose level is not given by its own name and that is not silent."""


MOST_HINTS = 50
"""Different messages of one kind that get a hint, at most."""

MOST_HINTED = 500
"""Diagnostics of one kind that get a hint, at most."""


_NOTHING: dict[Diagnostic, None] = {}
_NO_TALLIES: dict[str, Tally] = {}
_NO_LEVELS: Mapping[str, Level] = {}


@dataclass(frozen=True, slots=True)
class Label:
    """Span with a message."""

    span: Span
    message: str = ""


@dataclass(frozen=True, slots=True)
class Fix:
    """Replacements of text that resolve a diagnostic.

    A safe one is the only reading of what the author wrote; others are proposals.
    """

    title: str
    edits: tuple[tuple[Span, str], ...]
    safe: bool = False


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """Diagnostic.

    `code` and `name` identify its kind (`SW0201`, `unresolved-name`), `message` is the headline,
    `primary` the place (None if it concerns no place in a file, e.g. a missing file), `related`
    other places that explain it, `help` a hint. `fixes` are added by `driver/fixes` on demand, the
    best one first.
    """

    code: str
    name: str
    severity: Severity
    message: str
    primary: Label | None = None
    related: tuple[Label, ...] = ()
    notes: tuple[str, ...] = ()
    help: str | None = None
    fixes: tuple[Fix, ...] = ()


def placed(found: Diagnostic, place: Callable[[Span], Span]) -> Diagnostic:
    """Return a diagnostic with mapped spans."""
    primary = found.primary
    return replace(
        found,
        primary=replace(primary, span=place(primary.span)) if primary is not None else None,
        related=tuple(replace(label, span=place(label.span)) for label in found.related),
    )


class Tally:
    """Number of diagnostics of one kind, and their different messages."""

    __slots__ = ("count", "messages")

    def __init__(self) -> None:
        self.count = 0
        self.messages: set[str] = set()

    def add(self, other: Tally) -> None:
        """Add the diagnostics of another collector."""
        self.count += other.count
        self.messages |= other.messages

    @property
    def allows_hint(self) -> bool:
        """True if one more diagnostic of the kind gets a hint.

        Each search visits all candidates. After many different names there is likely a single
        cause, such as a missing import.
        """
        return len(self.messages) < MOST_HINTS and self.count < MOST_HINTED


class Diagnostics:
    """Collector of diagnostics, without duplicates.

    `levels` are the levels of warnings by name, or for ALL_WARNINGS.
    """

    # In an editor there are many, most of them empty.
    __slots__ = ("_found", "_levels", "_tallies", "has_errors")

    def __init__(self, levels: Mapping[str, Level] | None = None) -> None:
        self._found: dict[Diagnostic, None] = _NOTHING
        self._tallies: dict[str, Tally] = _NO_TALLIES
        self._levels = levels or _NO_LEVELS
        # True if a diagnostic stops the build.
        self.has_errors = False

    def report(
        self,
        name: str,
        at: Span | None = None,
        /,
        *,
        label: str = "",
        related: tuple[Label, ...] = (),
        notes: tuple[str, ...] = (),
        help: str | None = None,  # noqa: A002 - the word a person reads in the output
        **fields: object,
    ) -> None:
        """Add the diagnostic `name` of the catalogue; `fields` fill in its message.

        Raises KeyError for an unknown name or field: a bug in swarmdsl.
        """
        entry = _catalogued(name)
        found = Diagnostic(
            code=entry.code,
            name=name,
            severity=Severity(entry.severity),
            message=entry.message.format(**fields),
            primary=Label(at, label) if at is not None else None,
            related=related,
            notes=notes,
            help=help,
        )
        self._add(found)

    def include(self, others: Iterable[Diagnostic]) -> None:
        """Add diagnostics of another collector."""
        for found in others:
            self._add(found)

    def _add(self, found: Diagnostic) -> None:
        if found.severity is Severity.WARNING:
            level = self._level(found.name)
            if level is Level.ALLOW:
                return
            if level is Level.DENY:
                found = replace(found, severity=Severity.ERROR)
        if self._found is _NOTHING:
            self._found, self._tallies = {}, {}
        self._found.setdefault(found)
        self.has_errors = self.has_errors or found.severity is Severity.ERROR
        tally = self._tallies.setdefault(found.name, Tally())
        tally.count += 1
        tally.messages.add(found.message)

    def change(self, convert: Callable[[Diagnostic], Diagnostic]) -> None:
        """Replace each diagnostic by a converted one of the same severity."""
        self._found = dict.fromkeys(map(convert, self._found))

    def wants(self, silent: str) -> bool:
        """Return True if a warning that is off by default is enabled."""
        return self._levels.get(silent, Level.ALLOW) is not Level.ALLOW

    def _level(self, name: str) -> Level:
        silent = _catalogued(name).silent
        others = Level.ALLOW if silent else self._levels.get(ALL_WARNINGS, Level.WARN)
        return self._levels.get(name, others)

    def wants_hint(self, name: str) -> bool:
        """Return True if a hint should be searched for an unresolved name."""
        tally = self._tallies.get(name)
        return tally is None or tally.allows_hint

    def tally(self, name: str) -> Tally:
        """Return the tally of the reports with this name."""
        return self._tallies.get(name) or Tally()

    def count_of(self, name: str) -> int:
        """Return the number of reports with this name."""
        return self.tally(name).count

    def count(self, severity: Severity) -> int:
        """Return the number of diagnostics of a severity."""
        return sum(found.severity is severity for found in self._found)

    def __iter__(self) -> Iterator[Diagnostic]:
        """Iterate over the diagnostics by file and offset; those without a place come first."""
        return iter(sorted(self._found, key=_position))

    def __len__(self) -> int:
        return len(self._found)


def _catalogued(name: str) -> Code:
    # Imported here because a model without mistakes needs no catalogue.
    from swarmdsl.base.diagnostics.catalog import CODES

    return CODES[name]


def _position(found: Diagnostic) -> tuple[str, int, int, str, str]:
    if found.primary is None:
        return ("", 0, 0, found.code, found.message)
    span = found.primary.span
    return (span.source.name, span.start, span.end, found.code, found.message)


def listed(words: list[str], conjunction: str = "or") -> str:
    """Join quoted words: "`a`, `b` or `c`"."""
    quoted = [f"`{word}`" for word in words]
    if len(quoted) < 2:
        return "".join(quoted)
    return f"{', '.join(quoted[:-1])} {conjunction} {quoted[-1]}"
