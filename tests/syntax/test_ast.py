"""The classes of the syntax tree follow the grammar."""

from __future__ import annotations

from dataclasses import fields
from functools import cache

import pytest

from swarmdsl.syntax.ast import NODES, Documented
from swarmdsl.syntax.pegen.metamodel import metamodel

# Words with a place, and the two rules for expressions, become `Word` and `Expression`.
WORDS = {"Name", "FieldName", "PortName", "InterfaceName", "PackageName", "Text", "Unit"}
EXPRESSIONS = {"Expression", "Operand", "Delay"}
# Nodes that come from expression.lark, and the bases.
OTHERS = {
    *("Expression", "Value", "NameUse", "FieldUse", "IndexUse", "Call", "OperatorUse"),
    *("Query", "Element", "Construction", "FieldValue", "RoleUse", "InState", "Elapsed"),
}
# What stands inside a line. All else begins one, and has documentation.
INLINE = {
    *("Box", "Height", "Point", "SpaceMeasure", "Start"),
    *("TypeRef", "Multiplicity", "PortRef", "Argument", "ResultMapping", "Send", "Address"),
    *(
        "Chance",
        "Claim",
        "Conjunction",
        "Each",
        "Fact",
        "Measure",
        "Pattern",
        "PropertyScope",
        "SafeState",
        "Term",
        "Who",
    ),
    *("Assignment", "Append", "Remove", "Clear", "Cancel", "DeferredEvent"),
    *("OutcomeTrigger", "DoneTrigger", "EventTrigger", "TimeTrigger", "MonitorTrigger"),
}


@cache
def common_rules() -> dict[str, set[str]]:
    return {
        rule.__name__: set(rule._tx_attrs)
        for rule in metamodel()
        if rule._tx_type == "common" and rule.__name__ not in WORDS | EXPRESSIONS
    }


def test_each_rule_has_a_class_and_each_class_a_rule() -> None:
    assert set(NODES) - OTHERS == set(common_rules())


@pytest.mark.parametrize("rule", sorted(set(NODES) - OTHERS))
def test_attributes_are_those_of_the_rule(rule: str) -> None:
    made = {attribute.name for attribute in fields(NODES[rule]) if attribute.init} - {"span"}

    assert made == common_rules()[rule]


def test_what_stands_on_a_line_of_its_own_has_documentation() -> None:
    documented = {name for name, node in NODES.items() if issubclass(node, Documented)}

    assert set(common_rules()) - documented == {"Model", *INLINE}
