"""Delays pass in an engine of others as they do in ours: there on the wall, here at once."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from itertools import groupby

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.exchange import scxml
from swarmdsl.ir import System

from .engines import Document, Qt
from .known import QT
from .replay import needs

# The steps are far enough apart for a busy computer.
MODEL = """
package test
statemachine M {
  var n : int32 = 1
  initial A
  state A {
    initial Inner
    state Inner { after 200 ms * n / n = n + 1 -> Inner; after 300 ms -> Other }
    state Other { after 1 s -> A }
    after 900 ms -> B
  }
  state B {
    after 10 s -> A
    after 100 ms [elapsed() > 50 ms and elapsed() < 5 s] -> C
  }
  state C { initial D; state D { after 100 ms -> E } final E; on done -> End }
  final End
}
"""


def here(document: bytes) -> Iterator[frozenset[str]]:
    engine = Document(document)
    yield engine.active
    while engine.world.clock.step():
        yield engine.active


def there(document: bytes) -> Iterator[frozenset[str]]:
    engine = Qt(document)
    end = time.monotonic() + 60
    while engine.machine.isRunning() and time.monotonic() < end:
        yield engine.active
        time.sleep(0.001)
        Qt.application.processEvents()
    yield engine.active


@pytest.mark.parametrize("engine", [pytest.param(QT, marks=needs(QT))])
def test_delays(engine: str, compiled: Callable[[str], System]) -> None:
    (file,) = scxml.emit(compiled(MODEL), scxml.Options("portable"), Diagnostics())
    document = file.text.encode()

    ours = [active for active, _ in groupby(here(document))]
    others = [active for active, _ in groupby(there(document))]

    assert [sorted(each) for each in others] == [sorted(each) for each in ours]
    assert others[-1] == {"End"}
    assert len(ours) == 5
