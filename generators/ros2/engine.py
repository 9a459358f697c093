"""The engine and the monitors of swarmdsl as one module each, in the style of ROS."""

from __future__ import annotations

import ast
import builtins
import re
from collections.abc import Iterator, Sequence
from functools import cache
from inspect import cleandoc
from pathlib import Path

from swarmdsl.codegen import engine_folder, monitors_folder

# First words of docstrings that are not in the imperative, which the linters reject.
_NOUNS = ("A", "An", "The", "What", "Which")
# Each module needs only modules before it.
_ENGINE = ("table", "activity", "world", "arrays", "step", "configuration", "instance")
_MONITORS = (
    *("patterns", "monitor", "automaton", "claims", "facts"),
    *("truth", "meters", "rule", "joint", "plan", "progress"),
    *("outcomes", "watch"),
)
_GONE = "\0"
_TOKEN = re.compile(r'"""[\s\S]*?"""|#[^\n]*|f?"(?:[^"\\\n]|\\.)*"')


@cache
def engine_source() -> str:
    """Return the source of the engine without the header of a generated file."""
    return _as_one(engine_folder(), _ENGINE)


@cache
def monitors_source() -> str:
    """Return the source of the monitors, likewise."""
    return _as_one(monitors_folder(), _MONITORS)


def _as_one(folder: Path, modules: Sequence[str]) -> str:
    """Return the source of the modules of a package as one module.

    Strings have single quotes and docstrings of several lines begin below the quotes, as the
    linters of ROS 2 require.
    """
    # The source is read, not imported, which is faster.
    imports: dict[str, set[str]] = {}
    whole: set[str] = set()
    sections = []
    for module in modules:
        text = (folder / f"{module}.py").read_text(encoding="utf-8")
        tree = ast.parse(text)
        lines = text.splitlines()
        for node in tree.body:
            if isinstance(node, ast.ImportFrom) and node.level == 0 and node.module is not None:
                imports.setdefault(node.module, set()).update(name.name for name in node.names)
            elif isinstance(node, ast.Import):
                whole.update(name.name for name in node.names)
            for inner in _statements(node):
                _adapt(inner, lines)
            if _is_left_out(node):
                end = node.end_lineno or node.lineno
                lines[node.lineno - 1 : end] = [""] * (end - node.lineno + 1)
        sections.append("\n".join(line for line in lines if line is not _GONE).strip("\n"))
    future = imports.pop("__future__")
    imports["typing"] -= {"TYPE_CHECKING", "Callable"}
    imports["collections.abc"].add("Callable")
    head = [f"from __future__ import {', '.join(sorted(future))}", ""]
    statements = {
        module: f"from {module} import {', '.join(sorted(names, key=str.lower))}"
        for module, names in imports.items()
    }
    statements.update((module, f"import {module}") for module in whole)
    head += [statements[module] for module in sorted(statements)]
    package = ast.parse((folder / "__init__.py").read_text(encoding="utf-8"))
    doc = f'"""{ast.get_docstring(package, clean=False)}"""'
    made = "\n".join([doc, "", *head, "", "", "\n\n\n".join(sections), ""])
    return _TOKEN.sub(_in_style, re.sub(r"\n{4,}", "\n\n\n", made))


def _is_left_out(node: ast.stmt) -> bool:
    """Return True for an import, a `TYPE_CHECKING` block, or the docstring of the module."""
    if isinstance(node, ast.If):
        return isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING"
    if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
        return node.col_offset == 0 and node.lineno == 1
    return isinstance(node, (ast.Import, ast.ImportFrom))


def _statements(node: ast.stmt) -> Iterator[ast.stmt]:
    """Yield a statement and the statements in its body, but not in other blocks."""
    yield node
    for inner in getattr(node, "body", ()):
        yield from _statements(inner)


def _adapt(node: ast.stmt, lines: list[str]) -> None:
    """Adapt the lines of a statement to the linters of ROS 2.

    They require docstrings of functions in the imperative, so other docstrings become comments.
    """
    if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
        if node.col_offset and hasattr(builtins, node.target.id):
            lines[node.lineno - 1] += "  # noqa: A003"
    elif isinstance(node, ast.FunctionDef):
        doc, first = ast.get_docstring(node, clean=False), node.body[0]
        if doc is not None and doc.partition(" ")[0] in _NOUNS:
            indent = " " * first.col_offset
            said = [f"{indent}# {line}".rstrip() for line in cleandoc(doc).splitlines()]
            body = [] if len(node.body) > 1 else [f"{indent}pass"]
            lines[first.lineno - 1] = "\n".join([*said, *body])
            for number in range(first.lineno, first.end_lineno or 0):
                lines[number] = _GONE


def _in_style(token: re.Match[str]) -> str:
    text = token[0]
    if text.startswith('"""'):
        if "\n" not in text:
            return text
        before = token.string[: token.start()].rpartition("\n")[2]
        return f'"""\n{before}{text[3:]}'
    if text.startswith("#") or "'" in text or "\\" in text:
        return text
    return text.replace('"', "'")
