"""The files that targets make of hostile models, with what they reject."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.emit import Request, emit
from swarmdsl.driver import pipeline
from swarmdsl.ir import System

from .model import Place, place_of


@dataclass(frozen=True)
class Made:
    """Files by path, and the places of the strings with a diagnostic, with its name."""

    files: Mapping[str, str]
    rejected: Mapping[Place, str]


Make = Callable[..., Made]


@pytest.fixture(scope="session")
def checked(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., System]:
    """Compile a model without errors, once for all targets."""

    @cache
    def check(text: str, name: str = "model.swarm") -> System:
        path = tmp_path_factory.mktemp("model") / name
        path.write_text(text, encoding="utf-8", newline="")
        result = pipeline.check([path])
        assert result.system is not None, [found.message for found in result.report]
        return result.system

    return check


@pytest.fixture
def make(checked: Callable[..., System]) -> Make:
    """Make the files of a target; each diagnostic about a string has the place of the string."""

    def make(text: str, target: str, options: Mapping[str, str], name: str = "model.swarm") -> Made:
        report = Diagnostics()
        output = emit(checked(text, name), [Request(target, options)], report)
        rejected = {}
        for found in report:
            assert found.primary is not None, found.message
            line = found.primary.span.source.line_text(found.primary.span.line)
            if (place := place_of(line)) is not None:
                rejected[place] = found.name
        files = {file.path: file.text for file in output.get(target, ())}
        return Made(files, rejected)

    return make
