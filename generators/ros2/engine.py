"""The engine as one file in the style of ROS: what `swarmdsl.execution.engine` has in several."""

from __future__ import annotations

import ast
import builtins
import re
from collections.abc import Iterator
from functools import cache
from inspect import cleandoc

from swarmdsl.codegen import engine_folder

# How docstrings begin that are no orders, as the linters want them to be.
_NOUNS = ("A", "An", "The", "What", "Which")
# In an order in which each needs only those before it.
_MODULES = ("table", "activity", "world", "step", "configuration", "instance")
_GONE = "\0"
_TOKEN = re.compile(r'"""[\s\S]*?"""|#[^\n]*|f?"(?:[^"\\\n]|\\.)*"')


@cache
def engine_source() -> str:
    """The source without what stands at the top of a generated file.

    Strings are in single quotes and docstrings of several lines begin below the quotes, as
    the linters of ROS 2 want it.
    """
    # It is only read: to import it takes longer.
    folder = engine_folder()
    imports: dict[str, set[str]] = {}
    sections = []
    for module in _MODULES:
        text = (folder / f"{module}.py").read_text(encoding="utf-8")
        tree = ast.parse(text)
        lines = text.splitlines()
        for node in tree.body:
            if isinstance(node, ast.ImportFrom) and node.level == 0 and node.module is not None:
                imports.setdefault(node.module, set()).update(name.name for name in node.names)
            for inner in _statements(node):
                _suit(inner, lines)
            if _is_left_out(node):
                end = node.end_lineno or node.lineno
                lines[node.lineno - 1 : end] = [""] * (end - node.lineno + 1)
        sections.append("\n".join(line for line in lines if line is not _GONE).strip("\n"))
    future = imports.pop("__future__")
    imports["typing"] -= {"TYPE_CHECKING", "Callable"}
    imports["collections.abc"].add("Callable")
    head = [f"from __future__ import {', '.join(sorted(future))}", ""]
    head += [
        f"from {module} import {', '.join(sorted(names, key=str.lower))}"
        for module, names in sorted(imports.items())
    ]
    package = ast.parse((folder / "__init__.py").read_text(encoding="utf-8"))
    doc = f'"""{ast.get_docstring(package, clean=False)}"""'
    made = "\n".join([doc, "", *head, "", "", "\n\n\n".join(sections), ""])
    return _TOKEN.sub(_in_style, re.sub(r"\n{4,}", "\n\n\n", made))


def _is_left_out(node: ast.stmt) -> bool:
    """Whether it is an import, one for type checkers, or the docstring of the module."""
    if isinstance(node, ast.If):
        return isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING"
    if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
        return node.col_offset == 0 and node.lineno == 1
    return isinstance(node, (ast.Import, ast.ImportFrom))


def _statements(node: ast.stmt) -> Iterator[ast.stmt]:
    """A statement and those in its body; nothing else of it is looked at."""
    yield node
    for inner in getattr(node, "body", ()):
        yield from _statements(inner)


def _suit(node: ast.stmt, lines: list[str]) -> None:
    """Make what linters want otherwise to what they take, in the lines of a module.

    To them the docstring of a function is an order, so others become comments.
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
