"""Every test asserts something, itself or by a helper whose name says so."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

HERE = Path(__file__).resolve().parent
# Names of calls that assert. A helper that waits fails when what it waits for does not come.
ASSERTING = re.compile(
    r"(?s)pytest\.(raises|warns|fail)|check|(.+\.)?(expect|(assert|check|expect|wait)_\w+)"
)


def functions(tree: ast.AST) -> Iterator[ast.FunctionDef | ast.AsyncFunctionDef]:
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and node.name.startswith(
            "test_"
        ):
            yield node


def asserts(node: ast.AST) -> bool:
    if isinstance(node, ast.Call):
        return ASSERTING.fullmatch(ast.unparse(node.func)) is not None
    return isinstance(node, ast.Assert)


def without_assertion(text: str) -> list[str]:
    found = functions(ast.parse(text))
    return [test.name for test in found if not any(map(asserts, ast.walk(test)))]


def test_the_rule() -> None:
    assert without_assertion("def test_a(): run()") == ["test_a"]
    assert without_assertion("def test_a(): compiler.check(x)") == ["test_a"]
    assert without_assertion("async def test_a(): await process.wait()") == ["test_a"]
    for body in ("assert x", "check_all(x)", "node.wait_in('A')", "\n  with pytest.raises(E): f()"):
        assert without_assertion(f"def test_a(): {body}") == []


def test_every_test_asserts_something() -> None:
    missing = [
        f"{path.relative_to(HERE)}: {name}"
        for path in sorted(HERE.rglob("test_*.py"))
        if "golden" not in path.parts
        for name in without_assertion(path.read_text(encoding="utf-8"))
    ]
    assert missing == []
