"""Scripts replayed in an engine."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from .engines import ENGINES, Engine, QCoreApplication
from .known import QT
from .scripts import Script


def engines() -> list[object]:
    """The names of the engines, as parameters of a test."""
    return [pytest.param(name, marks=needs(name)) for name in ENGINES]


def installed() -> list[str]:
    """The engines that are here."""
    return [name for name in ENGINES if name != QT or QCoreApplication is not None]


def needs(engine: str) -> list[pytest.MarkDecorator]:
    """The mark that skips a test whose engine is not installed."""
    reason = "no QtScxml: `make agreement`"
    return [pytest.mark.skipif(engine not in installed(), reason=reason)]


def difference(make: Callable[[bytes], Engine], document: bytes, script: Script) -> str | None:
    """Return the first deviation of an engine from a script, or None."""
    engine = make(document)
    for step, expected in zip((None, *script.steps), script.expected, strict=True):
        if step is not None:
            engine.take(step)
        if engine.active != expected:
            return f"{sorted(engine.active)} after {step}, and not {sorted(expected)}"
    return None
