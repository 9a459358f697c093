"""Targets for tests: built in, or installed in packages of their own."""

import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest

from swarmdsl.codegen import registry
from swarmdsl.codegen.api import Generator


@pytest.fixture
def built_in(monkeypatch) -> Callable[[Generator], None]:
    """Make a generator a built-in target, the only ones there are."""
    monkeypatch.setattr(registry, "BUILT_IN", {})

    def add(generator: Generator) -> None:
        module = ModuleType(f"stub_{generator.target}")
        module.generator = generator
        monkeypatch.setitem(sys.modules, module.__name__, module)
        registry.BUILT_IN[generator.target] = f"{module.__name__}:generator"

    return add


@pytest.fixture
def install(tmp_path: Path, monkeypatch) -> Callable[..., None]:
    """Install a module with an entry point, as pip does."""
    site = tmp_path / "site"
    site.mkdir()
    monkeypatch.syspath_prepend(site)

    def add(target: str, source: str, module: str = "", attribute: str = "generator") -> None:
        module = module or f"installed_{target}"
        (site / f"{module}.py").write_text(source, encoding="utf-8")
        info = site / f"{module}-1.dist-info"
        info.mkdir()
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {module}\nVersion: 1\n")
        (info / "entry_points.txt").write_text(
            f"[{registry.GROUP}]\n{target} = {module}:{attribute}\n"
        )
        monkeypatch.delitem(sys.modules, module, raising=False)

    return add


@pytest.fixture
def roster(install) -> None:
    source = Path(__file__).parent / "roster" / "swarmdsl_roster.py"
    install("roster", source.read_text(encoding="utf-8"), "swarmdsl_roster")
