"""Which warnings are meant by a word, for the project file and for the command line."""

from __future__ import annotations

from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.base.diagnostics.collector import ALL_WARNINGS, Level
from swarmdsl.base.diagnostics.explain import find_code
from swarmdsl.base.suggest import did_you_mean

_NAMES = {entry.code: name for name, entry in CODES.items()}


def find_diagnostic(word: str) -> str | None:
    """The name of the diagnostic meant by a name or a code; None for none."""
    if word == ALL_WARNINGS:
        return word
    code = find_code(word)
    return _NAMES[code] if code is not None else None


def _is_error(name: str) -> bool:
    """Whether it is an error, whose level is fixed."""
    return name != ALL_WARNINGS and CODES[name].severity == "error"


def may_have(name: str, level: Level) -> bool:
    """Whether a diagnostic can be given a level; errors are denied as it is."""
    return level is Level.DENY or not _is_error(name)


def similar_diagnostic(word: str) -> str | None:
    """A question that names the diagnostic most like a word."""
    return did_you_mean(word, [ALL_WARNINGS, *CODES, *_NAMES])
