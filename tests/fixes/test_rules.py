"""Each act that advice names has a rule, and each rule an advice that names it."""

import ast
from pathlib import Path

from swarmdsl.base.diagnostics import advice
from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.driver.fixes import RULES

SOURCES = Path(advice.__file__).parents[2]


def test_acts_and_rules_are_the_same() -> None:
    acts = set()
    for path in SOURCES.rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        if "Advice(" not in text:
            continue
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.Call) and ast.unparse(node.func) == "Advice":
                act = node.args[1]
                if isinstance(act, ast.Constant):
                    acts.add(act.value)
                else:
                    assert path.name == "advice.py"  # a copy has the act of its original
    assert acts == set(RULES)


def test_advice_keeps_its_change() -> None:
    found = advice.write("x", "y").prefixed("now ")
    assert found == "now write `x` or `y`"
    assert (found.act, found.arguments) == ("write", ("x", "y"))
    assert isinstance(found, Advice)
