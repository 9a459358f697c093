"""The engines of others do differ where they are said to."""

from __future__ import annotations

import pytest

from .engines import ENGINES, Step
from .known import CAUSES, PARALLEL_LAST, Cause
from .replay import difference, needs
from .scripts import Script


def document(cause: Cause) -> bytes:
    head = 'xmlns="http://www.w3.org/2005/07/scxml" version="1.0" datamodel="ecmascript"'
    return f"<scxml {head}>{cause.document}</scxml>".encode()


def script(cause: Cause) -> Script:
    """Record the script that our engine follows."""
    engine = ENGINES["document"](document(cause))
    expected = [engine.active]
    for event in cause.events:
        engine.take(Step(event))
        expected.append(engine.active)
    return Script(tuple(map(Step, cause.events)), tuple(expected))


@pytest.mark.parametrize(
    "cause",
    [
        pytest.param(
            cause,
            id=f"{cause.engine}: {cause.name}",
            marks=[*needs(cause.engine), pytest.mark.xfail(strict=True, reason=cause.reason)],
        )
        for cause in CAUSES
    ],
)
def test_the_engine_does_the_same(cause: Cause) -> None:
    assert difference(ENGINES[cause.engine], document(cause), script(cause)) is None


@pytest.mark.parametrize(
    ("cause", "engine"),
    [
        pytest.param(
            cause, engine, id=f"{cause.engine}: {cause.name} / {engine}", marks=needs(engine)
        )
        for cause in CAUSES
        for engine in ENGINES
        if engine not in (cause.engine, "document") and cause is not PARALLEL_LAST
    ],
)
def test_the_third_engine_agrees_with_ours(cause: Cause, engine: str) -> None:
    assert difference(ENGINES[engine], document(cause), script(cause)) is None
