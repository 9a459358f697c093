"""A state machine as XML of `yasmin_factory`, of 4.0.0 and later; parallel states of 5.0.0.

The states are the classes of the generated module; the XML binds their outcomes as the module
does.
"""

from __future__ import annotations

from swarmdsl.ir import StateMachine
from swarmdsl.xml import Element
from swarmdsl.xml import document as written

from .structure import Kind, Node
from .ways import CANCELED


def document(root: Node, machine: StateMachine, module: str) -> str:
    """The text of the file of a machine whose states are in the module."""
    element = Element("StateMachine", _head(root))
    keys = [(each.name, each.doc) for each in machine.params]
    keys += [(each.name, each.doc) for each in machine.variables]
    for name, doc in keys:
        about = {"description": " ".join(doc.split())} if doc else {}
        element.add("Key", {"name": name, "type": "out", **about})
    for node in root.nodes:
        element.children.append(_element(node, module))
    return written(element)


def _head(node: Node) -> dict[str, str]:
    outcomes = " ".join(node.outcomes)
    return {"name": node.name, "outcomes": outcomes, "start_state": node.start}


def _element(node: Node, module: str) -> Element:
    """A state with what is inside it and where its outcomes lead."""
    if node.kind is Kind.MACHINE:
        element = Element("StateMachine", _head(node))
    elif node.kind is Kind.CONCURRENCE:
        element = Element("Concurrence", name=node.name, default_outcome=CANCELED)
    else:
        called = {"type": "py", "module": module, "class": node.python_name}
        element = Element("State", {"name": node.name, **called})
    for inside in node.nodes:
        element.children.append(_element(inside, module))
    for outcome, needs in node.outcome_map.items():
        mapped = element.add("OutcomeMap", outcome=outcome)
        for state, ending in needs.items():
            mapped.add("Item", state=state, outcome=ending)
    for outcome, target in node.transitions.items():
        element.add("Transition", {"from": outcome, "to": target})
    return element
