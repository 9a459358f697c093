"""Fixtures that generate from a model; the tests' fixture `emit` sets the target."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import OutputFile
from swarmdsl.ir import System

Emit = Callable[..., tuple[list[OutputFile], Diagnostics]]


@pytest.fixture
def generate(compiled: Callable[[str], System], emit: Emit) -> Callable[..., dict[str, str]]:
    """Generate from the text of a model; the texts by path in the package of the behaviour."""

    def generate(text: str, **options: str) -> dict[str, str]:
        files, report = emit(compiled(text), **options)
        assert not list(report)
        package = files[0].path.partition("/")[0] + "/"
        return {file.path.removeprefix(package): file.text for file in files}

    return generate


@pytest.fixture
def reported(
    compiled: Callable[[str], System], emit: Emit
) -> Callable[..., list[tuple[str, str, str]]]:
    """Diagnostics of a model: name, message, and the text of the primary span."""

    def reported(text: str, **options: str) -> list[tuple[str, str, str]]:
        _, report = emit(compiled(text), **options)
        return [
            (found.name, found.message, found.primary.span.text if found.primary else "")
            for found in report
        ]

    return reported
