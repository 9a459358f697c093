"""The layers of the code: no package imports one above it, and files have no import cycles."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from swarmdsl.base.graphs import cycles

ROOT = Path(__file__).resolve().parents[1]
SOURCES = ROOT / "src" / "swarmdsl"

# From the bottom up; packages of one layer do not import each other.
LAYERS = (
    {"base"},
    {"syntax"},
    {"project", "ir"},
    {"analysis"},
    {"lowering", "codegen"},
    {"output"},
    {"driver"},
    {"execution"},
    {"importing"},
    {"tools"},
    {"ide"},
    {"cli"},
)

# Steps of a pipeline, in packages of one package: from the first to the last.
STEPS = {
    "execution.simulate": (
        "scenario",
        "machines",
        "inputs",
        "network",
        "world",
        "evaluation",
        "replay",
        "pictures",
        "recording",
        "run",
        "many_runs",
        "command",
    ),
    "execution.verify": (
        "abstraction",
        "robot",
        "automata",
        "swarm",
        "properties",
        "search",
        "replay",
        "proofs",
        "any_size",
        "findings",
        "report",
        "composition",
        "command",
    ),
}


def module_name(path: Path) -> str:
    parts = path.relative_to(SOURCES.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


FILES = {
    module_name(path): path
    for path in sorted(SOURCES.rglob("*.py"))
    if "template" not in path.parts  # files of `swarmc new`
}


def imports(module: str) -> Iterator[str]:
    """All modules of swarmdsl that a module imports, in functions and for types too."""
    path = FILES[module]
    package = module if path.name == "__init__.py" else module.rpartition(".")[0]
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in FILES)
        elif isinstance(node, ast.ImportFrom):
            above = package.split(".")[: len(package.split(".")) - node.level + 1]
            base = ".".join([*above, *([node.module] if node.module else [])])
            base = base if node.level else (node.module or "")
            for alias in node.names:
                if f"{base}.{alias.name}" in FILES:
                    yield f"{base}.{alias.name}"
                elif base in FILES:
                    yield base


@cache
def graph() -> dict[str, list[str]]:
    """Imports of each module; read by the tests, not at collection."""
    return {module: sorted(set(imports(module)) - {module}) for module in FILES}


def layer_of(module: str) -> int:
    package = module.split(".")[1]
    return next(number for number, packages in enumerate(LAYERS) if package in packages)


def inside(module: str) -> bool:
    """Return True for modules of a package; the others are deprecated modules and `__main__`."""
    return any(module.split(".")[1:2] == [package] for layer in LAYERS for package in layer)


def test_every_package_has_a_layer_and_a_readme() -> None:
    packages = {path.parent.name for path in SOURCES.glob("*/__init__.py")}
    assert packages == set().union(*LAYERS)
    for package in packages:
        readme = (SOURCES / package / "README.md").read_text(encoding="utf-8")
        headings = ("**In:**", "**Out:**", "**May import:**", "**Read first:**")
        assert [heading for heading in headings if heading not in readme] == []


def test_no_package_imports_one_above_it() -> None:
    upwards = [
        f"{module} imports {target}"
        for module in graph()
        if inside(module)
        for target in graph()[module]
        if inside(target)
        and module.split(".")[1] != target.split(".")[1]
        and layer_of(target) >= layer_of(module)
    ]
    assert upwards == []


@pytest.mark.parametrize("package", STEPS)
def test_no_step_imports_a_later_one(package: str) -> None:
    steps = STEPS[package]
    parts = {module: module.split(".")[1:] for module in graph()}
    inner = package.split(".")
    step = {module: part[2] for module, part in parts.items() if part[:2] == inner and part[2:]}
    assert set(step.values()) == set(steps)
    later = [
        f"{module} imports {target}"
        for module, of_module in step.items()
        for target in graph()[module]
        if target in step and steps.index(step[target]) > steps.index(of_module)
    ]
    assert later == []
    readme = (SOURCES / package.replace(".", "/") / "README.md").read_text(encoding="utf-8")
    places = [readme.find(f"\n| `{each}") for each in steps]
    assert -1 not in places
    assert places == sorted(places)


def test_no_file_imports_itself() -> None:
    found = cycles(graph(), lambda module: ((target, target) for target in graph()[module]))
    assert [" -> ".join([start, *path]) for start, path in found] == []


def test_the_engine_needs_the_standard_library_only() -> None:
    engine = [module for module in graph() if module.startswith("swarmdsl.execution.engine")]
    assert engine
    outside = [target for module in engine for target in graph()[module] if target not in engine]
    assert outside == []
