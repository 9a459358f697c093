"""Generated machines in this process, on a library alone: what they follow is a test's engine."""

from __future__ import annotations

import importlib
import itertools
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

from swarmdsl.base.naming import snake_case
from swarmdsl.codegen.api import OutputFile
from swarmdsl.ir import System


class Builder:
    """Generates systems and imports the modules of machines in the library."""

    def __init__(
        self,
        emit: Callable[[System], Iterable[OutputFile]],
        suffix: str,
        folder: Path,
        monkeypatch: pytest.MonkeyPatch,
    ) -> None:
        self._emit = emit
        self._suffix = suffix
        self._roots = (folder / f"out{number}" for number in itertools.count())
        self._monkeypatch = monkeypatch
        self._packages: set[str] = set()

    def __call__(self, system: System, machine: str, chart: Any) -> ModuleType:
        """The module of a machine; `chart` stands for the table."""
        files = list(self._emit(system))
        package = files[0].path.partition("/")[0]
        root = next(self._roots)
        for file in files:
            path = root / file.path
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(file.text, encoding="utf-8")
        forget({package})
        self._packages.add(package)
        self._monkeypatch.syspath_prepend(str(root / package))
        module = snake_case(machine)
        fakes = {
            module: {"BEHAVIOR": SimpleNamespace(machine=chart)},
            "node": {"run": None},
            "runner": {"Fsm": None, "in_node_of_its_own": lambda behavior, name: None},
        }
        importlib.import_module(package)
        for name, content in fakes.items():
            fake = ModuleType(f"{package}.{name}")
            vars(fake).update(content)
            self._monkeypatch.setitem(sys.modules, fake.__name__, fake)
        return importlib.import_module(f"{package}.{module}{self._suffix}")

    def close(self) -> None:
        """Forget what was imported."""
        forget(self._packages)


def forget(packages: set[str]) -> dict[str, ModuleType]:
    """Let packages be imported anew; the modules of them that were."""
    names = [each for each in sys.modules if each.partition(".")[0] in packages]
    return {name: sys.modules.pop(name) for name in names}
