"""Look up diagnostics by name or code, for lint levels."""

from __future__ import annotations

from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.base.diagnostics.collector import ALL_WARNINGS, Level
from swarmdsl.base.diagnostics.explain import find_code
from swarmdsl.base.suggest import did_you_mean

_NAMES = {entry.code: name for name, entry in CODES.items()}


def find_diagnostic(word: str) -> str | None:
    """Return the name of a diagnostic, given its name or code; None if unknown."""
    if word == ALL_WARNINGS:
        return word
    code = find_code(word)
    return _NAMES[code] if code is not None else None


def _is_error(name: str) -> bool:
    """Return True if it is an error, whose level is fixed."""
    return name != ALL_WARNINGS and CODES[name].severity == "error"


def may_have(name: str, level: Level) -> bool:
    """Return True if a diagnostic can have a level; errors can only be denied."""
    return level is Level.DENY or not _is_error(name)


def similar_diagnostic(word: str) -> str | None:
    """Return a hint with the most similar diagnostic."""
    return did_you_mean(word, [ALL_WARNINGS, *CODES, *_NAMES])
