"""One skeleton of each variant, whole: `pytest --bless` writes what is expected anew."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from .test_output import VARIANTS

GOLDEN = Path(__file__).parent / "golden"


@pytest.mark.parametrize(("ros", "language"), VARIANTS)
def test_golden(
    emit: Callable[..., Any], ros: str, language: str, request: pytest.FixtureRequest
) -> None:
    files, complaints = emit(only="climb", interfaces="false", ros=ros, language=language)
    expected = GOLDEN / f"ros{ros}_{language}"
    if request.config.getoption("--bless"):
        for path in sorted(expected.rglob("*"), reverse=True):
            path.rmdir() if path.is_dir() else path.unlink()
        for name, file in files.items():
            (expected / name).parent.mkdir(parents=True, exist_ok=True)
            (expected / name).write_text(file.text, encoding="utf-8")

    assert complaints == []
    assert files.keys() == {
        path.relative_to(expected).as_posix() for path in expected.rglob("*") if path.is_file()
    }
    for name, file in files.items():
        assert (expected / name).read_text(encoding="utf-8") == file.text, name


@pytest.mark.parametrize(("ros", "language"), VARIANTS)
def test_same_model_same_bytes(emit: Callable[..., Any], ros: str, language: str) -> None:
    assert emit(ros=ros, language=language) == emit(ros=ros, language=language)
