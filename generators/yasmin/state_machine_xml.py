"""State machines as XML for `yasmin_factory` 4.0.0 or later; parallel states need 5.0.0.

The states are the classes of the generated module. The XML binds their outcomes like the module.
"""

from __future__ import annotations

from lxml import etree

from swarmdsl.codegen.shared import doc_with_unit
from swarmdsl.codegen.xml import legal
from swarmdsl.codegen.xml_tree import document as written
from swarmdsl.ir import StateMachine

from ..ros2_outcomes.structure import Kind, Node
from .library import YASMIN


def document(root: Node, machine: StateMachine, module: str) -> str:
    """Return the XML of a machine whose states are in the module."""
    element = etree.Element("StateMachine", _head(root))
    keys = [(each.name, doc_with_unit(each.doc, each.type)) for each in machine.params]
    keys += [(each.name, doc_with_unit(each.doc, each.type)) for each in machine.variables]
    for name, doc in keys:
        about = {"description": legal(" ".join(doc.split()))} if doc else {}
        etree.SubElement(element, "Key", {"name": name, "type": "out", **about})
    for node in root.nodes:
        element.append(_element(node, module))
    return written(element)


def _head(node: Node) -> dict[str, str]:
    outcomes = " ".join(node.outcomes)
    return {"name": node.name, "outcomes": outcomes, "start_state": node.start}


def _element(node: Node, module: str) -> etree._Element:
    """Return the element of a state, with the states inside and its transitions."""
    if node.kind is Kind.MACHINE:
        element = etree.Element("StateMachine", _head(node))
    elif node.kind is Kind.CONCURRENCE:
        element = etree.Element("Concurrence", name=node.name, default_outcome=YASMIN.stopped)
    else:
        called = {"type": "py", "module": module, "class": node.python_name}
        element = etree.Element("State", {"name": node.name, **called})
    for inside in node.nodes:
        element.append(_element(inside, module))
    for outcome, needs in node.outcome_map.items():
        mapped = etree.SubElement(element, "OutcomeMap", outcome=outcome)
        for state, ending in needs.items():
            etree.SubElement(mapped, "Item", state=state, outcome=ending)
    for outcome, target in node.transitions.items():
        etree.SubElement(element, "Transition", {"from": outcome, "to": target})
    return element
