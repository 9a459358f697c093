"""The SDK for authors of generators: exports, importers, old names."""

from __future__ import annotations

import ast
import importlib
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from swarmdsl.codegen import registry
from swarmdsl.codegen.api import Generator
from swarmdsl.codegen.python import Constants

ROOT = Path(__file__).resolve().parents[2]
CODEGEN = ROOT / "src" / "swarmdsl" / "codegen"
PLUGINS = Path(__file__).parent
PUBLIC = {
    "swarmdsl.codegen",
    "swarmdsl.codegen.cpp",
    "swarmdsl.codegen.python",
    "swarmdsl.codegen.ros",
    "swarmdsl.codegen.shared",
    "swarmdsl.codegen.xml",
    "swarmdsl.codegen.xml_tree",
    "swarmdsl.execution.verify.composition",
    "swarmdsl.ir",
}
LAZY = [
    "swarmdsl.codegen",
    "swarmdsl.codegen.ros",
    "swarmdsl.codegen.shared",
    "swarmdsl.execution.verify.composition",
    "swarmdsl.ir",
]
MOVED = {
    "generator": ("codegen.api", "Generator OutputFile option Feature Support Mapped emit_of fits"),
    "naming": ("base.naming", "snake_case camel_case fresh is_python_name incoming_topic"),
    "translate": ("ir.expression_printer", "Dialect translate python_literal ecmascript_literal"),
    "python_source": ("codegen.python", "Call Source layout comments comment_lines docstring"),
    "templates": ("codegen.templates", "Templates"),
    "source_map": ("codegen.source_map", "MappedText at Entry"),
    "diagnostics": ("base.diagnostics.collector", "Diagnostics Diagnostic Label Severity listed"),
    "dataclass": ("base.records", "dataclass field replace fields_of is_dataclass"),
    "source": ("base.source", "Source Span"),
    "xml_text": ("base.xml_writer", "Element document legal"),
    "diagram.readme": ("codegen.diagram.readme", "Picture pictures"),
}
RENAMED = {
    "python_source.place": "codegen.python.source_place",
    "source_map.Placed": "codegen.source_map.TracedStr",
    "diagram.readme.insides": "codegen.diagram.readme.member_pictures",
}


def imported(path: Path) -> Iterator[str]:
    """Yield the modules of swarmdsl that a file imports."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            yield node.module or ""


def test_generators_import_the_sdk_only() -> None:
    files = [*ROOT.glob("generators/**/*.py"), *PLUGINS.glob("*/**/*.py")]
    # Modules that generated packages get a copy of are no part of the generator.
    files = [path for path in files if "runtime" not in path.parts]
    assert len(files) > 50
    others = [
        f"{path.relative_to(ROOT)}: {module}"
        for path in files
        for module in imported(path)
        if module.startswith("swarmdsl") and module not in PUBLIC
    ]
    assert others == []


def test_code_generation_sees_the_ir_and_no_front_end() -> None:
    types = ("swarmdsl.syntax.types", "swarmdsl.syntax.units")
    below = ("swarmdsl.codegen", "swarmdsl.ir", *types, "swarmdsl.base")
    # The printer of models needs the literals, comments and keywords of the language.
    parser = "swarmdsl.syntax.parser"
    language = {f"{parser}.{name}" for name in ("doc_comments", "keywords", "literals")}
    others = {
        f"{path.relative_to(CODEGEN)}: {module}"
        for path in CODEGEN.rglob("*.py")
        for module in imported(path)
        if module.startswith("swarmdsl.") and not module.startswith(below)
        if module not in language or path.parent.name != "swarm_printer"
    }
    assert others == set()


@pytest.mark.parametrize("name", LAZY)
def test_a_lazy_package_has_what_type_checkers_see(name: str) -> None:
    module = importlib.import_module(name)
    assert module.__file__ is not None
    tree = ast.parse(Path(module.__file__).read_text(encoding="utf-8"))
    (block,) = [node for node in tree.body if isinstance(node, ast.If)]
    typed = {
        alias.name: node.module
        for node in block.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    assert sorted(typed) == sorted(module.__all__)
    for exported, home in typed.items():
        assert home is not None
        assert getattr(module, exported) is getattr(importlib.import_module(home), exported)


def test_registering_a_target_imports_no_templates() -> None:
    code = (
        "import sys; from swarmdsl.codegen import Generator, Feature, option\n"
        "heavy = ('jinja2', 'lxml', 'swarmdsl.analysis', 'swarmdsl.codegen.diagram')\n"
        "assert not [name for name in sys.modules if name.startswith(heavy)], sys.modules"
    )
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


@pytest.mark.parametrize("old", MOVED)
def test_old_modules_give_the_same_objects_and_warn(old: str) -> None:
    home, names = MOVED[old]
    module = importlib.import_module(f"swarmdsl.{old}")
    for name in names.split():
        with pytest.warns(DeprecationWarning, match=rf"`swarmdsl\.{old}` is deprecated"):
            found = getattr(module, name)
        assert found is getattr(importlib.import_module(f"swarmdsl.{home}"), name)


@pytest.mark.parametrize("old", RENAMED)
def test_old_names_mean_the_new_ones(old: str) -> None:
    module, _, name = old.rpartition(".")
    home, _, new = RENAMED[old].rpartition(".")
    with pytest.warns(DeprecationWarning, match="is deprecated"):
        found = getattr(importlib.import_module(f"swarmdsl.{module}"), name)
    assert found is getattr(importlib.import_module(f"swarmdsl.{home}"), new)


def test_an_old_module_has_no_other_names() -> None:
    with pytest.raises(AttributeError, match="nowhere"):
        importlib.import_module("swarmdsl.generator").nowhere  # noqa: B018


OLD = """
from swarmdsl.diagnostics import Diagnostics
from swarmdsl.generator import Feature, Generator, OutputFile, option
from swarmdsl.ir import System
from swarmdsl.naming import snake_case


def emit(system: System, options: object, report: Diagnostics) -> list[OutputFile]:
    return [OutputFile(f"{snake_case(system.name)}.txt", "")]


generator = Generator("old", "made for the names of the last release", emit)
"""


def test_a_plugin_with_old_names_works(install) -> None:
    install("old", OLD)
    with pytest.warns(DeprecationWarning, match="`swarmdsl.codegen`") as warned:
        generator = registry.load("old")
    assert isinstance(generator, Generator)
    assert {Path(warning.filename).name for warning in warned} == {"installed_old.py"}


def test_constants_of_a_module_do_not_collide() -> None:
    constants = Constants(taken=["STATES"])
    named = {
        "Mode.AUTO": "4",
        "SearchMode.AUTO": "5",
        "mode.auto": "6",
        "STATES": "7",
        "_3": "8",
    }
    made = {name: constants.name(name, text) for name, text in named.items()}

    assert list(made.values()) == [
        "MODE_AUTO",
        "SEARCH_MODE_AUTO",
        "MODE_AUTO_",
        "STATES_",
        "VALUE_3",
    ]
    assert constants.name("Mode.AUTO", "4") == "MODE_AUTO"
    values: dict[str, object] = {}
    exec("\n".join(constants.lines()), values)
    assert {values[name] for name in made.values()} == {4, 5, 6, 7, 8}
