"""Portable files are valid by the schema of the W3C; the same model gives the same files."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest
from lxml import etree

from swarmdsl.driver import pipeline
from swarmdsl.ir import System

ROOT = Path(__file__).resolve().parents[2]
FILES = [
    *(path for path in (ROOT / "examples").iterdir() if path.is_dir()),
    *(ROOT / "tests" / "golden").glob("*/model.swarm"),
]
MODELS = [pytest.param(path, id=str(path.relative_to(ROOT))) for path in sorted(FILES)]


@pytest.fixture(scope="session")
def schema(corpus: Path) -> etree.XMLSchema:
    return etree.XMLSchema(etree.parse(corpus / "scxml-xsd" / "scxml.xsd"))


@cache
def system_of(model: Path) -> System:
    system = pipeline.check([model]).system
    assert system is not None
    return system


def deferrals(system: System) -> list[str]:
    """Return the diagnostics of deferred events, which other engines discard."""
    states = (state for machine in system.machines for state in machine.walk())
    return ["no-place" for state in states for _ in state.deferred]


@pytest.mark.parametrize("model", MODELS)
def test_portable_files_are_valid(
    model: Path, schema: etree.XMLSchema, emit: Callable[..., dict[str, str]]
) -> None:
    system = system_of(model)
    files = emit(system, expected=deferrals(system))

    assert files or not system.machines
    for path, text in files.items():
        assert schema.validate(etree.fromstring(text.encode())), (path, schema.error_log)


def test_every_construct_is_valid(
    compiled: Callable[[str], System],
    schema: etree.XMLSchema,
    emit: Callable[..., dict[str, str]],
) -> None:
    """Combinations of constructs that no other model has."""
    system = compiled(
        """
        statemachine Inner {
          initial A
          state A { entry / send Start; exit / send Abort; on Start -> B }
          state B { initial C; state C { on Start -> E } final E; deep history H -> C
            on done -> D }
          final D
        }
        endless statemachine M {
          var n : int32; var r : Report; var xs : int32[<=3]
          initial P
          /// Both.
          parallel state P {
            entry / n = 1, send Found(level = n % 3)
            exit  / r.level = -n % 3
            region X {
              initial One
              state One { on Found / r = event -> Two }
              state Two { on Found / r = event;  [n > 3] -> Fork }
              choice Fork { [n > 5] -> One; else -> Two }
              history Again -> One
            }
            region Y { initial Quiet; state Quiet { after 1 s * 2 -> Quiet; on Low / n = 2 } }
            internal on Start [n > 1] / n = 2 -> Two
            internal on Abort -> Again
            on Start -> Sub
          }
          state Sub = Inner { entry / n = 0; on done -> P.Again }
        }
        """
    )
    for path, text in emit(system).items():
        assert schema.validate(etree.fromstring(text.encode())), (path, schema.error_log)


@pytest.mark.parametrize("model", MODELS)
def test_the_same_model_gives_the_same_files(
    model: Path, emit: Callable[..., dict[str, str]]
) -> None:
    system, again = system_of(model), pipeline.check([model]).system
    assert again is not None
    expected = deferrals(system)

    assert emit(again, expected=expected) == emit(system, expected=expected)
